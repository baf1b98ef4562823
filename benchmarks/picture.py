"""Error against time of all codes, a row a scene: displacement, then moment or tension."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from levels import LEVELS, edge, points
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter

COLOURS = ("#0072b2", "#000000", "#d55e00", "#009e73", "#cc79a7", "#e69f00")


def _axes(ax: Axes) -> None:
    """Errors in per cent, plain times, and the levels at which the tables compare codes."""
    ax.set(xscale="log", yscale="log")
    for level in LEVELS:
        ax.axhline(level, color="0.6", lw=0.6, ls=":", zorder=0)
        ax.annotate(
            f"{100 * level:g} %", (1.0, level), xycoords=("axes fraction", "data"), xytext=(3, 0),
            textcoords="offset points", va="center", fontsize="x-small", color="0.4",
        )  # fmt: skip
    ax.xaxis.set_major_formatter("{x:g}")
    ax.yaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{100 * x:g}"))
    ax.set_ylabel("largest error (%)")
    ax.grid(alpha=0.2)


def picture(rows: list[Any], target: Path, told: str) -> Path:
    """Draw every timed setting; a line joins those that no faster one of the same code beats."""
    scenes = list(dict.fromkeys(row.scene for row in rows))
    methods = list(dict.fromkeys(row.method for row in rows))
    figure = Figure((8.6, 0.8 + 2.9 * len(scenes)), dpi=150, layout="constrained")
    axes = figure.subplots(len(scenes), 2, squeeze=False)
    drawn: set[str] = set()  # a peer that cannot do a scene is a row of the table, and no key
    for scene, pair in zip(scenes, axes, strict=True):
        kinds = dict.fromkeys(what for row in rows if row.scene == scene for what in row.errors)
        for ax, what in zip(pair, kinds, strict=False):
            for k, method in enumerate(methods):
                found = [(1e3 * time, error) for time, error in points(rows, scene, method, what)]
                if found:
                    drawn.add(method)
                    ax.plot(*zip(*found, strict=True), "os^Dv<"[k], color=COLOURS[k], ms=4)
                    ax.plot(*zip(*edge(found), strict=True), color=COLOURS[k], lw=1.2)
            _axes(ax)
            ax.set_title(f"{scene}: {what}", fontsize="medium")
    for ax in axes[-1]:
        ax.set_xlabel("processor time of a run (ms)")
    keys = [
        Line2D([], [], color=COLOURS[k], marker="os^Dv<"[k], ms=4, label=method)
        for k, method in enumerate(methods)
        if method in drawn
    ]
    figure.legend(handles=keys, loc="outside lower center", ncols=6, fontsize="small")
    figure.suptitle(told, fontsize="x-small", x=0.01, ha="left")
    figure.savefig(target)
    return target
