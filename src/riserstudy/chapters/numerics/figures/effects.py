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
LEAST, MOST = 1e-7, 10.0  # change that is drawn, at least and at most
SCENES = 6
#: freedom that nothing calls for: whether a riser has it is for the engine to say, not for the scene
DECIDED = "with motion out of the plane"

Array = NDArray[np.float64]


def effects(effects: xr.Dataset) -> Figure:
    """Time of six scenes with and without the rest, and the change of the answer an effect."""
    scenes = chosen(effects)
    figure = Figure((10.2, 0.55 * len(scenes) + 2.4), dpi=150, layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=[1.0, 1.25], sharey=True)
    _times(left, effects, scenes)
    _changes(right, effects, scenes)
    left.set_yticks(range(len(scenes)), scenes, fontsize="small")
    left.set_ylim(len(scenes) - 0.5, -0.5)
    figure.suptitle(answer(effects), fontsize="medium", x=0.01, ha="left")
    return figure


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


def _changes(ax: Axes, effects: xr.Dataset, scenes: list[str]) -> None:
    size = change(effects)
    kinds = (
        ("without ", "o", True, "one that is on goes"),
        ("with ", "o", False, "one comes that the scene could have had"),
        (DECIDED, "x", True, "motion out of the plane comes, which nothing calls for"),
    )
    for row, scene in enumerate(scenes):
        for start, marker, filled, label in kinds:
            names = [
                str(name)
                for name in effects["change"].values
                if str(name).startswith(start) and (name == DECIDED) == (start == DECIDED)
            ]
            values = size.sel(scene=scene, change=names).dropna("change").values
            shown = np.clip(values, LEAST, MOST)
            matters = shown > TOLERANCE
            loud = "0.5" if start == "with " else COLOURS[1]
            for here, colour in ((matters, loud), (~matters, "0.5")):
                ax.plot(
                    shown[here], np.full(here.sum(), row) + _spread(here.sum()), marker,
                    color=colour, markerfacecolor=colour if filled else "white", markersize=5.5,
                    alpha=0.85, linestyle="",
                )  # fmt: skip
            if not row:
                ax.plot([], [], marker, color="0.3", markerfacecolor="0.3" if filled else "white",
                        linestyle="", markersize=5.5, label=label)  # fmt: skip
    ax.plot([], [], "s", color=COLOURS[1], linestyle="", label="orange: above 1 %, so it is needed")
    ax.axvline(TOLERANCE, color="black", linestyle=":", linewidth=1.0)
    ax.set_xscale("log")
    ax.set_xlim(0.5 * LEAST, 2.0 * MOST)
    ticks = (1e-5, 1e-3, TOLERANCE, 1e-1, 10.0)
    ax.set_xticks([LEAST, *ticks], ["less", *(f"{100 * tick:g}" for tick in ticks)])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.set_xlabel("largest change of the answer (%); dotted: 1 %")
    ax.grid(True, axis="x", color="0.92", linewidth=0.6)
    ax.set_axisbelow(True)
    ax.set_title("(b) change of the answer by one effect", loc="left", fontsize="medium")
    ax.legend(
        loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=1, fontsize="x-small", frameon=False
    )


def _spread(count: int) -> Array:
    """Heights that keep marks of one row apart."""
    return np.asarray(0.16 * np.sin(2.4 * np.arange(count)))
