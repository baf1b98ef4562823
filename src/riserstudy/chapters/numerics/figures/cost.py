"""What accuracy costs, in one picture: seconds of a run over the error that it reaches."""

from __future__ import annotations

import textwrap
from itertools import cycle
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, NullFormatter, NullLocator
from numpy.typing import NDArray

from riserstudy.figures.style import COLOURS, GREY

QUANTITIES = ("displacement", "moment", "tension")
DEFAULT = (0.002, 0.01)  # of displacement and of moment, where no accuracy is written
TICKS = (0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005, 0.0002, 0.0001, 0.00005)
WIDEST, FINEST = 0.07, 0.00012  # errors that the axis reaches, at least
LEAST = 1e-5  # error that is drawn, at least
LETTERS = 16  # of a line's name, in a row
DASHED = (0, (4, 2))
APART = 1.35  # times, by which names stand apart

Array = NDArray[np.float64]


def cost(accuracy: xr.Dataset, random_scenes: xr.Dataset) -> Figure:
    """A line a scene, the default as a band, single runs behind, and how honest estimates are."""
    figure = Figure((9.6, 5.6), dpi=150, layout="constrained")
    ax, right = figure.subplots(1, 2, width_ratios=[2.3, 1.0])
    lines = {
        str(scene): _line(accuracy, scene)
        for scene in dict.fromkeys(accuracy["request_scene"].values)
    }
    drawn = {scene: line for scene, line in lines.items() if len(line)}
    _behind(ax, accuracy)
    for line, colour in zip(drawn.values(), cycle(COLOURS), strict=False):
        ax.plot(*line[:, :2].T, "o-", color=colour, linewidth=2.2, markersize=5, zorder=3)
        ax.plot(line[:, 0], line[:, 2], ":", color=colour, linewidth=1.6, zorder=2)
    _at_the_ends(ax, {scene: line[-1, :2] for scene, line in drawn.items()})
    ax.axvspan(*DEFAULT, color="0.92", zorder=0, label="default")
    ax.set_xscale("log")
    ax.set_yscale("log")
    reached = np.concatenate([line[:, 0] for line in drawn.values()] or [np.array(DEFAULT)])
    ax.set_xlim(max(WIDEST, 1.3 * reached.max()), min(FINEST, 0.07 * reached.min()))
    _in_words(ax)
    ax.text(
        np.sqrt(DEFAULT[0] * DEFAULT[1]), 0.985, "default:\nmoment 1 %,\ndisplacement 0.2 %",
        transform=ax.get_xaxis_transform(), ha="center", va="top", fontsize="x-small", color="0.4",
    )  # fmt: skip
    ax.set_xlabel("error reached, the largest of displacement, moment and tension (%)")
    ax.set_ylabel("time (see the key)")
    _key(figure, peers="peer_scene" in accuracy)
    if late := sorted(set(lines) - set(drawn)):
        ax.text(
            0.02, 0.02, f"not within the time allowed: {', '.join(late)}",
            transform=ax.transAxes, fontsize="x-small", color="0.3",
        )  # fmt: skip
    ax.set_title(f"(a) {answer(accuracy)}", loc="left", fontsize="medium")
    _honesty(right, random_scenes)
    return figure


def answer(accuracy: xr.Dataset) -> str:
    """What a finer request costs, from the requests that all scenes met."""
    met = accuracy["request_seconds"].notnull().values
    asked, scene = accuracy["requested"].values, accuracy["request_scene"].values
    scenes = sorted(set(scene[met]))
    shared = sorted(
        {
            x
            for x in set(asked[met])
            if all((met & (asked == x) & (scene == s)).any() for s in scenes)
        }
    )
    if len(shared) < 2:
        return "What accuracy costs"
    fine, coarse = shared[0], next((x for x in shared if x == 0.01 and x > shared[0]), shared[-1])
    seconds = accuracy["request_seconds"].values
    ratio = [
        float(
            seconds[(scene == s) & (asked == fine)][0]
            / seconds[(scene == s) & (asked == coarse)][0]
        )
        for s in scenes
    ]
    low, high = f"{min(ratio):.1f}", f"{max(ratio):.1f}"
    times = low if low == high else f"{low} to {high}"
    return (
        f"{coarse / fine:.0f} times the accuracy ({100 * coarse:g} % to {100 * fine:g} %) "
        f"for {times} times the time"
    )


def _line(accuracy: xr.Dataset, scene: object) -> Array:
    """Error reached, seconds of all runs and of the last, of the requests that a scene met, (n, 3)."""
    of = accuracy.isel(request=np.flatnonzero(accuracy["request_scene"].values == scene))
    reached = np.stack([of[f"reached_{q}"].values for q in QUANTITIES])
    worst = np.nanmax(np.where(np.isnan(reached), -np.inf, reached), axis=0)
    seconds = of["request_seconds"].values
    good = np.isfinite(seconds) & (worst > 0.0)
    return np.asarray(np.column_stack([worst, seconds, of["request_last_seconds"].values])[good])


