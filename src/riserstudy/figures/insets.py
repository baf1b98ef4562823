"""Parts of a panel, enlarged within it where it is empty."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from scipy.interpolate import CubicSpline

from riserstudy.figures.style import GREY, PRINTED

CLOSE_UP = 20.0  # s, at the end of records
FINE = 400  # points of a curve there


def enlarge(
    ax: Axes,
    place: tuple[float, float, float, float],
    x: tuple[float, float],
    depth: tuple[float, float],
) -> None:
    """Part of a panel of depths, enlarged where the panel is empty (``place``: shares of it)."""
    inset = ax.inset_axes(place, xlim=x, ylim=depth[::-1])
    for line in ax.lines:
        style: dict[str, Any] = {"color": line.get_color(), "lw": min(1.2, line.get_linewidth())}
        if str(line.get_label()).startswith("printed"):  # over the whole panel
            inset.axvline(float(np.asarray(line.get_xdata())[0]), **(PRINTED | style))
        else:
            inset.plot(*line.get_data(), **style)
    inset.tick_params(labelsize="x-small")
    ax.indicate_inset_zoom(inset, edgecolor=GREY)


def close_up(ax: Axes) -> None:
    """The last crests of curves over time, enlarged, where they would lie on one another.

    They are drawn as cubic splines: outputs alone would make a crest a triangle.
    """
    curves = [(np.asarray(line.get_xdata()), np.asarray(line.get_ydata())) for line in ax.lines]
    end = max(float(t[-1]) for t, _ in curves)
    lowest, highest = ax.get_ylim()
    ticks = [tick for tick in ax.get_yticks() if lowest <= tick <= highest]
    ax.set_ylim(lowest, highest + 0.85 * (highest - lowest))
    ax.set_yticks(ticks)
    inset = ax.inset_axes((0.17, 0.62, 0.8, 0.28))
    tops = []
    for line, (t, z) in zip(ax.lines, curves, strict=True):
        fine = np.linspace(end - CLOSE_UP, float(t[-1]), FINE)
        curve = CubicSpline(t, z)(fine)
        inset.plot(fine, curve, color=line.get_color(), lw=1.0)
        tops.append(float(curve.max()))
    spread = max(max(tops) - min(tops), 0.02 * abs(max(tops)))
    inset.set_ylim(min(tops) - 2.0 * spread, max(tops) + spread)
    inset.tick_params(labelsize="x-small")
    inset.set_title("crests of the last 20 s (splines)", fontsize="x-small", pad=2)
