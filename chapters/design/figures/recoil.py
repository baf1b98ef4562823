"""Design, recoil: settings that allow a safe emergency disconnect, and the response at three settings."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, hsv_to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from scipy.interpolate import PchipInterpolator

from riserstudy.figures.direct import label_ends
from riserstudy.figures.style import COLOURS, headline, panel_title, panels, shades

LABELS = ("clear of BOP and end stops", "LMRP re-contacts the BOP", "cylinders stroke out", "both, by phase")
QUIET = (0.65, 0.72)  # saturation and value of colours in a circle
FINE = 2000  # points of a smooth curve through samples
FILL = ("#9fd8bd", "#f5c9a0", "#a9c9e8", "#d3a9c4")


def recoil_window(recoil_outcome: xr.Dataset, tension_ratio: float) -> Figure:
    """Outcome of the worst phase over heave and tension setting, one panel per mud density."""
    muds = recoil_outcome["mud_weight"].values
    columns = min(2, len(muds))
    figure, axes = panels(-(-len(muds) // columns), columns, 3.2, sharey=True)
    heaves = recoil_outcome["heave_amplitude"].values
    for ax, mud in zip(axes, muds, strict=True):
        one = recoil_outcome.sel(mud_weight=mud)
        _cells(ax, one["recoil_verdict"].transpose("gas_pressure", "heave_amplitude").values)
        ax.set_xticks(range(len(heaves)), [f"{h:g}" for h in heaves])
        setting = one["setting"].values / tension_ratio / 1e6
        ax.set_yticks(range(len(setting)), [f"{t:.2f}" for t in setting])
        clear = one["clearance_min"].min("phase").transpose("gas_pressure", "heave_amplitude")
        for (row, column), value in np.ndenumerate(clear.values):
            ax.text(column, row, _metres(value), ha="center", va="center", fontsize="x-small")
        panel_title(ax, f"mud of {mud:g} kg/m³; numbers: smallest clearance (m)")
        ax.set_xlabel("heave amplitude (m)")
    for ax in axes[::columns]:
        ax.set_ylabel("tension setting (MN)")
    _key(figure, recoil_outcome["recoil_verdict"])
    headline(figure, _answer(recoil_outcome))
    return figure


def _metres(clearance: float) -> str:
    """Format a clearance (m) with one decimal, or with two where one would show zero without contact."""
    return f"{clearance:.{2 if 0.0 < clearance < 0.05 else 1}f}" if clearance > 0.0 else "0.0"


def _cells(ax: Axes, verdict: np.ndarray) -> None:
    """Draw one cell per value from its edges, because the centre of a single row defines no height."""
    ax.grid(False)
    rows, columns = (np.arange(size + 1) - 0.5 for size in verdict.shape)
    ax.pcolormesh(columns, rows, verdict, cmap=ListedColormap(FILL), vmin=-0.5, vmax=3.5)


def _key(figure: Figure, verdict: xr.DataArray) -> None:
    """Write a key of the outcomes that occur."""
    there = [kind for kind in range(len(LABELS)) if bool((verdict == kind).any())]
    handles = [Patch(color=FILL[kind], label=LABELS[kind]) for kind in there]
    figure.legend(handles=handles, loc="outside lower center", ncols=2, fontsize="small")


def _answer(of: xr.Dataset) -> str:
    """Title: largest heave up to which a tested setting allows a disconnect at every phase, in every mud."""
    serves = (of["recoil_verdict"] == 0).any("gas_pressure")
    heaves = of["heave_amplitude"].values
    every = serves.all("mud_weight").values
    if not every[0]:
        some = heaves[serves.any("mud_weight").values]
        if not len(some):
            return "No tested tension setting allows a safe disconnect at any heave amplitude"
        return f"Above {some.max():g} m heave amplitude, no tested tension setting allows a safe disconnect"
    largest = heaves[np.logical_and.accumulate(every)].max()
    return f"Up to {largest:g} m heave amplitude, a tested tension setting allows a safe disconnect"


def recoil_histories(recoil: xr.Dataset, tension_ratio: float) -> Figure:
    """Lift and stroke after the disconnect for the lowest, a middle and the highest setting."""
    mud = recoil["mud_weight"].values[len(recoil["mud_weight"]) // 2]
    heave = recoil["heave_amplitude"].values[len(recoil["heave_amplitude"]) // 2]
    phase = recoil["phase"].values[0]
    one = recoil.sel(mud_weight=mud, heave_amplitude=heave, phase=phase)
    pressures = one["gas_pressure"].values[[0, len(one["gas_pressure"]) // 2, -1]]
    figure, (up, stroke) = panels(1, 2, 3.6)
    for colour, pressure in zip(COLOURS, pressures, strict=False):
        at = one.sel(gas_pressure=pressure)
        setting = float(at["tensioner_force_static"].sum()) / tension_ratio
        name = f"{setting / 1e6:.2f} MN"
        up.plot(at["time"], at["lift"], color=colour, label=name)
        stroke.plot(at["time"], at["tensioner_stroke"].isel(cylinder=0), color=colour, label=name)
    up.axhline(0.0, color="black", linewidth=0.6)
    up.set_ylabel("LMRP lift above the BOP (m)")
    stroke.set_ylabel("cylinder stroke, + extended (m)")
    for ax in (up, stroke):
        ax.set_xlabel("time (s)")
        ax.legend(title="tension setting", fontsize="small")
    highest = [float(one.sel(gas_pressure=p)["lift"].max()) for p in pressures]
    panel_title(up, f"mud of {mud:g} kg/m³, heave of {heave:g} m")
    panel_title(stroke, f"disconnect at {phase:g}° of heave")
    rises = "raises" if highest[-1] > highest[0] else "lowers"
    headline(figure, f"Higher tension {rises} the LMRP lift from {highest[0]:.1f} to {highest[-1]:.1f} m")
    return figure


def recoil_failures(recoil_failures_outcome: xr.Dataset) -> Figure:
    """Effects of failed units and valves, one panel per number of units."""
    units = recoil_failures_outcome["units"].values
    figure, axes = panels(1, len(units), 3.4, sharey=True)
    left = recoil_failures_outcome["valve_left_open"].values
    for ax, count in zip(axes, units, strict=True):
        one = recoil_failures_outcome.sel(units=count)
        _cells(ax, one["recoil_verdict"].transpose("gas_pressure", "valve_left_open").values)
        lift = one["lift_max"].max("phase").transpose("gas_pressure", "valve_left_open")
        for (row, column), value in np.ndenumerate(lift.values):
            ax.text(column, row, f"{value:.1f}", ha="center", va="center", fontsize="x-small")
        ax.set_xticks(range(len(left)), [f"{100 * x:g}" for x in left])
        ax.set_xlabel("opening left by the valves (%)")
        panel_title(ax, f"lift (m), {count:g} units at work")
    pressures = recoil_failures_outcome["gas_pressure"].values
    axes[0].set_yticks(range(len(pressures)), [f"{p / 10:.1f}" for p in pressures])
    axes[0].set_ylabel("gas pressure, absolute (MPa)")
    _key(figure, recoil_failures_outcome["recoil_verdict"])
    headline(figure, _with_failures(recoil_failures_outcome["recoil_verdict"]))
    return figure


def _with_failures(verdict: xr.DataArray) -> str:
    """Title: number of settings that keep clear of BOP and end stops with the most failed units."""
    most, fewest = int(verdict["units"].max()), int(verdict["units"].min())
    clear = verdict.sel(units=fewest) == 0
    count, failed = int(clear.sum()), most - fewest
    with_failed = f"With {failed} failed unit{'' if failed == 1 else 's'}"
    if count == 0:
        return f"{with_failed} no setting avoids both BOP and end stops"
    return f"{with_failed} {100 * count / clear.size:.0f} % of the settings avoid both BOP and end stops"


def recoil_systems(recoil_liu2020: xr.Dataset, recoil_mao: xr.Dataset) -> Figure:
    """Lift over time of two published systems."""
    figure, (liu, mao) = panels(1, 2, 3.6, sharey=True)
    heaves = recoil_liu2020["heave_amplitude"].values
    one = recoil_liu2020["lift"].sel(heave_amplitude=heaves[len(heaves) // 2])
    phases = []
    for phase in one["phase"].values:
        colour = hsv_to_rgb((float(phase) / 360.0 % 1.0, *QUIET))
        phases += liu.plot(
            one["time"], one.sel(phase=phase), color=colour, linewidth=1.3, label=f"{phase:g}°"
        )
    panel_title(liu, f"Liu et al. 2020, heave of {heaves[len(heaves) // 2]:g} m, by phase of disconnect")
    tensions = recoil_mao["top_tension"].values
    fine = np.linspace(float(recoil_mao["time"][0]), float(recoil_mao["time"][-1]), FINE)
    for shade, tension in zip(shades(COLOURS[0], len(tensions)), tensions, strict=True):
        at = recoil_mao["lift"].sel(top_tension=tension)
        lift = PchipInterpolator(at["time"], at)(fine)
        mao.plot(fine, lift, color=shade, linewidth=1.3, label=f"{tension / 1e3:.1f} MN")
    mao.legend(title="top tension", fontsize="small", title_fontsize="small", loc="upper right")
    panel_title(mao, "Mao et al., assumed valves")
    for ax in (liu, mao):
        ax.axhline(0.0, color="black", linewidth=0.6)
        ax.set_xlabel("time (s)")
    liu.set_ylabel("LMRP lift above the BOP (m)")
    high = float(one.max("time").max()), float(recoil_mao["lift"].max())
    headline(figure, f"The LMRP rises by up to {high[0]:.0f} m (Liu et al.) and {high[1]:.0f} m (Mao et al.)")
    label_ends(liu, phases)
    return figure