def _behind(ax: Axes, accuracy: xr.Dataset) -> None:
    """Of scenes with peers, the cheapest single runs and, in the same grey, those of other simulators."""
    for scene in dict.fromkeys(accuracy["peer_scene"].values if "peer_scene" in accuracy else []):
        single = _cheapest(accuracy.sel(scene=scene))
        if not len(single):
            continue
        inside = single[(single[:, 0] < WIDEST) & (single[:, 0] > 3.0 * FINEST)]
        ax.plot(*inside.T, color=GREY, linewidth=1.2, linestyle=DASHED, zorder=1)
        if len(inside):
            _named(ax, inside[-1], f"riserstudy, {scene}\n(one run)", GREY, "x-small")
        here = accuracy["peer_scene"].values == scene
        for peer in dict.fromkeys(accuracy["peer"].values[here]):
            of = here & (accuracy["peer"].values == peer)
            error = accuracy["peer_error"].values[of]
            here_too = np.interp(np.log(error), np.log(single[::-1, 0]), np.log(single[::-1, 1]))
            near = (error >= 0.7 * single[:, 0].min()) & (error <= 1.4 * single[:, 0].max())
            seconds = np.exp(here_too) * accuracy["peer_ratio"].values[of]
            if near.any():
                ax.plot(error[near], seconds[near], color=GREY, linewidth=0.9, zorder=1)
                _named(
                    ax, (error[near][-1], seconds[near][-1]), f"{peer} (one run)", GREY, "x-small"
                )


def _key(figure: Figure, peers: bool) -> None:
    """What is timed: a request takes several runs, a mesh and step that one knew would take one."""
    bold: dict[str, Any] = {"color": "0.25", "linewidth": 2.2}
    shown = [
        Line2D([], [], marker="o", markersize=5, **bold, label="all runs of a request"),
        Line2D([], [], color="0.25", linewidth=1.6, linestyle=":", label="its last run"),
    ]
    if peers:
        cheapest = "one run on the cheapest mesh and step"
        shown += [
            Line2D([], [], color=GREY, linewidth=1.2, linestyle=DASHED, label=cheapest),
            Line2D([], [], color=GREY, linewidth=0.9, label="one such run of another simulator"),
        ]
    figure.legend(handles=shown, loc="outside lower left", ncols=len(shown), fontsize="x-small")


def _cheapest(of: xr.Dataset) -> Array:
    """Error of displacement and seconds along the lower edge of all rungs, coarse to fine, (n, 2)."""
    error = of["error_displacement"].values.ravel()
    seconds = of["wall_seconds_min"].values.ravel()
    good = np.isfinite(error) & np.isfinite(seconds) & (error < 0.1) & (error > 0.0)
    order = np.argsort(seconds[good])
    error, seconds = error[good][order], seconds[good][order]
    edge = error < np.concatenate([[np.inf], np.minimum.accumulate(error)[:-1]])
    return np.column_stack([error[edge], seconds[edge]])


def _at_the_ends(ax: Axes, ends: dict[str, Array]) -> None:
    """Names of lines behind their ends, each far enough above the one below it."""
    colours, lowest = dict(zip(ends, cycle(COLOURS), strict=False)), 0.0
    for scene, (error, seconds) in sorted(ends.items(), key=lambda end: end[1][1]):
        name = textwrap.fill(scene, LETTERS)
        lowest = max(seconds, lowest)
        _named(ax, (error, lowest), name, colours[scene], "small")
        lowest *= APART ** (1 + name.count("\n"))


def _named(ax: Axes, at: Any, name: str, colour: str, size: str) -> None:
    ax.annotate(
        name, (at[0], at[1]), xytext=(6, 0), textcoords="offset points",
        ha="left", va="center", color=colour, fontsize=size,
    )  # fmt: skip


def _in_words(ax: Axes) -> None:
    """Errors in per cent, times in the units one says them in."""
    low, high = sorted(ax.get_xlim())
    ticks = [tick for tick in TICKS if low <= tick <= high]
    ax.set_xticks(ticks, [f"{100 * tick:g}" for tick in ticks])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_major_formatter(FuncFormatter(lambda x, _: _time(x)))
    ax.grid(True, color="0.92", linewidth=0.6)
    ax.set_axisbelow(True)


def _time(seconds: float) -> str:
    return f"{1000 * seconds:g} ms" if seconds < 1.0 else f"{seconds:g} s"


def _honesty(ax: Axes, drawn: xr.Dataset) -> None:
    """Estimated and true error of random scenes, with how many kept what was promised."""
    asked = float(drawn.attrs["requested"])
    judged = drawn["true"].notnull().values
    true = np.maximum(drawn["true"].values[judged], LEAST)
    estimated = np.maximum(drawn["estimated"].values[judged], LEAST)
    kept = int((true <= asked).sum())
    ends = np.array([LEAST, 0.1])
    ax.plot(ends, ends, color=GREY, linewidth=0.8)
    ax.axvline(asked, color="black", linestyle=":", linewidth=1.0)
    ax.text(
        0.93 * asked, 0.03, f"request: {100 * asked:g} %", transform=ax.get_xaxis_transform(),
        rotation=90, ha="right", va="bottom", fontsize="x-small", color="0.3",
    )  # fmt: skip
    over = true > asked
    ax.plot(true[~over], estimated[~over], "o", color=COLOURS[0], markersize=4, alpha=0.7)
    ax.plot(true[over], estimated[over], "D", color=COLOURS[1], markersize=5)
    ax.set_xscale("log")
    ax.set_yscale("log")
    low = 0.6 * min([*true, *estimated, 0.1 * asked])
    high = 1.6 * max([*true, *estimated, 2.0 * asked])
    for axis, limits in ((ax.xaxis, ax.set_xlim), (ax.yaxis, ax.set_ylim)):
        limits(low, high)
        axis.set_major_formatter(FuncFormatter(lambda x, _: f"{100 * x:g}"))
        axis.set_minor_formatter(NullFormatter())
    ax.grid(True, color="0.92", linewidth=0.6)
    ax.set_xlabel("true error (%)")
    ax.set_ylabel("estimated error (%)")
    ax.set_title(
        f"(b) {kept} of {len(true)} random scenes\nare as accurate as they request",
        loc="left", fontsize="medium",
    )  # fmt: skip
