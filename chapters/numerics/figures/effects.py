"""Importance of effects in one picture: number of scenes that each changes, and its share of run time."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from chapters.numerics.answers import TOLERANCE, Ranked, never, ranking
from riserstudy.figures.style import COLOURS, WIDTH, headline

LEAST, MOST = 1e-6, 1.0  # smallest and largest change that is drawn
WORDS = 12  # most words of a title
ROW = 0.27  # inches per row
FEW = 5  # scenes below which an effect is listed at the end
PHYSICS, PRESCRIBED, ADDED = COLOURS[0], COLOURS[1], COLOURS[2]
KEY = (
    (PHYSICS, "property of the riser, removed"),
    (PRESCRIBED, "motion or load, removed"),
    (ADDED, "added, since the engine omits it"),
)


def effects(effects: xr.Dataset) -> Figure:
    """One row per effect: its change of the results in every scene, and its share of the run time."""
    rows = ordered(ranking(effects))
    figure = Figure((1.53 * WIDTH, ROW * len(rows) + 1.9), dpi=150, layout="constrained")
    changes, shares = figure.subplots(1, 2, width_ratios=[2.3, 1.0], sharey=True)
    _changes(changes, rows)
    _shares(shares, rows)
    changes.set_yticks(range(len(rows)), [one.name for one in rows], fontsize="small")
    changes.set_ylim(len(rows) - 0.4, -0.6)
    _divide(changes, shares, rows)
    for ax in (changes, shares):
        ax.grid(True, axis="x", color="0.9", linewidth=0.6)
        ax.set_axisbelow(True)
    handles = [
        changes.plot([], [], "o", color=colour, label=words)[0]
        for colour, words in KEY
        if colour in {_colour(one) for one in rows}
    ]
    handles.append(changes.plot([], [], "|", color="black", markersize=11, label="(a) median")[0])
    handles.append(
        shares.plot(
            [], [], color="0.25", linewidth=1.2, label="(b) middle half of scenes; pale bar: includes 0"
        )[0]
    )
    figure.legend(
        handles, [str(h.get_label()) for h in handles],
        loc="outside lower center", ncols=3, fontsize="small",
    )  # fmt: skip
    headline(figure, answer(effects))
    return figure


def ordered(ranked: list[Ranked]) -> list[Ranked]:
    """Effects by the share of scenes that they change, largest first; those with few scenes come last."""
    return sorted(
        ranked, key=lambda one: (one.scenes < FEW, -one.changed / one.scenes, -one.scenes, -one.median)
    )


def answer(effects: xr.Dataset) -> str:
    """Title: the effect that changes the results most surely, and one that changes none, in few words."""
    ranked = ranking(effects)
    parts = [f"{one.name} affects {one.changed} of {one.scenes} scenes" for one in ranked[:1]]
    parts = parts if ranked and ranked[0].changed else []
    parts += [f"{one.name} none" for one in never(ranked)[:1]]
    words = ", ".join(parts if len(" ".join(parts).split()) <= WORDS else parts[:1])
    return words[:1].upper() + words[1:] or "Change of the results by one effect"


def _colour(one: Ranked) -> str:
    return ADDED if one.added else PRESCRIBED if one.prescribed else PHYSICS


def _changes(ax: Axes, ranked: list[Ranked]) -> None:
    """Draw one dot per scene, the median as a tick, and the count of scenes at the right."""
    for row, one in enumerate(ranked):
        clipped = np.clip(one.values, LEAST, MOST)
        ax.plot(
            clipped, row + 0.22 * np.sin(2.4 * np.arange(one.scenes)), "o", color=_colour(one),
            markersize=3.5, alpha=0.55, markeredgewidth=0.0, label=one.name,
        )  # fmt: skip
        ax.plot(np.clip(one.median, LEAST, MOST), row, "|", color="black", markersize=11)
        ax.annotate(
            f"{one.changed} of {one.scenes}", (1.01, row), xycoords=("axes fraction", "data"),
            va="center", fontsize="small", color="0.25", annotation_clip=False,
        )  # fmt: skip
    ax.axvline(TOLERANCE, color="black", linestyle=":", linewidth=1.0)
    ax.axvspan(TOLERANCE, 2.0 * MOST, color="0.94", zorder=0)
    ax.set_xscale("log")
    ax.set_xlim(0.6 * LEAST, 1.6 * MOST)
    ticks = (1e-5, 1e-4, 1e-3, TOLERANCE, 1e-1)
    ax.set_xticks(
        [LEAST, *ticks, MOST], [f"≤ {100 * LEAST:g}", *(f"{100 * tick:g}" for tick in ticks), "≥ 100"]
    )
    ax.xaxis.set_minor_locator(NullLocator())
    top: dict[str, Any] = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points"}
    top |= {"va": "bottom", "fontsize": "small", "color": "0.35", "annotation_clip": False}
    ax.annotate("negligible", (TOLERANCE, 1.0), xytext=(-5, 3), ha="right", **top)
    ax.annotate("changes the result", (TOLERANCE, 1.0), xytext=(5, 3), ha="left", **top)
    ax.annotate("in scenes", (1.6 * MOST, 1.0), xytext=(5, 3), ha="left", **top)
    ax.set_xlabel("largest change of a peak (%)")
    ax.set_title("(a) without the effect: one dot per scene", loc="left", fontsize="small", pad=6)


def _shares(ax: Axes, rows: list[Ranked]) -> None:
    """Draw the median share of the run time, pale if the middle half of the scenes includes zero."""
    for row, one in enumerate(rows):
        if not np.isfinite(one.share):
            continue
        low, high = (100.0 * end for end in one.middle)
        sure = low > 0.0 or high < 0.0
        ax.barh(row, 100.0 * one.share, height=0.62, color=_colour(one), alpha=0.75 if sure else 0.25)
        if one.scenes > 1:
            ax.plot([low, high], [row, row], color="0.25", linewidth=1.2, solid_capstyle="butt")
    ax.axvline(0.0, color="black", linewidth=0.6)
    ax.set_xlabel("share of run time (%)\nbelow 0: faster with the effect")
    ax.set_title("(b) share of run time, median", loc="left", fontsize="small", pad=6)


def _divide(changes: Axes, shares: Axes, rows: list[Ranked]) -> None:
    """Draw a line above the effects with few scenes."""
    first = next((row for row, one in enumerate(rows) if one.scenes < FEW), 0)
    if not first:
        return
    for ax in (changes, shares):
        ax.axhline(first - 0.5, color="0.4", linewidth=0.8)
    changes.annotate(
        f"fewer than {FEW} scenes", (0.01, first), xycoords=("axes fraction", "data"), va="center",
        fontsize="small", color="0.35",
    )  # fmt: skip
