"""Only the effects called for, in one picture: what the others would cost, and what they would change."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from numpy.typing import NDArray

from riserstudy.figures.style import COLOURS

CHANGES = ("displacement_change", "moment_change", "tension_change")
REST = "solver and bookkeeping"
TOLERANCE = 0.01  # change of an answer that matters
WRONG = "#c0392b"  # a decision that was wrong, as where stability has its own
LEAST, MOST = 1e-7, 10.0  # change that is drawn, at least and at most
SCENES = 6
#: freedom that nothing calls for: whether a riser has it is for the engine to say, not for the scene
DECIDED = "with motion out of the plane"

Array = NDArray[np.float64]


def effects(effects: xr.Dataset, papers: dict[str, str] | None = None) -> Figure:
    """Time of six scenes with and without the rest, and the change of the answer an effect.

    ``papers``: what papers are called; absent: by their folders.
    """
    scenes = chosen(effects)
    figure = Figure((10.2, 0.62 * len(scenes) + 2.6), dpi=150, layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=[1.0, 1.25], sharey=True)
    _times(left, effects, scenes)
    _changes(right, effects, scenes)
    names = [named(scene, papers or {}) for scene in scenes]
    left.set_yticks(range(len(scenes)), names, fontsize="small")
    left.set_ylim(len(scenes) - 0.5, -0.9)  # a note stands above the first row
    figure.suptitle(answer(effects), fontsize="medium", x=0.01, ha="left")
    return figure


def named(scene: str, papers: dict[str, str]) -> str:
    """A scene in words: its paper, its study, and of what options make of it which."""
    paper, _, study = scene.partition("/")
    return f"{papers.get(paper, paper)}, {study.replace('_', ' ')}" if study else scene


def change(effects: xr.Dataset) -> xr.DataArray:
    """Largest relative change of an answer, by scene and change."""
    every = xr.concat([abs(effects[name]) for name in CHANGES], "quantity")
    return every.max("quantity")


def decisions(effects: xr.Dataset) -> tuple[int, int]:
    """How often the engine left freedom out that no line calls for, and how often that was wrong."""
    if DECIDED not in effects["change"]:
        return 0, 0
    changes = change(effects).sel(change=DECIDED).dropna("scene")
    return changes.size, int((changes > TOLERANCE).sum())


def chosen(effects: xr.Dataset) -> list[str]:
    """Scenes to show, by their number of effects: where they are many, of each paper the one with most."""
    count = on(effects)
    scenes = [str(scene) for scene in effects["scene"].values]
    if len(scenes) > SCENES:
        best: dict[str, str] = {}
        for scene in scenes:
            paper = scene.split("/")[0]
            if paper not in best or count.sel(scene=scene) > count.sel(scene=best[paper]):
                best[paper] = scene
        scenes = list(best.values())
    return sorted(scenes, key=lambda scene: int(count.sel(scene=scene)))[:SCENES]


def on(effects: xr.Dataset) -> xr.DataArray:
    """Number of effects that a scene has on."""
    return effects["time_share"].drop_sel(effect=REST, errors="ignore").notnull().sum("effect")


def added(effects: xr.Dataset) -> tuple[xr.DataArray, xr.DataArray]:
    """Time over that of a run, (scene,): what motion out of the plane adds, and what all other effects do."""
    comes = [str(name) for name in effects["change"].values if str(name).startswith("with ")]
    others = effects["time_change"].sel(change=[name for name in comes if name != DECIDED])
    across = effects["time_change"].sel(change=[name for name in comes if name == DECIDED])
    # noise of single changes falls on both sides: the sum is cut, not they
    return across.sum("change").clip(min=0.0), others.sum("change").clip(min=0.0)


def answer(effects: xr.Dataset) -> str:
    """How many decisions were wrong, and what was saved."""
    count, wrong = decisions(effects)
    extra, scenes = 100.0 * float(np.median(sum(added(effects)))), len(effects["scene"])
    return (
        "Effects that a scene does not call for are not simulated: they would add "
        f"{extra:.0f} % to the time of a run (median of {scenes} scenes).\n"
        f"Motion out of the plane is left out in {count} scenes, wrongly in {wrong or 'none'} "
        "(by more than 1 %)"
    )


def _times(ax: Axes, effects: xr.Dataset, scenes: list[str]) -> None:
    (across, others), count = added(effects), on(effects)
    for row, scene in enumerate(scenes):
        of = effects.sel(scene=scene)
        base = 1e3 * float(of["base_seconds"])
        rest = of["time_share"].sel(effect=REST)
        own = base * (1.0 - float(rest.fillna(1.0)))
        more = base * float(others.sel(scene=scene))
        space = base * float(across.sel(scene=scene))
        parts = (
            (own, COLOURS[0], "calls of effects that are on"),
            (base - own, "0.55", "solver and all else"),
        )
        start = 0.0
        for width, colour, label in (
            *parts,
            (more, "#f0bf9c", "effects that are off would add"),
            (space, "#f8e4d6", "motion out of the plane would add"),
        ):
            ax.barh(row, width, left=start, height=0.55, color=colour, label="" if row else label)
            start += width
        ax.annotate(
            f" {int(count.sel(scene=scene))} on",
            (start, row),
            va="center",
            fontsize="x-small",
            color="0.3",
        )
    ax.set_xlabel("time of a run (ms)")
    ax.margins(x=0.12)
    ax.set_title("(a) time", loc="left", fontsize="medium")
    ax.legend(
        loc="upper center", bbox_to_anchor=(0.45, -0.16), ncols=1, fontsize="x-small", frameon=False
    )


#: what was done to a scene: how its change begins, mark, whether filled, place in the row, what it is,
#: what it is above the tolerance, and the colour there
KINDS = (
    ("without ", "o", True, -0.26, "an effect of the scene removed", "so it is needed", COLOURS[1]),
    ("with ", "o", False, 0.0, "an effect added that the scene could name", "", "0.5"),
    (DECIDED, "X", True, 0.26, "motion out of the plane added", "wrongly left out", WRONG),
)


def _changes(ax: Axes, effects: xr.Dataset, scenes: list[str]) -> None:
    """A row a scene, in which each kind of change has its own height."""
    size = change(effects)
    for start, marker, filled, away, said, verdict, loud in KINDS:
        names = [
            str(name)
            for name in effects["change"].values
            if str(name).startswith(start) and (name == DECIDED) == (start == DECIDED)
        ]
        of = [size.sel(scene=scene, change=names).dropna("change").values for scene in scenes]
        shown = np.clip(np.concatenate(of), LEAST, MOST)
        rows = np.repeat(np.arange(len(scenes)), [len(values) for values in of])
        heights = rows + away + np.concatenate([_spread(len(values)) for values in of])
        matters = shown > TOLERANCE
        for here, colour, words in (
            (~matters, "0.5", said),
            (matters, loud, f"{said}: above 1 %, {verdict}"),
        ):
            if here.any():
                ax.plot(
                    shown[here], heights[here], marker, color=colour, linestyle="",
                    markerfacecolor=colour if filled else "white", markersize=5.5, alpha=0.85,
                    label=words if verdict or not matters[here].any() else "_beyond",
                )  # fmt: skip
    ax.axvline(TOLERANCE, color="black", linestyle=":", linewidth=1.0)
    ax.axvspan(TOLERANCE, 2.0 * MOST, color="0.95", zorder=0)
    _across(ax)
    ax.text(
        np.sqrt(2.0 * TOLERANCE * MOST), 0.99, "above 1 %: another answer;\nopen marks: the user's choice",
        transform=ax.get_xaxis_transform(), ha="center", va="top", fontsize="x-small", color="0.3",
    )  # fmt: skip
    for edge in range(1, len(scenes)):
        ax.axhline(edge - 0.5, color="0.92", linewidth=0.8, zorder=0)
    ax.set_title("(b) change of the answer by one effect", loc="left", fontsize="medium")
    ax.legend(
        loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=1, fontsize="x-small", frameon=False
    )


def _across(ax: Axes) -> None:
    """Changes in per cent, on a scale that ends where they are too small to be drawn."""
    ax.set_xscale("log")
    ax.set_xlim(0.5 * LEAST, 2.0 * MOST)
    ticks = (1e-5, 1e-3, TOLERANCE, 1e-1, 10.0)
    ax.set_xticks([LEAST, *ticks], ["less", *(f"{100 * tick:g}" for tick in ticks)])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.set_xlabel("largest change of the answer (%); dotted: 1 %")
    ax.grid(True, axis="x", color="0.92", linewidth=0.6)
    ax.set_axisbelow(True)


def _spread(count: int) -> Array:
    """Heights that keep marks of one kind apart."""
    return np.asarray(0.07 * np.sin(2.4 * np.arange(count)))
