"""Figures of Liu et al. 2020 on response in waves."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from riserstudy.chapters.liu2020.figures.motion_shared import TIME
from riserstudy.dataset.statistics import peaks
from riserstudy.figures.direct import label_ends, label_line
from riserstudy.figures.style import (
    COLOURS,
    GREY,
    headline,
    legend_below,
    panel_title,
    panels,
)

UNITS = {"small": "-", "medium": "--", "large": ":"}
WAVE = "wave period (s)"
GENERIC = "generic unit"  # those of the paper's platform are not printed
RESPONSES = {
    "bending_moment": ("moment at the ring", "kN m", 1e-3),
    "effective_tension": ("tension at the ring", "kN", 1e-3),
    "stroke": ("stroke", "m", 1.0),
}
CALM = 14.0  # s, wave periods above which waves on the riser lower its stress
SHOWN = 300.0  # s, of a sea
HIGHEST = 0.5  # Hz, of spectra
ALONE, STRETCHED = "on the platform alone", "stretched to the surface"


def fig21(rao_table: xr.Dataset) -> Figure:
    """Heave and surge over wave period."""
    figure, (ax,) = panels(height=3.6)
    for colour, name in zip(COLOURS, ("heave", "surge"), strict=False):
        for unit, line in UNITS.items():
            curve = rao_table[f"rao_{name}"].sel(platform_unit=unit)
            label = f"{name}, {unit} {GENERIC}"
            (drawn,) = ax.plot(curve["wave_period"], curve, line, color=colour, label=label)
            if unit == "large":
                offset = (-8.0, 0.0) if name == "heave" else (0.0, 5.0)
                share = 0.71 if name == "heave" else 0.9
                label_line(ax, drawn, share, offset, name=name, size="medium")
    ax.set_xlabel(WAVE)
    ax.set_ylabel("motion / wave amplitude (m/m)")
    key = [
        Line2D([], [], ls=line, color=GREY, label=f"{unit} {GENERIC}")
        for unit, line in UNITS.items()
    ]
    ax.legend(handles=key, fontsize="small", loc="upper left")
    still, most = (float(x) for x in (_stillest(rao_table), _heaviest(rao_table)))
    headline(
        figure,
        f"The medium generic unit surges least at {still:.1f} s and heaves most at {most:.1f} s",
    )
    return figure


def fig22(rao_table: xr.Dataset) -> Figure:
    """Pitch over wave period."""
    figure, (ax,) = panels(height=3.6)
    for unit, line in UNITS.items():
        curve = np.rad2deg(rao_table["rao_pitch"].sel(platform_unit=unit))
        ax.plot(curve["wave_period"], curve, line, color=COLOURS[0], label=f"{unit} {GENERIC}")
    ax.set_xlabel(WAVE)
    ax.set_ylabel("pitch / wave amplitude (°/m)")
    ax.legend(fontsize="small")
    pitch = rao_table["rao_pitch"].sel(platform_unit="medium")
    headline(
        figure,
        f"The medium generic unit pitches most in waves of {float(pitch.idxmax('wave_period')):.1f} s",
    )
    return figure


def _stillest(rao_table: xr.Dataset) -> xr.DataArray:
    """Wave period (s) above 7 s at which the medium unit surges least."""
    surge = rao_table["rao_surge"].sel(platform_unit="medium")
    return surge.where((surge["wave_period"] > 7.0) & (surge["wave_period"] < 12.0)).idxmin(
        "wave_period"
    )


def _heaviest(rao_table: xr.Dataset) -> xr.DataArray:
    """Wave period (s) at which the medium unit heaves most."""
    return rao_table["rao_heave"].sel(platform_unit="medium").idxmax("wave_period")


def fig23(rao: xr.Dataset) -> Figure:
    """Stress amplitude by each motion."""
    stress = rao["stress_amplitude"] / 1e6
    largest = stress.max(["wave_period", "platform_unit", "reference"])
    figure = _by_motion(stress, "stress amplitude (MPa)")
    first = str(largest["motion"].values[int(largest.argmax("motion"))])
    most = float(largest.max())
    headline(figure, f"{first.capitalize()} stresses the riser most, by up to {most:.0f} MPa")
    return figure


def fig24(rao: xr.Dataset) -> Figure:
    """Share of each motion in the stress amplitude."""
    share = 100.0 * rao["stress_share"]
    span = float(share["wave_period"].max() - share["wave_period"].min())
    mean = share.integrate("wave_period").mean(["platform_unit", "reference"]) / span
    first = str(mean["motion"].values[int(mean.argmax("motion"))])
    figure = _by_motion(share, "share of the stress amplitude (%)")
    headline(
        figure,
        f"{first.capitalize()} makes {float(mean.max()):.0f} % of the stress amplitude, as a mean over "
        "both panels",
    )
    return figure


def _by_motion(values: xr.DataArray, label: str) -> Figure:
    """A line per motion for the medium unit, marks at simulated periods; bands: over the three units."""
    figure, axes = panels(1, 2, 3.6, sharey=True)
    for ax, reference in zip(axes, values["reference"].values, strict=True):
        for colour, motion in zip(COLOURS, values["motion"].values, strict=False):
            curve = values.sel(reference=reference, motion=motion)
            low, high = curve.min("platform_unit"), curve.max("platform_unit")
            ax.fill_between(low["wave_period"], low, high, color=colour, alpha=0.25, linewidth=0.0)
            ax.plot(curve["wave_period"], curve.sel(platform_unit="medium"), ".-", ms=4, lw=1.2,
                    color=colour, label=str(motion))  # fmt: skip
        ax.set_xlabel(WAVE)
        panel_title(ax, f"centre of motion {reference}")
    axes[0].set_ylabel(label)
    medium = Line2D([], [], color=GREY, marker=".", ms=4, lw=1.2)
    band = Patch(color=GREY, alpha=0.25, linewidth=0.0)
    legend_below(figure, [medium, band], [f"medium {GENERIC}", f"range of three {GENERIC}s"], 2)
    label_ends(axes[1])
    return figure


def waves(waves: xr.Dataset) -> Figure:
    """Stress amplitude with waves on the riser and without."""
    figure, (ax,) = panels(height=3.8)
    stress = waves["stress_amplitude"] / 1e6
    alone = stress.sel(waves=ALONE)
    (without,) = ax.plot(alone["wave_period"], alone, ".-", color=COLOURS[0], label=ALONE)
    on_it = stress.drop_sel(waves=ALONE)
    low, high = on_it.min("waves"), on_it.max("waves")
    names = "none, constant or stretched above the mean level"
    ax.fill_between(
        low["wave_period"], low, high, color=COLOURS[1], alpha=0.6, label=f"range: {names}"
    )
    stretched = stress.sel(waves=STRETCHED)
    (on,) = ax.plot(
        stretched["wave_period"],
        stretched,
        ".-",
        color=COLOURS[1],
        label=f"on the riser, {STRETCHED}",
    )
    calm = alone.where(alone["wave_period"] > CALM, 0.0)
    crest = float(np.argmax(calm.values)) / max(1, alone.size - 1)
    label_line(ax, without, crest, (6.0, 5.0), name="waves on the platform alone")
    label_line(ax, on, 0.45, (10.0, 6.0), name="waves on the riser, too")
    ax.set_xlabel(WAVE)
    ax.set_ylabel("stress amplitude (MPa)")
    panel_title(ax, "surge, heave and pitch at once")
    ratio = stretched / alone
    headline(
        figure,
        f"Waves on the riser raise its stress up to {float(ratio.max()):.0f} times, at "
        f"{float(ratio.idxmax('wave_period')):g} s",
    )
    return figure


def sea(storm: xr.Dataset) -> Figure:
    """Five minutes about the largest response, the spectra, and how often a size is exceeded."""
    figure, axes = panels(3, 3, 2.4)
    worst = {}
    for row, (name, (label, unit, scale)) in enumerate(RESPONSES.items()):
        history, density = (_at_ring(storm[key]) for key in (name, f"{name}_spectrum"))
        swing = scale * (history - history.mean())
        left, middle, right = axes[3 * row : 3 * row + 3]
        _about_largest(left, scale * history, abs(swing))
        left.set_ylabel(f"{label} ({unit})")
        low = density["frequency"] < HIGHEST
        middle.plot(density["frequency"][low], scale**2 * density[low], color=COLOURS[0])
        middle.set_ylabel(f"density (({unit})²/Hz)" if " " in unit else f"density ({unit}²/Hz)")
        _exceeded(right, swing)
        right.set_ylabel("share of peaks exceeding")
        right.set_xlabel(f"{label.split()[0]} − mean ({unit})")
        short = label.split()[0]
        worst[short] = float(abs(swing).max() / swing.std())
        panel_title(left, f"{short} about its largest")
        panel_title(middle, f"{short}, spectrum")
        panel_title(right, f"{short}, peaks: up to {worst[short]:.1f} σ")
    axes[6].set_xlabel(TIME)
    axes[7].set_xlabel("frequency (Hz)")
    axes[2].legend(fontsize="small", loc="lower left")
    headline(
        figure,
        f"The moment peaks at {worst['moment']:.1f}, tension at {worst['tension']:.1f} standard deviations",
    )
    return figure


def _at_ring(values: xr.DataArray) -> xr.DataArray:
    """At the riser's top, where it is over arclength."""
    return values.isel(s=-1, drop=True) if "s" in values.dims else values


def _about_largest(ax: Axes, history: xr.DataArray, size: xr.DataArray) -> None:
    middle = float(size.idxmax("time"))
    part = history.sel(time=slice(middle - SHOWN / 2.0, middle + SHOWN / 2.0))
    ax.plot(part["time"], part, color=COLOURS[0], linewidth=0.9)
    ax.axhline(float(history.mean()), color=GREY, linewidth=0.9)


def _exceeded(ax: Axes, swing: xr.DataArray) -> None:
    """Share of peaks above the mean, and below it, that exceed a size; Rayleigh's beside them."""
    largest = 0.0
    for colour, sign, label in ((COLOURS[0], 1.0, "above the mean"), (COLOURS[1], -1.0, "below")):
        sizes = np.sort(peaks(sign * swing.values))
        ax.step(sizes, 1.0 - np.arange(len(sizes)) / len(sizes), color=colour, label=label)
        largest = max(largest, float(sizes[-1]))
    over = np.linspace(0.0, largest, 100)
    rayleigh = np.exp(-0.5 * (over / float(swing.std())) ** 2)
    ax.plot(over, rayleigh, ":", color="black", label="Rayleigh")
    ax.set_yscale("log")
    ax.set_ylim(bottom=0.5 / len(sizes), top=1.5)
