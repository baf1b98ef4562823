"""Effects of length, tension ratio and buoyant factor."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from chapters.fem_riser.along import (
    amplitude_at,
    angles,
    drift_rate,
    measures,
    period_of,
    stress_factor,
    without_drift,
)
from chapters.fem_riser.claims import BEAM, LUMPED
from chapters.fem_riser.figures.shared import ANGLE, BLACK, BLUE, DEFLECTION, HEIGHT, RED, STRESS
from riserstudy.figures.insets import enlarge
from riserstudy.figures.style import GREY, headline, legend_below, panel_title, panels
from riserstudy.records.words import listed

TOP = 100.0  # m, length of the enlarged part of the stress
TICK_ROOM = 0.15  # share of an enlarged part, from its sides, without tick labels
FILL = 0.25  # opacity of ranges, of which three overlap
APART = "amplitude or drift (m)"
SEEN = 3e-3  # m, of vibration and drift: below it, lines show errors of the mesh
DRIFTS = 0.01  # m, least maximum of a drift that is shown; smaller drifts change sign
TITLES = ("deflection", "stress", "angle", "vibration and drift")
SIMPLE = {0.5: ("halves", "halving"), 2.0: ("doubles", "doubling"), 3.0: ("triples", "tripling")}
ABOUT = 0.1  # largest relative difference of a ratio from the ratio in a title


def fig06(length_500: xr.Dataset, length_1000: xr.Dataset, length_1500: xr.Dataset) -> Figure:
    """Three lengths; in the colours of the text, if it states them."""
    runs = (length_500, length_1000, length_1500)
    cases = {f"riser of {float(of['s_node'][-1]):g} m": of for of in runs}
    figure = envelopes(cases, (BLUE, BLACK, RED))
    changed = _ratios(length_500, length_1500)
    longer = float(length_1500["s_node"][-1] / length_500["s_node"][-1])
    deflection, vibration = (_multiplies(changed[of]) for of in ("deflection", "vibration"))
    headline(
        figure,
        f"{_multiplies(longer, 'ing').capitalize()} the length {deflection} the deflection "
        f"and {vibration} the vibration",
    )
    return figure


def fig07(tension_ratio: xr.Dataset) -> Figure:
    """Three top tension ratios; red as in the text, the base case blue as in Figs 5 and 8."""
    cases = _each(tension_ratio, "tension_ratio", "top tension ratio")
    figure = envelopes(cases, (BLACK, BLUE, RED))
    headline(figure, f"More top tension {_changes(tension_ratio, 'tension_ratio')}")
    colours = (BLACK, BLUE, RED)
    _stresses(figure.axes[1], tension_ratio, colours)
    _top(figure.axes[1], (0.03, 0.5, 0.39, 0.32), float(tension_ratio["s_node"][-1]))
    _vibrations(figure.axes[3], tension_ratio, colours)
    return figure


def _vibrations(ax: Axes, runs: xr.Dataset, colours: tuple[str, ...]) -> None:
    """Write the largest vibration of each case by the paper's beam."""
    found = measures(runs.sel(solver=BEAM))["vibration"]
    _listed(ax, "vibration\n(m):", [f"{float(value):#.2g}" for value in found], colours, (0.04, 0.3))


def _stresses(ax: Axes, runs: xr.Dataset, colours: tuple[str, ...]) -> None:
    """Write the largest stress of each case by the paper's beam, with the estimated error of its moment."""
    beam = runs.sel(solver=BEAM)
    stress = 1e-6 * measures(beam)["stress"]
    pairs = zip(stress.values, (stress * beam["error_moment"]).values, strict=True)
    rows = [f"{value:.1f} ± {error:.1f}" for value, error in pairs]
    _listed(ax, "largest ±\nerror\n(MPa):", rows, colours, (0.63, 0.57))


def _listed(
    ax: Axes, head: str, texts: list[str], colours: tuple[str, ...], place: tuple[float, float]
) -> None:
    """Write a value of each case below a heading at a place (axes fractions)."""
    across, up = place
    rows = zip(texts, colours, strict=True)
    for k, (text, colour) in enumerate([(head, BLACK), *rows]):
        ax.annotate(text, (across, up - 0.055 * k), xycoords="axes fraction", color=colour,
                    va="bottom" if k == 0 else "center", fontsize="x-small")  # fmt: skip


def fig08(buoyant_factor: xr.Dataset) -> Figure:
    """Three buoyant factors; black as in the text, the base case blue as in Figs 5 and 7."""
    cases = _each(buoyant_factor, "buoyant_factor", "buoyant factor")
    figure = envelopes(cases, (RED, BLUE, BLACK))
    headline(figure, f"A higher buoyant factor {_changes(buoyant_factor, 'buoyant_factor')}")
    _stresses(figure.axes[1], buoyant_factor, (RED, BLUE, BLACK))
    _vibrations(figure.axes[3], buoyant_factor, (RED, BLUE, BLACK))
    _top(figure.axes[1], (0.03, 0.5, 0.39, 0.32), float(buoyant_factor["s_node"][-1]))
    return figure


def _top(ax: Axes, place: tuple[float, float, float, float], length: float) -> None:
    """Enlarge the top of a panel of stress in its free area, where ranges are narrow and overlap."""
    ends = [np.asarray(line.get_data(), dtype=float) for line in ax.lines]
    x = np.concatenate([of[0][of[1] >= length - TOP] for of in ends])
    margin = 0.06 * float(x.max() - x.min())
    inset = enlarge(ax, place, (x.min() - margin, x.max() + margin), (length - TOP, length + 0.03 * TOP))
    inset.set_yticks([])
    inset.xaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    low, high = inset.get_xlim()
    room = TICK_ROOM * (high - low)  # labels at the edge would cross the frame of the panel
    inset.set_xticks([tick for tick in inset.get_xticks() if low + room < tick < high - room])
    inset.set_title(f"upper {TOP:g} m", fontsize="x-small", pad=2.0)


