"""Explicit stepping at its limit: the longest stable step, measured and predicted."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from chapters.numerics.answers import STEP_FOUND
from riserstudy.figures.direct import legible, spread
from riserstudy.figures.style import COLOURS, headline, mosaic, panel_title

UNSAFE = 1.0  # measured / predicted step, below which the prediction is too long
LEAST = 1.0  # %, shown to both sides
LINE = 11.0  # height of a line of text (points)
ROOM = 8.0  # ratio by which the axis is longer than the lines, for their names
ALIKE = 0.1  # difference (%) below which steps count as equal


def stable_step(stable_step: xr.Dataset) -> Figure:
    """Stable steps over the segments, predicted and measured, and their difference, variant by variant."""
    figure, (ax, off) = mosaic(["a a a b b"], [4.0])
    ratio = stable_step["measured"] / stable_step["predicted"]
    ends: list[tuple[float, float, str, str]] = []
    colours: dict[int, str] = {}
    for row, alike in enumerate(_coinciding(stable_step)):
        of = stable_step.isel(variant=alike[0])
        colour = COLOURS[row % len(COLOURS)]
        colours |= dict.fromkeys(alike, colour)
        ax.plot(of["elements"], of["predicted"], "-", linewidth=1.2, color=colour)
        for k in alike:
            one = stable_step.isel(variant=k)
            ax.plot(one["elements"], one["measured"], "o", ms=5, mfc="none", color=colour)
        last = int(np.flatnonzero(np.isfinite(of["measured"].values))[-1])
        name = _named([str(stable_step["variant"].values[k]) for k in alike]) + _differs(ratio[alike])
        ends.append((float(of["elements"][last]), float(of["measured"][last]), name, colour))
    ax.plot([], [], "-", color="0.4", linewidth=1.2, label="predicted")
    ax.plot([], [], "o", ms=5, mfc="none", color="0.4", label="measured")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ticks = sorted({int(n) for n in stable_step["elements"].values.ravel() if n == n})
    ax.set_xticks(ticks, [str(n) for n in ticks])
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.yaxis.set_major_formatter("{x:g}")
    ax.set_xlabel("number of segments")
    ax.set_ylabel("longest stable time step (s)")
    low, high = ax.get_xlim()
    ax.set_xlim(low, ROOM * high)
    panel_title(ax, "longest stable step")
    _differences(off, ratio, colours)
    headline(figure, answer(ratio))
    ax.legend(loc="lower left", fontsize="small")
    _name_ends(figure, ax, ends)
    return figure


def _differences(ax: Axes, ratio: xr.DataArray, colours: dict[int, str]) -> None:
    """Measured / predicted step of every variant and mesh, less one; shaded: found by bisection."""
    ax.axvspan(-STEP_FOUND, STEP_FOUND, color="0.9", lw=0.0, zorder=0)
    ax.axvline(0.0, color="0.4", lw=1.2)
    names = _in_words(ratio["variant"].values)
    for row, of in enumerate(ratio.values):
        shown = 100.0 * (of[np.isfinite(of)] - UNSAFE)
        ax.plot(shown, np.full(len(shown), row), "o", ms=6, mfc="none", color=colours[row], label=names[row])
    ax.set_yticks(range(len(names)), names, fontsize="small")
    for label, row in zip(ax.get_yticklabels(), range(len(names)), strict=True):
        label.set_color(legible(colours[row]))
    ax.set_ylim(len(names) - 0.5, -0.5)
    low, high = ax.get_xlim()
    ax.set_xlim(min(low, -LEAST), max(1.1 * high, LEAST))
    ax.set_xlabel("measured / predicted − 1 (%)")
    panel_title(ax, "shaded: resolution of the bisection")


def _name_ends(figure: Figure, ax: Axes, ends: list[tuple[float, float, str, str]]) -> None:
    """Write names (third) next to the last points (first two) of lines, without overlap."""
    figure.draw_without_rendering()
    to_points = 72.0 / figure.dpi
    levels = np.array([to_points * ax.transData.transform(end[:2])[1] for end in ends])
    heights = np.array([LINE * (1.0 + end[2].count("\n")) for end in ends])
    for (x, y, name, colour), level, moved in zip(ends, levels, spread(levels, heights), strict=True):
        ax.annotate(
            name, (x, y), xytext=(9, float(moved - level)), textcoords="offset points", va="center",
            fontsize="small", color=legible(colour), in_layout=False,
        )  # fmt: skip


def _coinciding(stable_step: xr.Dataset) -> list[list[int]]:
    """Indices of the variants whose segments, predicted and measured steps are equal, by variant."""
    groups: list[list[int]] = []
    values = np.stack([stable_step[name].values for name in ("elements", "predicted", "measured")], axis=1)
    for k, one in enumerate(values):
        for group in groups:
            if np.allclose(one, values[group[0]], rtol=ALIKE / 100.0, atol=0.0, equal_nan=True):
                group.append(k)
                break
        else:
            groups.append([k])
    return groups


def _named(variants: list[str]) -> str:
    """Names of up to two variants; of more, the first and their number, since the other panel names all."""
    words = _in_words(variants)
    if len(words) <= 2:
        return ", ".join(words)
    return f"{words[0]} and {len(words) - 1} others,\nsame colour in (b)"


def _in_words(variants: Iterable[str]) -> list[str]:
    return [str(variant).replace(" x", " × ") for variant in variants]


def _differs(ratio: xr.DataArray) -> str:
    """Largest difference of measured and predicted steps in words, "" if they are alike."""
    offs = 100.0 * (ratio.values[np.isfinite(ratio.values)] - UNSAFE)
    off = float(offs[np.argmax(abs(offs))])
    if abs(off) < ALIKE:
        return ""
    return f": measured {abs(off):.1f} % {'longer' if off > 0.0 else 'shorter'}"


def answer(ratio: xr.DataArray) -> str:
    """Title: in how many variants the measured stable step is as predicted, and whether it is safe."""
    low, high = (100.0 * (float(end) - UNSAFE) for end in (ratio.min(), ratio.max()))
    if max(abs(low), abs(high)) < ALIKE:
        return f"The longest stable explicit step is as predicted, to {STEP_FOUND:g} %"
    if low < -ALIKE:
        return f"The predicted stable step is up to {-low:.1f} % too long"
    others = [dim for dim in ratio.dims if dim != "variant"]
    off = (abs(ratio - UNSAFE) >= ALIKE / 100.0).any(others)
    alike = int((~off).sum())
    return f"The predicted stable step is safe, and as measured in {alike} of {off.size} variants"
