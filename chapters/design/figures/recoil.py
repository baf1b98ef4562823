"""Design, recoil: settings that allow a safe emergency disconnect, and the response at three settings."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, hsv_to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator
from scipy.interpolate import PchipInterpolator

from riserstudy.dataset.clearance import TOUCHING
from riserstudy.dataset.provenance import scene_of_point
from riserstudy.figures.direct import label_ends
from riserstudy.figures.style import COLOURS, GREY, headline, panel_title, panels, shades

LABELS = (
    "clear of BOP and end stops",
    "LMRP re-contacts the BOP",
    "cylinders stroke out",
    "re-contact and stroke-out, at equal or different heave phases",
)
QUIET = (0.65, 0.72)  # saturation and value of colours in a circle
BEFORE = 5.0  # s, shown before the first disconnect
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
        clear = _smallest(one).transpose("gas_pressure", "heave_amplitude")
        for (row, column), value in np.ndenumerate(clear.values):
            ax.text(column, row, _metres(value), ha="center", va="center", fontsize="x-small")
        panel_title(ax, f"mud density {mud:g} kg/m³; smallest clearance (m)")
        ax.set_xlabel("heave amplitude (m)")
    for ax in axes[::columns]:
        ax.set_ylabel("tension setting (MN)")
    _key(figure, recoil_outcome["recoil_verdict"])
    headline(figure, _answer(recoil_outcome))
    return figure


def _smallest(outcome: xr.Dataset) -> xr.DataArray:
    """Smallest clearance of all phases (m); an LMRP that never lifts off has none."""
    return outcome["clearance_min"].fillna(0.0).min("phase")


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
    lines: list[list[Line2D]] = [[], []]
    for colour, pressure in zip(shades(COLOURS[0], len(pressures)), pressures, strict=True):
        at = one.sel(gas_pressure=pressure)
        setting = float(at["tensioner_force_static"].sum()) / tension_ratio
        name = f"{setting / 1e6:.2f} MN"
        lines[0] += up.plot(at["time"], at["lift"], color=colour, label=name)
        lines[1] += stroke.plot(at["time"], at["tensioner_stroke"].isel(cylinder=0), color=colour, label=name)
    _mark(up, stroke, lines[0], _end_stop(recoil))
    up.set_ylabel("LMRP lift above the BOP (m)")
    stroke.set_ylabel("cylinder stroke, + extended (m)")
    for ax in (up, stroke):
        ax.set_xlabel("time (s)")
    highest = [float(one.sel(gas_pressure=p)["lift"].max()) for p in pressures]
    panel_title(up, "LMRP lift, by tension setting")
    panel_title(stroke, "cylinder stroke, by tension setting")
    change = "increases" if highest[-1] > highest[0] else "decreases"
    lifts = f"from {highest[0]:.1f} to {highest[-1]:.1f} m"
    headline(figure, f"A higher tension setting {change} the largest LMRP lift {lifts}")
    label_ends(up, lines[0])
    label_ends(stroke, lines[1])
    return figure


def _end_stop(recoil: xr.Dataset) -> float | None:
    """Shortest stroke of the cylinders (m), None if they have no ends."""
    tensioners = scene_of_point(recoil, dict.fromkeys(map(str, recoil["point_key"].dims), 0)).top.tensioners
    return tensioners.stroke.shortest if tensioners and tensioners.stroke else None


def _mark(up: Axes, stroke: Axes, lifts: list[Line2D], end: float | None) -> None:
    """Mark the disconnect, the first re-contact, and the end stop of the cylinders."""
    rises, contacts = [], []
    for line in lifts:
        time, lift = (np.asarray(values, float) for values in line.get_data())
        first = int((lift > TOUCHING).argmax())
        rises.append(float(time[first]))
        contacts += [(float(time[k]), float(lift[k])) for k in range(first, len(lift)) if lift[k] < 0.0][:1]
    small: dict[str, Any] = {"textcoords": "offset points", "fontsize": "small", "color": "0.3"}
    for ax, height in ((up, 0.95), (stroke, 0.25)):
        ax.axvline(min(rises), color=GREY, linestyle=":", linewidth=1.0)
        ax.annotate(
            "disconnect",
            (min(rises), height),
            (-4, 0),
            xycoords=("data", "axes fraction"),
            ha="right",
            **small,
        )
    up.axhline(0.0, color="black", linewidth=0.6)
    if contacts:
        arrow = {"arrowstyle": "->", "color": "0.3", "linewidth": 0.8}
        up.annotate(
            "LMRP\nre-contacts\nthe BOP", min(contacts), (0.02, 0.28), textcoords="axes fraction",
            fontsize="small", color="0.3", arrowprops=arrow,
        )  # fmt: skip
    if end is not None and stroke.get_ylim()[0] < 0.9 * end:
        stroke.axhline(end, color=GREY, linestyle="--", linewidth=1.0)
        stroke.annotate("end stop", (0.02, end), (0, 4), xycoords=("axes fraction", "data"), **small)


def recoil_failures(recoil_failures_outcome: xr.Dataset) -> Figure:
    """Effects of failed units and valves, one panel per number of failed units."""
    units = recoil_failures_outcome["units"].values
    figure, axes = panels(1, len(units), 3.4, sharey=True)
    left = recoil_failures_outcome["valve_left_open"].values
    for ax, count in zip(axes, units, strict=True):
        one = recoil_failures_outcome.sel(units=count)
        _cells(ax, one["recoil_verdict"].transpose("gas_pressure", "valve_left_open").values)
        clear = _smallest(one).transpose("gas_pressure", "valve_left_open")
        for (row, column), value in np.ndenumerate(clear.values):
            ax.text(column, row, _metres(value), ha="center", va="center", fontsize="x-small")
        ax.set_xticks(range(len(left)), [f"{100 * x:g}" for x in left])
        ax.set_xlabel("residual valve opening (%)")
        failed = int(units.max() - count)
        panel_title(ax, f"{failed or 'no'} unit{'' if failed == 1 else 's'} failed; clearance (m)")
    pressures = recoil_failures_outcome["gas_pressure"].values
    axes[0].set_yticks(range(len(pressures)), [f"{p / 10:.1f}" for p in pressures])
    axes[0].set_ylabel("gas pressure, absolute (MPa)")
    _key(figure, recoil_failures_outcome["recoil_verdict"])
    headline(figure, _with_failures(recoil_failures_outcome["recoil_verdict"]))
    return figure


def _with_failures(verdict: xr.DataArray) -> str:
    """Title: outcome of the settings with the most failed units."""
    worst = verdict.sel(units=verdict["units"].min())
    clear = worst == 0
    count, failed = int(clear.sum()), int(verdict["units"].max() - verdict["units"].min())
    with_failed = f"With {failed} failed unit{'' if failed == 1 else 's'}"
    if bool(worst.isin([1, 3]).all()):
        return f"{with_failed}, the LMRP re-contacts the BOP at every tested setting"
    if count == 0:
        return f"{with_failed}, no tested setting avoids both re-contact and stroke-out"
    return f"{with_failed}, {100 * count / clear.size:.0f} % of the settings avoid re-contact and stroke-out"


def _first_rise(line: Line2D) -> tuple[float, float] | None:
    """Time and lift of the first sample of a line at which the LMRP is off the BOP, or None."""
    time, lift = (np.asarray(values, float) for values in line.get_data())
    off = np.flatnonzero(lift > TOUCHING)
    return (float(time[off[0]]), float(lift[off[0]])) if len(off) else None


def _name_highest(ax: Axes) -> None:
    """Write the largest lift of all lines at its place."""
    points = np.concatenate([np.asarray(line.get_xydata(), float) for line in ax.lines])
    time, lift = points[points[:, 1].argmax()]
    ax.annotate(f"{lift:.0f} m", (time, lift), (0, 3), textcoords="offset points", ha="center", va="bottom",
                fontsize="small")  # fmt: skip


def recoil_systems(recoil_liu2020: xr.Dataset, recoil_mao: xr.Dataset) -> Figure:
    """Lift over time of two published systems."""
    figure, (liu, mao) = panels(1, 2, 3.6, sharey=True)
    heaves = recoil_liu2020["heave_amplitude"].values
    one = recoil_liu2020["lift"].sel(heave_amplitude=heaves[len(heaves) // 2])
    rises = []
    for phase in one["phase"].values:
        colour = hsv_to_rgb((float(phase) / 360.0 % 1.0, *QUIET))
        at = one.sel(phase=phase)
        (line,) = liu.plot(one["time"], at, color=colour, linewidth=1.3, label=f"{phase:g}°")
        if rise := _first_rise(line):
            rises.append(rise[0])
            liu.plot(*rise, "o", color=colour, markersize=5, zorder=3)
    panel_title(liu, f"lift by heave phase, Liu et al. 2020, heave of {heaves[len(heaves) // 2]:g} m")
    liu.text(
        0.04,
        0.93,
        "dots: disconnect at the heave phase of the line",
        fontsize="small",
        transform=liu.transAxes,
    )
    tensions = recoil_mao["top_tension"].values
    fine = np.linspace(float(recoil_mao["time"][0]), float(recoil_mao["time"][-1]), FINE)
    for shade, tension in zip(shades(COLOURS[0], len(tensions)), tensions, strict=True):
        at = recoil_mao["lift"].sel(top_tension=tension)
        lift = PchipInterpolator(at["time"], at)(fine)
        mao.plot(fine, lift, color=shade, linewidth=1.3, label=f"{tension / 1e3:.1f} MN")
    panel_title(mao, "lift by top tension, Mao et al., no heave")
    liu.set_ylim(top=1.1 * max(float(of.max()) for of in (one, recoil_mao["lift"])))  # room for a number
    liu.yaxis.set_major_locator(MaxNLocator(10, integer=True))
    for ax in (liu, mao):
        _name_highest(ax)
        ax.axhline(0.0, color="black", linewidth=0.6)
        ax.set_xlabel("time (s)")
    liu.set_ylabel("LMRP lift above the BOP (m)")
    high = float(one.max("time").max()), float(recoil_mao["lift"].max())
    headline(figure, f"The LMRP rises by up to {high[0]:.0f} m (Liu et al.) and {high[1]:.0f} m (Mao et al.)")
    for ax in (liu, mao):
        label_ends(ax)
    if rises:
        liu.set_xlim(left=max(0.0, min(rises) - BEFORE))
    return figure
