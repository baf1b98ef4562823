"""Cost of accuracy in one picture: by tolerance, by code, and of finding the mesh and time step."""

from __future__ import annotations

import textwrap
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.text import Annotation
from matplotlib.ticker import FuncFormatter, NullFormatter, NullLocator

from chapters.numerics.answers import COMPARED, QUANTITIES, TOLERANCE, price, without_time
from chapters.numerics.figures.scenes import in_one_line, in_two_lines
from riserstudy.figures.direct import legible, spread
from riserstudy.figures.style import COLOURS, GREY, WIDE, WIDTH, headline
from riserstudy.records.arrays import FloatArray

TICKS = (0.05, 0.01, 0.002, 0.0005)  # tolerances of the runs
WIDEST, FINEST = 0.07, 0.0002  # ends of the axis of errors
APART = 1.45  # least ratio between the heights of neighbouring names, and of the frame and the highest
ROOM = 1.4  # ratio of axes of errors with and without room for names of short lines at the left
NOTE = 0.45  # ratio of the lower end of the axis to the shortest time, above a note
LETTERS = 68  # of a line of a note
OURS = "riserstudy"
PAGE = WIDE * WIDTH  # inches


class Named(NamedTuple):
    """A line and its name."""

    x: FloatArray
    y: FloatArray
    name: str
    colour: str


def cost(accuracy: xr.Dataset) -> Figure:
    """Time over tolerance, single runs of codes, and ratio to the cheapest run."""
    figure = Figure((PAGE, 7.2), dpi=150, layout="constrained")
    placed = figure.subplot_mosaic(
        [["a", "a"], ["b", "c"]], width_ratios=[1.25, 1.0], height_ratios=[1.0, 1.25]
    )
    tolerances, runs, ratios = (placed[letter] for letter in "abc")
    lines = {tolerances: _tolerances(tolerances, accuracy), runs: _runs(runs, accuracy)}
    _ratios(ratios, accuracy)
    headline(figure, answer(accuracy))
    for ax, named in lines.items():
        _label_ends(ax, named)
    figure.draw_without_rendering()  # computes the layout of the panels
    for ax, named in lines.items():
        _label_short(ax, named)
    return figure


def answer(accuracy: xr.Dataset) -> str:
    """Title: largest ratio of times between two tolerances that all scenes met."""
    found = price(accuracy)
    if found is None:
        return "Run time for each tolerance"
    finer = f"{found.coarse / found.fine:.0f} times finer"
    return f"A tolerance {finer} takes up to {found.high:.2g} times as long"


def _tolerances(ax: Axes, accuracy: xr.Dataset) -> list[Named]:
    """Draw the time of all runs over the tolerance, one line per scene; the names have the scene's ratio."""
    found = price(accuracy)
    lines: list[Named] = []
    for scene in _scenes(accuracy):
        here = accuracy["request_scene"].values == scene
        requested, seconds = (accuracy["requested"].values[here], accuracy["request_seconds"].values[here])
        order = np.argsort(-requested)
        x, y = requested[order], seconds[order]
        if not np.isfinite(y).any():
            continue
        colour = _colour(accuracy, scene)
        ax.plot(x, y, "o-", color=colour, linewidth=1.6, markersize=4)
        ratio = ""
        if found and {found.coarse, found.fine} <= set(x[np.isfinite(y)].tolist()):
            ratio = f": {float(y[x == found.fine][0] / y[x == found.coarse][0]):.1f} times"
        good = np.isfinite(y)
        lines.append(Named(x[good], y[good], in_one_line(scene) + ratio, colour))
    if left := without_time(accuracy):
        words = f"no line: {', '.join(map(in_one_line, left))}, over the time limit"
        ax.text(
            0.02, 0.02, textwrap.fill(words, LETTERS), transform=ax.transAxes, fontsize="small", color="0.35",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0},
        )  # fmt: skip
    for tolerance in (found.coarse, found.fine) if found else ():
        ax.axvline(tolerance, color="0.5", linestyle=":", linewidth=1.0, zorder=0)
    _time_over_error(ax, FINEST / 40.0)  # room for names at the right
    if left and lines:
        ax.set_ylim(bottom=NOTE * min(line.y.min() for line in lines))
    ax.set_xlabel("tolerance (%): more accurate →")
    ax.set_ylabel("elapsed time of all runs (s)")
    between = f"; numbers: time at {100 * found.fine:g} % / time at {100 * found.coarse:g} %" if found else ""
    ax.set_title(f"(a) time to meet a tolerance{between}", loc="left", fontsize="small")
    return lines


