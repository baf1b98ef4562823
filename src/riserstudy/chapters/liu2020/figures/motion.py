"""Figures of Liu et al. 2020 on surge, roll and response in waves."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, PRINTED, field, key_below, panels

DEPTHS = (100.0, 200.0, 300.0, 400.0)  # m below the riser's top, as in Fig 18
RING = 533.0  # m, arclength of the riser's top
WITHOUT = "riser's top on the platform"
BASELINES = {
    "constant": "constant pull along cylinders",
    "vertical force at the ring": "vertical force at the ring",
    WITHOUT: WITHOUT,
}
MOMENT = 32.8  # kN m that the text gives for 4 deg in 10 s; config/published/liu2020.yaml, N3
DEPTH, TIME = "depth below the riser's top (m)", "time (s)"
DISPLACEMENT = "lateral displacement (m)"
UNITS = {"small": "-", "medium": "--", "large": ":"}
WAVE = "wave period (s)"


# surge


def fig16(surge_case: xr.Dataset) -> Figure:
    """Displacement over depth and time, the riser's top on the platform."""
    return _moved(surge_case, WITHOUT)


def fig17(surge_case: xr.Dataset) -> Figure:
    """Displacement over depth and time, on the tensioners."""
    return _moved(surge_case, "gas law")


def fig18(surge_case: xr.Dataset) -> Figure:
    """Displacement at four depths, with and without tensioners."""
    figure, axes = panels(2, 2, 2.7, sharex=True)
    x = _by_depth(surge_case["x"]).sel(time=slice(105.0, None))
    for ax, depth in zip(axes, DEPTHS, strict=True):
        for colour, model in zip(COLOURS, ("gas law", *BASELINES), strict=False):
            curve = x.sel(tensioner_model=model).dropna("depth", how="all").interp(depth=depth)
            label = "with tensioners" if model == "gas law" else BASELINES[model]
            line = "-" if model in ("gas law", WITHOUT) else "--"
            ax.plot(curve["time"], curve, line, color=colour, linewidth=1.1, label=label)
        ax.set_title(f"{depth:.0f} m", loc="right", fontsize="small")
    for ax in axes[2:]:
        ax.set_xlabel(TIME)
    for ax in axes[::2]:
        ax.set_ylabel(DISPLACEMENT)
    key_below(figure, axes[0], 2)
    return figure


def baselines(statics_readings: xr.Dataset, surge_readings: xr.Dataset) -> Figure:
    """Samples in which the riser on tensioners moves less and lags, by what stands without them."""
    figure, axes = panels(1, 3, 3.6, sharey=True)
    at_rest = statics_readings["largest_displacement"].sel(surface_speed=1.0)
    surging = surge_readings["displacement_amplitude"]
    lag = surge_readings["displacement_lag"]
    behind = lag.sel(tensioner_model="gas law", drop=True) - lag
    compared = (
        at_rest / at_rest.sel(tensioner_model="gas law"),
        (surging / surging.sel(tensioner_model="gas law")).min("depth"),
        (180.0 / np.pi * ((behind + np.pi) % (2.0 * np.pi) - np.pi)).min("depth"),
    )
    titles = (
        "current of 1 m/s: largest",
        "surge: least of four depths",
        "surge: least of four depths",
    )
    over = "displacement without over with (-)"
    labels, same = (over, over, "lag of that with tensioners (deg)"), (1.0, 1.0, 0.0)
    for ax, values, title, x, even in zip(axes, compared, titles, labels, same, strict=True):
        for colour, (model, label) in zip(COLOURS[1:], BASELINES.items(), strict=False):
            risen = np.sort(values.sel(tensioner_model=model).values)
            share = np.arange(1, len(risen) + 1) / len(risen)
            ax.step(risen, 100.0 * share, color=colour, where="post", label=label)
        ax.axvline(even, color="black", linewidth=0.9)
        ax.set_xlabel(x)
        ax.set_title(title, loc="right", fontsize="small")
    axes[0].set_ylabel("share of the samples below (%)")
    key_below(figure, axes[0], 3)
    return figure


def _moved(surge_case: xr.Dataset, model: str) -> Figure:
    figure, (ax,) = panels(height=3.8)
    x = _by_depth(surge_case["x"].sel(tensioner_model=model)).dropna("depth", how="all")
    field(figure, ax, x.sel(depth=slice(0.0, None)), "time", "depth", DISPLACEMENT)
    ax.set_xlabel(TIME)
    ax.set_ylabel(DEPTH)
    ax.invert_yaxis()
    return figure


# roll


def fig19(roll_case: xr.Dataset) -> Figure:
    """Bending moment over depth and time under roll."""
    figure, axes = panels(1, 2, 3.8, sharey=True)
    run = roll_case.sel(tensioner_model="gas law")
    moment = _by_depth(run["bending_moment"]).sel(depth=slice(0.0, None)) / 1e3
    field(figure, axes[0], moment, "time", "depth", "bending moment (kN m)")
    axes[0].set_xlabel(TIME)
    axes[0].set_ylabel(DEPTH)
    largest = abs(moment).max("time")
    axes[1].plot(largest, largest["depth"], color=COLOURS[0])
    axes[1].axvline(MOMENT, label="printed, and calibrated to", **PRINTED)
    axes[1].set_xlabel("largest bending moment (kN m)")
    axes[1].legend(fontsize="small")
    axes[1].invert_yaxis()
    return figure


