"""Run time of accuracy by method, and true errors of runs to a tolerance."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter
from numpy.typing import NDArray

from chapters.numerics.answers import without_time
from chapters.numerics.figures.methods import family_of, look_of, short_name
from chapters.numerics.figures.scenes import in_one_line
from riserstudy.figures.style import (
    COLOURS,
    GREY,
    headline,
    key_below,
    legend_below,
    log_ticks,
    panel_title,
    panels,
)
from riserstudy.records.numerals import rounded_up

QUANTITIES = ("displacement", "moment", "tension")
EQUAL = 1.15  # ratio of times below which only the more accurate run is drawn
LARGEST = 0.5  # largest error that is drawn
UNKNOWN_ERROR = "true error below the error of the reference"  # in the key
LIMIT = "error equal to the tolerance"  # in the key
CLOSE = 1.1  # ratio of times, or errors, below which they count as equal
TARGET = 0.002  # error at which methods are compared
SLOW = 5.0  # least ratio of times at equal error from which a family is named instead of drawn
ABOVE = 5.0  # least ratio of the upper end of the axis to the target
BAND = f"target, {100 * TARGET:g} to {100 * CLOSE * TARGET:.2g} %"  # in the key


def accuracy(accuracy: xr.Dataset) -> Figure:
    """One panel per scene: for each family of methods, the lowest error over time of its meshes and steps."""
    scenes = [str(scene) for scene in accuracy["scene"].values]
    columns = min(2, len(scenes))
    figure, axes = panels(-(-len(scenes) // columns), columns, height=3.3)
    best: list[list[str]] = []
    reached = False
    for ax, scene in zip(axes, scenes, strict=False):
        first, errors = _scene(ax, accuracy.sel({"scene": scene}))
        least = min(errors.values(), default=np.inf)
        best.append([name for name, error in errors.items() if error <= CLOSE * least])
        reached = reached or bool(first)
        panel_title(ax, f"{in_one_line(scene)}:\n{first or f'no error below {100 * least:.2g} %'}")
        ax.set_xlabel("elapsed time of a run (s)")
        ax.set_ylabel("largest error (%)")
        ax.set_xscale("log")
        ax.set_yscale("log")
        if first:
            ax.set_ylim(top=max(ax.get_ylim()[1], ABOVE * TARGET))  # room for words above the band
        log_ticks(ax.xaxis)
        log_ticks(ax.yaxis)
        ax.xaxis.set_major_formatter("{x:g}")
        ax.yaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{100 * x:g}"))
    for ax in axes[len(scenes) :]:
        ax.set_axis_off()
        ax.set_title("", loc="left")
    drawn: dict[str, Any] = {}
    for ax in axes[: len(scenes)]:
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            drawn.setdefault(label, handle)
    legend_below(figure, list(drawn.values()), list(drawn), 3)
    headline(figure, _answer(best if reached else []))
    return figure


def _answer(best: list[list[str]]) -> str:
    """Title: the method that has the smallest error in most scenes, which times do not change."""
    wins = Counter(name for names in best for name in names).most_common()
    if not wins:
        return f"No method reaches an error of {100 * TARGET:g} %"
    name, count = wins[0]
    if wins[1:] and wins[1][1] == count:
        return "Several methods reach the smallest error equally often"
    return f"{name} reaches the smallest error in {count} of {sum(map(bool, best))} scenes"


def _scene(ax: Axes, of: xr.Dataset) -> tuple[str, dict[str, float]]:
    """Draw the edges of all families but very slow ones, which are named; return words and least errors.

    The words name the methods that reach the target error first, "" if none does. A family whose time is
    longer than the shortest by less than `CLOSE` counts as first, too.
    """
    families: dict[str, list[str]] = {}
    for method in map(str, of["method"].values):
        families.setdefault(family_of(method), []).append(method)
    edges = {family: _edge(of.sel({"method": methods})) for family, methods in families.items()}
    edges = {family: edge for family, edge in edges.items() if len(edge)}
    slow = {family: _slower(family, edges) for family in edges}
    beyond = [family for family, ratio in slow.items() if ratio >= SLOW]
    for family, edge in edges.items():
        if family in beyond:
            continue
        mark, colour, width = look_of(family)
        ax.plot(
            *_thinned(edge).T, marker=mark, markersize=4, linewidth=width, color=colour, label=family,
            drawstyle="steps-post", zorder=2.5 if width > 2.0 else 2.0,
        )  # fmt: skip
    if beyond:
        words = [
            f"{family}: at least {int(slow[family])} times\nthe time at equal error" for family in beyond
        ]
        ax.text(
            0.98, 0.97, "\n".join(words), transform=ax.transAxes, ha="right", va="top", fontsize="small",
            color="0.35",
        )  # fmt: skip
    least, times = _least(edges, beyond)
    if not times:
        return "", least
    ax.axhspan(TARGET, CLOSE * TARGET, color="0.75", linewidth=0.0, zorder=0, label=BAND)
    return _reached(times, all(family in beyond or short_name(family) in times for family in edges)), least


def _least(edges: dict[str, np.ndarray], beyond: list[str]) -> tuple[dict[str, float], dict[str, float]]:
    """Least errors, and least times (s) to the target, by the short name of a family.

    ``edges``: times and errors, (n, 2), by family. ``beyond``: families that are too slow to have a time.
    """
    least: dict[str, float] = {}
    times: dict[str, float] = {}
    for family, edge in edges.items():
        name, error = short_name(family), float(edge[-1, 1])
        least[name] = min(error, least.get(name, np.inf))
        if family not in beyond and error <= CLOSE * TARGET:
            time = float(edge[edge[:, 1] <= CLOSE * TARGET, 0].min())
            times[name] = min(time, times.get(name, np.inf))
    return least, times


def _reached(times: dict[str, float], every: bool) -> str:
    """State the methods with the shortest times (s) to the target, or the longest if all have it."""
    target = f"{100 * TARGET:g} %"
    if every and len(times) > 1:
        return f"all drawn methods reach {target} within {rounded_up(max(times.values()))} s"
    close = CLOSE * min(times.values())
    first = sorted((name for name, time in times.items() if time <= close), key=lambda name: times[name])
    return f"{' and '.join(first)} {'reach' if len(first) > 1 else 'reaches'} {target} first"


def _slower(family: str, edges: dict[str, NDArray[np.float64]]) -> float:
    """Smallest ratio of a family's time to the shortest time of another with at most the same error."""
    others = [edge for name, edge in edges.items() if name != family]
    if not others:
        return 1.0
    every = np.concatenate(others)
    shortest = [every[every[:, 1] <= error, 0].min(initial=np.inf) for error in edges[family][:, 1]]
    return float((edges[family][:, 0] / shortest).min())