def _time_over_error(ax: Axes, end: float) -> None:
    """Set axes of time over error, from the widest error to the right end, both logarithmic."""
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlim(WIDEST, end)
    _percent_ticks(ax)
    ax.yaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.grid(True, color="0.92", linewidth=0.6)
    ax.set_axisbelow(True)


def _percent_ticks(ax: Axes) -> None:
    """Set ticks of errors at usual tolerances, in per cent."""
    ticks = [tick for tick in TICKS if FINEST < tick < WIDEST]
    ax.set_xticks(ticks, [f"{100 * tick:g}" for tick in ticks])
    ax.xaxis.set_minor_locator(NullLocator())


def _runs(ax: Axes, accuracy: xr.Dataset) -> list[Named]:
    """Draw the cheapest single runs of one scene by riserstudy and other codes, over displacement error."""
    scenes = list(dict.fromkeys(map(str, accuracy.get("peer_scene", accuracy["scene"]).values)))
    scene = scenes[0]
    single = lowest_cost(accuracy.sel(scene=scene))
    inside = single[(single[:, 0] < WIDEST) & (single[:, 0] > FINEST)]
    names: list[Named] = []
    if len(inside):
        colour = _colour(accuracy, scene)
        ax.plot(*inside.T, "o-", color=colour, linewidth=3.0, markersize=5, zorder=3)
        names.append(Named(inside[:, 0], inside[:, 1], OURS, colour))
    for peer, error, ratio in _peers(accuracy, scene):
        seconds = _at(single, error) * ratio
        good = np.isfinite(seconds)
        if good.any():
            ax.plot(error[good], seconds[good], "o-", color=GREY, linewidth=1.4, markersize=3)
            there = np.isclose(error, COMPARED)
            times = f": {ratio[there][0]:g} times" if there.any() else ""
            names.append(Named(error[good], seconds[good], peer + times, "0.35"))
    ax.axvline(COMPARED, color="0.5", linestyle=":", linewidth=1.0, zorder=0)
    compared_with = _at(single, np.array([COMPARED]))
    if names[1:] and np.isfinite(compared_with).all():
        style: dict[str, Any] = {"ms": 10, "mfc": "white", "mec": _colour(accuracy, scene), "mew": 2.0}
        ax.plot(COMPARED, compared_with, "o", zorder=4, **style)
        ax.annotate("1", (COMPARED, compared_with[0]), ha="center", va="center", fontsize="small", zorder=5)
    _time_over_error(ax, FINEST / 50.0)
    ax.set_xlim(left=ROOM * WIDEST)
    ax.set_xlabel("true error of displacement (%):\nmore accurate →")
    ax.set_ylabel("elapsed time of one run (s)")
    compared = f";\nnumbers: time divided by the time of {OURS} at {100 * COMPARED:g} %" if names[1:] else ""
    ax.set_title(f"(b) time of a single run, {in_one_line(scene)}{compared}", loc="left", fontsize="small")
    return names


def _peers(accuracy: xr.Dataset, scene: str) -> list[tuple[str, FloatArray, FloatArray]]:
    """Other codes: errors, and their time divided by riserstudy's time at an equal error."""
    if "peer_scene" not in accuracy:
        return []
    here = accuracy["peer_scene"].values == scene
    found = []
    for peer in dict.fromkeys(accuracy["peer"].values[here]):
        of = here & (accuracy["peer"].values == peer)
        found.append((str(peer), accuracy["peer_error"].values[of], accuracy["peer_ratio"].values[of]))
    return found