def fig20(roll: xr.Dataset) -> Figure:
    """Largest bending moment over roll amplitude and period."""
    figure, (ax,) = panels(height=3.8)
    for colour, amplitude in zip(COLOURS, roll["roll_amplitude"].values, strict=False):
        curve = roll["max_bending_moment"].sel(roll_amplitude=amplitude) / 1e3
        ax.plot(curve["roll_period"], curve, color=colour, label=f"{amplitude:g} deg")
    ax.plot([10.0], [MOMENT], "kx", markersize=8, label="printed (4 deg), calibrated to")
    ax.set_xlabel("roll period of the platform (s)")
    ax.set_ylabel("largest bending moment (kN m)")
    ax.legend(fontsize="small")
    return figure


# response in waves


def fig21(rao_table: xr.Dataset) -> Figure:
    """Heave and surge over wave period."""
    figure, (ax,) = panels(height=3.6)
    for colour, name in zip(COLOURS, ("heave", "surge"), strict=False):
        for unit, line in UNITS.items():
            curve = rao_table[f"rao_{name}"].sel(platform_unit=unit)
            ax.plot(curve["wave_period"], curve, line, color=colour, label=f"{name}, {unit}")
    ax.set_xlabel(WAVE)
    ax.set_ylabel("motion over wave amplitude (-)")
    ax.legend(fontsize="small")
    return figure


def fig22(rao_table: xr.Dataset) -> Figure:
    """Pitch over wave period."""
    figure, (ax,) = panels(height=3.6)
    for unit, line in UNITS.items():
        curve = np.rad2deg(rao_table["rao_pitch"].sel(platform_unit=unit))
        ax.plot(curve["wave_period"], curve, line, color=COLOURS[0], label=unit)
    ax.set_xlabel(WAVE)
    ax.set_ylabel("pitch over wave amplitude (deg/m)")
    ax.legend(fontsize="small")
    return figure


def fig23(rao: xr.Dataset) -> Figure:
    """Stress amplitude by each motion."""
    return _by_motion(rao["stress_amplitude"] / 1e6, "stress amplitude (MPa)")


def fig24(rao: xr.Dataset) -> Figure:
    """Share of each motion in the stress amplitude."""
    return _by_motion(100.0 * rao["stress_share"], "share of the stress amplitude (%)")


def _by_motion(values: xr.DataArray, label: str) -> Figure:
    figure, axes = panels(1, 2, 3.6, sharey=True)
    for ax, reference in zip(axes, values["reference"].values, strict=True):
        for colour, motion in zip(COLOURS, values["motion"].values, strict=False):
            for unit, line in UNITS.items():
                curve = values.sel(reference=reference, motion=motion, platform_unit=unit)
                ax.plot(curve["wave_period"], curve, line, color=colour, label=f"{motion}, {unit}")
        ax.set_xlabel(WAVE)
        ax.set_title(f"centre of motion {reference}", loc="right", fontsize="small")
    axes[0].set_ylabel(label)
    key_below(figure, axes[0], 3)
    return figure


def waves(waves: xr.Dataset) -> Figure:
    """Stress amplitude with waves on the riser and without."""
    figure, (ax,) = panels(height=3.8)
    stress = waves["stress_amplitude"] / 1e6
    lines = ("-", "--", "-.", ":")
    for colour, line, reading in zip(COLOURS, lines, stress["waves"].values, strict=False):
        curve = stress.sel(waves=reading)
        label = reading if "alone" in reading else f"on the riser too, {reading}"
        ax.plot(curve["wave_period"], curve, line, color=colour, label=label)
    ax.set_xlabel(WAVE)
    ax.set_ylabel("stress amplitude (MPa)")
    ax.set_title("surge, heave and pitch at once", loc="right", fontsize="small")
    key_below(figure, ax, 2)
    return figure


def sea(storm: xr.Dataset) -> Figure:
    """Histories and spectra of three hours."""
    figure, axes = panels(3, 2, 2.3)
    shown = {
        "bending moment (kN m)": ("bending_moment", 1e-3),
        "tension at the ring (kN)": ("effective_tension", 1e-3),
        "stroke (m)": ("stroke", 1.0),
    }
    for row, (label, (name, scale)) in enumerate(shown.items()):
        history, spectrum = storm[name], storm[f"{name}_spectrum"]
        if "s" in history.dims:
            history, spectrum = history.isel(s=-1), spectrum.isel(s=-1)
        left, right = axes[2 * row], axes[2 * row + 1]
        left.plot(history["time"], scale * history, color=COLOURS[0], linewidth=0.4)
        left.set_ylabel(label)
        low = spectrum["frequency"] < 0.3
        right.plot(spectrum["frequency"][low], scale**2 * spectrum[low], color=COLOURS[0])
        right.set_ylabel(label.replace(")", ")²/Hz"))
    axes[4].set_xlabel(TIME)
    axes[5].set_xlabel("frequency (1/s)")
    return figure


def _by_depth(values: xr.DataArray) -> xr.DataArray:
    """Over depth below the riser's top instead of arclength from its bottom."""
    depth = (RING - values["s"]).round(6)
    return values.assign_coords(depth=depth).swap_dims(s="depth").sortby("depth")
