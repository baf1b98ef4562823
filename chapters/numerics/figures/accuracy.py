"""Run time of accuracy by method, and true errors of runs to a tolerance."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from numpy.typing import NDArray

from chapters.numerics.figures.methods import family_of, look_of
from chapters.numerics.figures.scenes import in_one_line
from riserstudy.figures.style import (
    COLOURS,
    headline,
    key_below,
    legend_below,
    log_ticks,
    panel_title,
    panels,
)

QUANTITIES = ("displacement", "moment", "tension")
EQUAL = 1.15  # ratio of times below which only the more accurate run is drawn
LARGEST = 0.5  # largest error that is drawn
BELOW = 0.02  # lower limit of the axis of errors, relative to the smallest tolerance
CHANGED = (0, (6, 2, 1, 2))  # dashes of the change of the reference
CLOSE = 1.1  # ratio of times, or errors, below which they count as equal
TARGET = 0.002  # error at which methods are compared


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
        reach = f"{' and '.join(first)} {'reach' if len(first) > 1 else 'reaches'} {100 * TARGET:g} % first"
        words = reach if first else f"no error below {100 * least:.2g} %"
        panel_title(ax, f"{in_one_line(scene)}:\n{words}")
        ax.set_xlabel("elapsed time of a run (s)")
        ax.set_ylabel("largest error (%)")
        ax.set_xscale("log")
        ax.set_yscale("log")
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


def _short(family: str) -> str:
    """Name of a family without its settings."""
    return family.split(" (")[0]


def _scene(ax: Axes, of: xr.Dataset) -> tuple[list[str], dict[str, float]]:
    """Draw the edges of all families; return the first at the target error, and their least errors.

    A family whose time is longer than the shortest by less than `CLOSE` counts as first, too.
    """
    times: dict[str, float] = {}
    least: dict[str, float] = {}
    target = CLOSE * TARGET
    families: dict[str, list[str]] = {}
    for method in map(str, of["method"].values):
        families.setdefault(family_of(method), []).append(method)
    for family, methods in families.items():
        edge = _edge(of.sel({"method": methods}))
        if not len(edge):
            continue
        mark, colour, width = look_of(family)
        ax.plot(
            *_thinned(edge).T, marker=mark, markersize=4, linewidth=width, color=colour, label=family,
            drawstyle="steps-post", zorder=2.5 if width > 2.0 else 2.0,
        )  # fmt: skip
        least[_short(family)] = float(edge[-1, 1])
        met = edge[edge[:, 1] <= target, 0]
        if len(met):
            times[_short(family)] = float(met.min())
    if times:
        ax.axhspan(TARGET, target, color="0.75", linewidth=0.0, zorder=0)
    close = CLOSE * min(times.values(), default=0.0)
    return sorted((name for name in times if times[name] <= close), key=lambda name: times[name]), least


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
    """Tolerance, estimated and true error, and elapsed time; scenes over the time limit are named."""
    figure, (left, right) = panels(1, 2, height=3.9)
    known = accuracy["request_seconds"].notnull().values
    scenes = list(dict.fromkeys(map(str, accuracy["request_scene"].values)))
    halved, changes = "", {}
    drawn = [name for name in scenes if known[accuracy["request_scene"].values == name].any()]
    for k, scene in enumerate(drawn):
        of = accuracy.isel(request=np.flatnonzero(accuracy["request_scene"].values == scene))
        colour = COLOURS[k % len(COLOURS)]
        worst, estimated = (_largest(of, kind) for kind in ("reached", "estimated"))
        left.plot(of["requested"], worst, "o-", color=colour, ms=4, label=in_one_line(scene))
        left.plot(of["requested"], estimated, "x:", color=colour, ms=4)
        right.plot(of["requested"], of["request_seconds"], "o-", color=colour, ms=4)
        change = float(accuracy["reference_change"].sel(scene=scene).max())
        if change == change:
            left.axhline(change, color=colour, linewidth=0.9, linestyle=CHANGED)
            halved = "level below which true errors are unknown"
            changes[scene] = change
    ends = np.array([float(accuracy["requested"].min()), float(accuracy["requested"].max())])
    floor = BELOW * ends[0]  # lower reference levels are not shown
    if far := [scene for scene, change in changes.items() if change < floor]:
        left.text(
            0.02, 0.93, f"level below the frame: {', '.join(map(in_one_line, far))}",
            transform=left.transAxes, fontsize="x-small",
        )  # fmt: skip
    left.plot(ends, ends, color="0.6", lw=1.0, label="error equal to the tolerance")
    left.plot([], [], "x:", color="0.4", ms=4, label="estimated")
    if halved:
        left.plot([], [], color="0.4", linewidth=0.9, linestyle=CHANGED, label=halved)
    for ax, word in ((left, "error (%)"), (right, "time of all runs (s)")):
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xlabel("tolerance (%)")
        ax.set_ylabel(word)
        requested = sorted(set(accuracy["requested"].values.tolist()))
        ax.set_xticks(requested, [f"{100 * x:g}" for x in requested])
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.yaxis.set_minor_formatter(NullFormatter())
        ax.margins(y=0.15)
    left.yaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{100 * x:g}"))
    right.yaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    left.set_ylim(bottom=max(left.get_ylim()[0], floor))
    bottom, top = right.get_ylim()
    right.set_ylim(min(bottom, 0.5 * top), max(top, 2.0 * bottom))
    panel_title(left, "true error (o), estimated error (x)")
    panel_title(right, "time of all refinements of a tolerance")
    if late := sorted(set(scenes) - set(drawn)):
        right.text(
            0.02, 0.02, f"not within the time allowed: {', '.join(map(in_one_line, late))}",
            transform=right.transAxes, fontsize="x-small",
        )  # fmt: skip
    headline(figure, _met(accuracy))
    key_below(figure, left, 4)
    return figure


def _largest(of: xr.Dataset, kind: str) -> NDArray[np.float64]:
    values = np.stack([of[f"{kind}_{q}"].values for q in QUANTITIES])
    worst = np.where(np.isnan(values), -np.inf, values).max(axis=0)
    return np.where(np.isfinite(worst), worst, np.nan)


def _met(accuracy: xr.Dataset) -> str:
    """Title: number of runs that meet their tolerance."""
    worst = _largest(accuracy, "reached")
    judged = np.isfinite(worst)
    kept = int((worst[judged] <= accuracy["requested"].values[judged]).sum())
    many = f"All {kept}" if kept == judged.sum() else f"{kept} of {judged.sum()}"
    return f"{many} {'runs' if judged.all() else 'completed runs'} meet their tolerance"