def _thinned(edge: NDArray[np.float64]) -> NDArray[np.float64]:
    """An edge (n, 2) without runs that a better one follows at almost the same time.

    The first run at the target error is kept.
    """
    first = int(np.argmax(edge[:, 1] <= CLOSE * TARGET))
    kept = [len(edge) - 1]
    for k in range(len(edge) - 2, -1, -1):
        if edge[kept[-1], 0] > EQUAL * edge[k, 0] or (k == first and edge[k, 1] <= CLOSE * TARGET):
            kept.append(k)
    return edge[kept[::-1]]


def _edge(one: xr.Dataset) -> NDArray[np.float64]:
    """Time (s) and largest error of runs with a smaller error than all faster runs of the method, (n, 2)."""
    errors = np.stack([one[f"error_{q}"].values.ravel() for q in QUANTITIES])
    worst = np.where(np.isnan(errors), -np.inf, errors).max(axis=0)
    seconds = one["wall_seconds"].values.ravel()
    good = np.isfinite(seconds) & (worst > 0.0) & (worst < LARGEST)
    order = np.argsort(seconds[good])
    seconds, worst = seconds[good][order], worst[good][order]
    best = worst < np.concatenate([[np.inf], np.minimum.accumulate(worst)[:-1]])
    return np.asarray(np.column_stack([seconds[best], worst[best]]))