def _at(single: FloatArray, error: FloatArray) -> FloatArray:
    """Interpolate riserstudy's time (s) at given errors between runs; NaN outside their range."""
    if not len(single):
        return np.full(len(error), np.nan)
    x, y = np.log(single[::-1]).T
    return np.asarray(np.exp(np.interp(np.log(error), x, y, left=np.nan, right=np.nan)))


def _is_short(line: Named, lines: list[Named]) -> bool:
    return bool(line.x[-1] > 2.0 * min(other.x[-1] for other in lines))


def _label_ends(ax: Axes, lines: list[Named]) -> None:
    """Write names at the ends of lines that are not short, apart from each other and below the frame."""
    whole = [line for line in lines if not _is_short(line, lines)]
    if not whole:
        return
    ends = np.log([line.y[-1] for line in whole])
    for line, level in zip(whole, spread(ends, np.full(len(ends), np.log(APART))), strict=True):
        _write(ax, line, (line.x[-1], float(np.exp(level))), (7, 0), "left", "center")
        bottom, top = ax.get_ylim()
        ax.set_ylim(min(bottom, np.exp(level) / APART), max(top, APART * np.exp(level)))


def _label_short(ax: Axes, lines: list[Named]) -> None:
    """Write the names of short lines where they cover the fewest lines and names: best to the left.

    The layout of the panels must be known.
    """
    for line in [line for line in lines if _is_short(line, lines)]:
        line = line._replace(name=line.name.replace(": ", ":\n"))  # a narrow text covers less
        first, last = (line.x[0], line.y[0]), (line.x[-1], line.y[-1])
        places: list[tuple[Any, ...]] = [
            (first, (-7, 0), "right", "center"), (last, (7, 0), "left", "center"),
            (last, (0, 6), "center", "bottom"), (last, (0, -6), "center", "top"),
            (first, (0, -6), "left", "top"),
        ]  # fmt: skip
        covered = []
        for place in places:
            text = _write(ax, line, *place)
            covered.append(_covered(ax, text))
            text.remove()
        _write(ax, line, *places[int(np.argmin(covered))])


def _write(
    ax: Axes, line: Named, at: tuple[float, float], offset: tuple[float, float], ha: str, va: str
) -> Annotation:
    return ax.annotate(
        line.name, at, xytext=offset, textcoords="offset points", ha=ha, va=va, fontsize="small",
        color=legible(line.colour), fontweight="bold" if line.name == OURS else "normal",
    )  # fmt: skip


def _covered(ax: Axes, text: Annotation) -> int:
    """Return the number of lines and other texts that a text covers; beyond the frame counts as all."""
    box = text.get_window_extent()
    if box.x0 < ax.bbox.x0 or box.x1 > ax.bbox.x1 or box.y0 < ax.bbox.y0 or box.y1 > ax.bbox.y1:
        return len(ax.lines) + len(ax.texts)
    lines = (line.get_transform().transform_path(line.get_path()) for line in ax.lines)
    others = (other.get_window_extent() for other in ax.texts if other is not text)
    return sum(path.intersects_bbox(box, filled=False) for path in lines) + sum(map(box.overlaps, others))


def lowest_cost(of: xr.Dataset) -> FloatArray:
    """Displacement error and time (s) of the runs with a smaller error than all faster runs, (n, 2)."""
    error, seconds = of["error_displacement"].values.ravel(), of["wall_seconds"].values.ravel()
    good = np.isfinite(error) & np.isfinite(seconds) & (error > 0.0)
    runs = sorted(zip(seconds[good], error[good], strict=True))
    kept: list[tuple[float, float]] = []
    for time, wrong in runs:
        if not kept or wrong < kept[-1][0]:
            kept.append((wrong, time))
    return np.array(kept, float).reshape(-1, 2)


