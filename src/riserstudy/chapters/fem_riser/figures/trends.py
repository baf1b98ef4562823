"""What length, tension ratio and buoyant factor change."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from riserstudy.chapters.fem_riser.along import (
    amplitude_at,
    angles,
    drift_rate,
    measures,
    period_of,
    stress_factor,
    without_drift,
)
from riserstudy.chapters.fem_riser.claims import (
    BEAM,
    LUMPED,
)
from riserstudy.chapters.fem_riser.figures.shared import (
    ANGLE,
    BLACK,
    BLUE,
    DEFLECTION,
    HEIGHT,
    RED,
    STRESS,
)
from riserstudy.figures.style import (
    GREY,
    headline,
    legend_below,
    panels,
)

PALE = "#d0d0d0"  # of a range
APART = "vibration amplitude,\ndrift (m)"
SEEN = 1e-3  # m, of vibration and drift: below it lines show what the mesh leaves
DRIFTS = 10.0 * SEEN  # m, the least largest drift that is shown; others change sign


def fig06(length_500: xr.Dataset, length_1000: xr.Dataset, length_1500: xr.Dataset) -> Figure:
    """Three lengths; colours as the text has them, where it says."""
    runs = (length_500, length_1000, length_1500)
    cases = {f"riser of {float(of['s_node'][-1]):g} m": of for of in runs}
    figure = envelopes(cases, (BLUE, BLACK, RED))
    changed = _ratios(length_500, length_1500)
    headline(
        figure,
        f"Tripling the length gives {changed['deflection']:.1f} times the deflection, "
        f"{changed['vibration']:.1f} times the vibration",
    )
    return figure


def fig07(tension_ratio: xr.Dataset) -> Figure:
    """Three top tension ratios; red as the text has it, the base case blue as in Figs 5 and 8."""
    cases = _each(tension_ratio, "tension_ratio", "top tension ratio")
    figure = envelopes(cases, (BLACK, BLUE, RED))
    headline(figure, "More top tension lowers deflection, stress and angle")
    return figure


def fig08(buoyant_factor: xr.Dataset) -> Figure:
    """Three buoyant factors; black as the text has it, the base case blue as in Figs 5 and 7."""
    cases = _each(buoyant_factor, "buoyant_factor", "buoyant factor")
    figure = envelopes(cases, (RED, BLUE, BLACK))
    headline(figure, "A higher buoyant factor raises deflection, stress and angle")
    return figure


def _ratios(first: xr.Dataset, last: xr.Dataset) -> dict[str, float]:
    """What a case has of deflection and vibration over another, by the paper's beam."""
    old, new = (measures(runs.sel(solver=BEAM)) for runs in (first, last))
    return {name: float(new[name] / old[name]) for name in ("deflection", "vibration")}


def _each(runs: xr.Dataset, axis: str, word: str) -> dict[str, xr.Dataset]:
    return {f"{word} {value:g}": runs.sel({axis: value}) for value in runs[axis].values}


def envelopes(cases: Mapping[str, xr.Dataset], colours: tuple[str, ...]) -> Figure:
    """Panels (a) to (c) of Figs 5 to 8; (d) vibration, and drift, which (a) is freed of."""
    figure, axes = panels(1, 4, 4.2, sharey=True)
    for colour, runs in zip(colours, cases.values(), strict=True):
        factor = stress_factor(runs) / 1e6
        period = period_of(runs)
        for solver in (BEAM, LUMPED):
            run = runs.sel(solver=solver)
            x = run["x"].dropna("s", how="all")
            angle: xr.DataArray = xr.apply_ufunc(np.rad2deg, angles(run))
            nodes, length = run["s_node"], float(run["s_node"][-1])
            still = without_drift(x, period)
            low, high = (factor * run[f"bending_moment_{side}"] for side in ("min", "max"))
            fields = (
                (still.min("time"), still.max("time"), x["s"]),
                (low, high, nodes),
                (angle.min("time"), angle.max("time"), length * angle["middle"]),
            )
            for ax, (least, most, s) in zip(axes, fields, strict=False):
                _envelope(ax, least, most, s, colour, filled=solver == BEAM)
            line = "-" if solver == BEAM else "--"
            vibration = _around_largest(amplitude_at(x, period))
            axes[3].plot(vibration, vibration["s"], line, color=colour, linewidth=0.9)
            if solver == BEAM:
                span = float(x["time"][-1] - x["time"][0])
                drift = span * abs(drift_rate(x, period))
                if float(drift.max()) > DRIFTS:
                    drift = _around_largest(drift)
                    axes[3].plot(drift, drift["s"], ":", color=colour, linewidth=1.2)
    for ax, label in zip(axes, (DEFLECTION, STRESS, ANGLE, APART), strict=True):
        ax.set_xlabel(label)
    _frame(axes, max(float(runs["s_node"][-1]) for runs in cases.values()))
    known: dict[str, Any] = {
        name: Patch(facecolor=to_rgba(colour, 0.35), edgecolor=colour)
        for name, colour in zip(cases, colours, strict=False)
    }
    known |= {
        "(a–c) range in 261 to 300 s, beam": Patch(facecolor=PALE, edgecolor=GREY),
        "(d) vibration, beam": Line2D([], [], color=GREY, linewidth=0.9),
        "lumped masses": Line2D([], [], color=GREY, linewidth=0.9, linestyle="--"),
        "(d) drift, removed from (a)": Line2D([], [], color=GREY, linewidth=1.2, linestyle=":"),
    }
    legend_below(figure, [*known.values()], [*known], 4)
    return figure


def _around_largest(values: xr.DataArray) -> xr.DataArray:
    """Values along the riser from the largest to the first below what is seen, on either side."""
    seen = values.values >= SEEN
    most = int(values.argmax("s"))
    below, above = np.flatnonzero(~seen[:most]), np.flatnonzero(~seen[most:])
    start = int(below[-1]) if below.size else 0
    end = most + int(above[0]) if above.size else seen.size - 1
    return values.isel(s=slice(start, end + 1))


def _frame(axes: list[Axes], length: float) -> None:
    """Axes around all that is drawn, with room at both ends of the riser, where stresses peak."""
    axes[0].set_ylabel(HEIGHT)
    axes[0].set_ylim(-0.03 * length, 1.03 * length)
    for ax in axes[:3]:
        ax.margins(x=0.08)
    axes[3].set_xscale("log")
    axes[3].set_xlim(left=SEEN)
    ticks = [tick for tick in (SEEN, 0.01, 0.1, 1.0) if tick <= axes[3].get_xlim()[1]]
    axes[3].set_xticks(ticks, [f"$10^{{{np.log10(tick):.0f}}}$" for tick in ticks])


def _envelope(
    ax: Axes, low: xr.DataArray, high: xr.DataArray, s: xr.DataArray, colour: str, *, filled: bool
) -> None:
    """Range along the riser: filled within its outline, or the outline alone, dashed."""
    if filled:
        ax.fill_betweenx(s, low, high, color=colour, alpha=0.35, linewidth=0)
    style: dict[str, Any] = {"linewidth": 0.6} if filled else {"linewidth": 0.8, "linestyle": "--"}
    around = np.concatenate([low.values, high.values[::-1], low.values[:1]])
    heights = np.concatenate([s.values, s.values[::-1], s.values[:1]])
    ax.plot(around, heights, color=colour, **style)