def requested(accuracy: xr.Dataset) -> Figure:
    """True and estimated error divided by the tolerance; scenes over the time limit are named."""
    figure, axes = panels(1, 2, height=3.9, sharey=True)
    drawn, late = _in_time(accuracy)
    unknown = False
    for k, scene in enumerate(drawn):
        of = accuracy.isel(request=np.flatnonzero(accuracy["request_scene"].values == scene))
        of = of.sortby("requested")
        colour, tolerance = COLOURS[k % len(COLOURS)], of["requested"].values
        change = float(accuracy["reference_change"].sel(scene=scene).max())
        for ax, kind in zip(axes, ("reached", "estimated"), strict=True):
            worst = _largest(of, kind)
            ax.plot(tolerance, worst / tolerance, "o-", color=colour, ms=4, label=in_one_line(scene))
            if kind == "reached" and (hidden := worst < change).any():
                ax.plot(tolerance[hidden], (worst / tolerance)[hidden], "o", color=colour, ms=4, mfc="white")
                unknown = True
    if unknown:
        axes[0].plot([], [], "o", color="0.4", ms=4, mfc="white", label=UNKNOWN_ERROR)
    for ax, words in zip(axes, ("true error", "estimated error"), strict=True):
        ax.axhline(1.0, color="black", linestyle=":", linewidth=1.0, label=LIMIT)
        ax.set_xscale("log")
        ax.set_yscale("log")
        requested = sorted(set(accuracy["requested"].values.tolist()))
        ax.set_xticks(requested, [f"{100 * x:g}" for x in requested])
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.set_xlim(1.3 * requested[-1], requested[0] / 1.3)
        ax.set_xlabel("tolerance (%): more accurate →")
        ax.set_ylabel(f"{words} / tolerance")
        ax.margins(y=0.1)
        log_ticks(ax.yaxis)
        ax.yaxis.set_major_formatter("{x:g}")
        panel_title(ax, words)
    if late:
        axes[1].text(
            0.02, 0.03, f"no line, over the time limit:\n{', '.join(map(in_one_line, late))}",
            transform=axes[1].transAxes, fontsize="small", color=GREY,
        )  # fmt: skip
    headline(figure, _met(accuracy, late))
    key_below(figure, axes[0], 3)
    return figure


def _in_time(accuracy: xr.Dataset) -> tuple[list[str], list[str]]:
    """Scenes with a run within the time limit, and scenes without."""
    late = without_time(accuracy)
    scenes = dict.fromkeys(map(str, accuracy["request_scene"].values))
    return [scene for scene in scenes if scene not in late], late


def _largest(of: xr.Dataset, kind: str) -> NDArray[np.float64]:
    values = np.stack([of[f"{kind}_{q}"].values for q in QUANTITIES])
    worst = np.where(np.isnan(values), -np.inf, values).max(axis=0)
    return np.where(np.isfinite(worst), worst, np.nan)


def _met(accuracy: xr.Dataset, late: list[str]) -> str:
    """Title: number of runs that meet their tolerance, and the scene, or number of scenes, without a run."""
    worst = _largest(accuracy, "reached")
    judged = np.isfinite(worst)
    kept = int((worst[judged] <= accuracy["requested"].values[judged]).sum())
    many = f"All {kept}" if kept == judged.sum() else f"{kept} of {judged.sum()}"
    words = f"{many} {'runs' if judged.all() else 'finished runs'} meet their tolerance"
    if not late:
        return words
    named = in_one_line(late[0]).partition(",")[0] if len(late) == 1 else f"{len(late)} scenes"
    return f"{words}; {named} {'is' if len(late) == 1 else 'are'} unfinished"