def _multiplies(ratio: float, ending: str = "s") -> str:
    """A ratio as a verb, if within 10 % of a simple ratio: halves, tripling; else with its number."""
    for simple, verbs in SIMPLE.items():
        if abs(ratio / simple - 1.0) < ABOUT:
            return verbs[ending == "ing"]
    return f"{'multiplying' if ending == 'ing' else 'multiplies'} by {ratio:.2g}"


def _changes(runs: xr.Dataset, axis: str) -> str:
    """Title: results that decrease, and results that increase, throughout an axis, by the paper's beam."""
    found = measures(runs.sel(solver=BEAM)).sortby(axis)
    ways: dict[str, list[str]] = {"decreases": [], "increases": []}
    for name in ("deflection", "stress", "angle", "vibration"):
        steps = found[name].diff(axis)
        for word, sign in (("decreases", -1.0), ("increases", 1.0)):
            if bool((sign * steps > 0.0).all()):
                ways[word].append(name)
    phrases = [f"{word} {listed(names)}" for word, names in ways.items() if names]
    return ", and ".join(phrases) or "changes no result throughout"


def _ratios(first: xr.Dataset, last: xr.Dataset) -> dict[str, float]:
    """Ratios of the last case to the first, of deflection and vibration, by the paper's beam."""
    old, new = (measures(runs.sel(solver=BEAM)) for runs in (first, last))
    return {name: float(new[name] / old[name]) for name in ("deflection", "vibration")}


def _each(runs: xr.Dataset, axis: str, word: str) -> dict[str, xr.Dataset]:
    return {f"{word} {value:g}": runs.sel({axis: value}) for value in runs[axis].values}


def envelopes(cases: Mapping[str, xr.Dataset], colours: tuple[str, ...]) -> Figure:
    """Panels (a) to (c) of Figs 5 to 8; (d) vibration, and the drift, which (a) excludes."""
    figure, axes = panels(1, 4, 4.2, sharey=True)
    pairs = list(zip(colours, cases.values(), strict=True))
    # the widest first, because the other ranges are within it
    pairs.sort(key=lambda pair: -float(abs(pair[1]["bending_moment_min"].sel(solver=BEAM)).max()))
    for colour, runs in pairs:
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
    for ax, label, title in zip(axes, (DEFLECTION, STRESS, ANGLE, APART), TITLES, strict=True):
        ax.set_xlabel(label)
        panel_title(ax, title)
    _frame(axes, max(float(runs["s_node"][-1]) for runs in cases.values()))
    known: dict[str, Any] = {
        name: Patch(facecolor=to_rgba(colour, FILL), edgecolor=colour)
        for name, colour in zip(cases, colours, strict=False)
    }
    dotted = Line2D([], [], color=GREY, linewidth=1.2, linestyle=":")
    known |= {
        "(d) vibration, beam": Line2D([], [], color=GREY, linewidth=0.9),
        "(a–d) lumped masses": Line2D([], [], color=GREY, linewidth=0.9, linestyle="--"),
        f"(d) drift, if its maximum exceeds {100.0 * DRIFTS:g} cm; removed from (a)": dotted,
    }
    legend_below(figure, [*known.values()], [*known], 3)
    (legend,) = figure.legends
    legend.set_title(
        "(a–c) range in 261 to 300 s by the beam; narrow ranges are lines", FontProperties(size="small")
    )
    return figure


def _around_largest(values: xr.DataArray) -> xr.DataArray:
    """Values around the largest, up to the first value below the visible range on both sides."""
    seen = values.values >= SEEN
    most = int(values.argmax("s"))
    below, above = np.flatnonzero(~seen[:most]), np.flatnonzero(~seen[most:])
    start = int(below[-1]) if below.size else 0
    end = most + int(above[0]) if above.size else seen.size - 1
    return values.isel(s=slice(start, end + 1))


def _frame(axes: list[Axes], length: float) -> None:
    """Set limits around all curves, with room at both ends of the riser, where stresses peak."""
    axes[0].set_ylabel(HEIGHT)
    axes[0].set_ylim(-0.03 * length, 1.03 * length)
    for ax in axes[:3]:
        ax.margins(x=0.08)
    axes[3].set_xscale("log")
    axes[3].set_xlim(left=SEEN)
    ticks = [tick for tick in (0.01, 0.1, 1.0) if tick <= axes[3].get_xlim()[1]]
    axes[3].set_xticks(ticks, [f"$10^{{{np.log10(tick):.0f}}}$" for tick in ticks])
    low, high = axes[2].get_xlim()  # no label at its end, next to the first label of the next panel
    axes[2].set_xticks([t for t in axes[2].get_xticks() if low < t < high - 0.05 * (high - low)])


def _envelope(
    ax: Axes, low: xr.DataArray, high: xr.DataArray, s: xr.DataArray, colour: str, *, filled: bool
) -> None:
    """Range along the riser: filled with an outline, or a dashed outline alone."""
    if filled:
        ax.fill_betweenx(s, low, high, color=colour, alpha=FILL, linewidth=0)  # below all outlines
    style: dict[str, Any] = {"linewidth": 0.6} if filled else {"linewidth": 0.8, "linestyle": "--"}
    around = np.concatenate([low.values, high.values[::-1], low.values[:1]])
    heights = np.concatenate([s.values, s.values[::-1], s.values[:1]])
    ax.plot(around, heights, color=colour, **style)