def _ratios(ax: Axes, accuracy: xr.Dataset) -> None:
    """Draw the time with a tolerance, of all runs and of the last, divided by the cheapest equal run's."""
    drawn: list[str] = []
    without: list[str] = []
    for scene in _scenes(accuracy):
        every, last, missing = over_lowest_cost(accuracy, scene)
        if missing:
            without.append(f"{in_one_line(scene)} ({missing})")
            continue
        k = len(drawn)
        drawn.append(scene)
        ax.barh(k, every, height=0.62, color=_colour(accuracy, scene), alpha=0.4)
        ax.barh(k, last, height=0.3, color=_colour(accuracy, scene))
        ax.annotate(f" {every:.1f} times", (every, k), va="center", fontsize="small", color="0.25")
    if drawn:
        ax.plot([1.0, 1.0], [-0.9, len(drawn) - 0.4], color="black", linewidth=0.8)
        ax.text(1.05, -0.5, "cheapest single run", va="bottom", fontsize="small", color="0.25")
        key = [Patch(color=GREY, alpha=0.4, label="all runs"), Patch(color=GREY, label="last run only")]
        ax.legend(handles=key, loc="upper right", ncols=2, fontsize="small", frameon=False, borderaxespad=0.2)
    if without:
        note = textwrap.fill(f"no bar: {'; '.join(without)}", LETTERS // 2)
        ax.text(0.02, 0.03, note, transform=ax.transAxes, fontsize="small", color="0.35")
    ax.set_yticks(range(len(drawn)), [in_two_lines(scene) for scene in drawn], fontsize="small")
    ax.set_ylim(len(drawn) - 0.4 + (1.4 if without else 0.0), -1.5)  # room for the key and the note
    ax.margins(x=0.32)
    ax.set_xlabel("time / time of the cheapest\nsingle run within the tolerance")
    ax.set_title(
        f"(c) time to find mesh and time step for {100 * TOLERANCE:g} %", loc="left", fontsize="small"
    )


def _colour(accuracy: xr.Dataset, scene: str) -> str:
    """Colour of a scene in all panels."""
    scenes = _scenes(accuracy)
    return COLOURS[scenes.index(scene) % len(COLOURS) if scene in scenes else 0]


def _scenes(accuracy: xr.Dataset) -> list[str]:
    return list(dict.fromkeys(map(str, accuracy["request_scene"].values)))


def over_lowest_cost(accuracy: xr.Dataset, scene: str) -> tuple[float, float, str]:
    """Ratios of the time of all runs, and of the last, at 1 % tolerance, to an equally accurate cheapest run.

    The run compared with has no larger error than the run to the tolerance, or than 1 %. The third value is
    the reason why there is no ratio, or "".
    """
    here = accuracy["request_scene"].values == scene
    here &= np.isclose(accuracy["requested"].values, TOLERANCE)
    of = accuracy.isel(request=np.flatnonzero(here))
    if not of.sizes["request"] or not np.isfinite(of["request_seconds"][0]):
        return np.nan, np.nan, "over the time limit"
    if scene not in accuracy["scene"].values:
        return np.nan, np.nan, "no single runs"
    reached = np.array([float(of[f"reached_{q}"][0]) for q in QUANTITIES])
    runs = accuracy.sel(scene=scene)
    error = np.stack([runs[f"error_{q}"].values.ravel() for q in QUANTITIES])
    compared = np.isfinite(reached)
    worst = np.where(np.isfinite(error), error, -np.inf)[compared].max(axis=0, initial=-np.inf)
    seconds = runs["wall_seconds"].values.ravel()
    allowed = max(TOLERANCE, reached[compared].max(initial=0.0))
    good = np.isfinite(seconds) & np.isfinite(worst) & (worst <= allowed)
    if not good.any() or not compared.any():
        return np.nan, np.nan, "no single run is as accurate"
    least = seconds[good].min()
    every, last = (float(of[f"request_{name}"][0]) for name in ("seconds", "last_seconds"))
    return every / least, last / least, ""
