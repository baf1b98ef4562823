"""Labels and panels that figures of a towed riser share."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from chapters.mao_hangoff.figures.colours import OF_INPUT, ordered
from chapters.mao_hangoff.runs import STATED
from riserstudy.figures.style import mosaic, panel_title

AGAINST = "current 1 m/s, against"  # of Figs 9, 10 and 14
ASTERN, DEPTH = "displacement astern (m)", "depth below the joint (m)"
MOMENT = "|moment| at 130 s (kN m)"
RISE = "rise of the LMRP (m)"
TIME = "time (s)"
#: points, widths of lines that nearly coincide: the first is visible on both sides of the next
NESTED = (2.6, 1.6, 0.7)


def changes(runs: xr.Dataset, axis: str, first: float, last: float) -> dict[str, float]:
    """Change (%) of displacement, largest moment and largest rise of the LMRP along an axis."""
    ends = [runs.sel({axis: value}, method="nearest") for value in (first, last)]
    ratios = {
        "displacement": [abs(run["lmrp_displacement"].sel(time=STATED)) for run in ends],
        "largest moment": [run["bending_moment_size"].max("s") for run in ends],
        "largest rise": [run["lmrp_rise"].max("time") for run in ends],
    }
    return {name: 100.0 * (float(new) / float(old) - 1.0) for name, (old, new) in ratios.items()}


class Label(NamedTuple):
    """Text for a value of an axis: its number and unit, below a subject; both separately where room is short.

    ``subject``: first words of the whole text, "" for none. ``number``: template of the number and its unit.
    """

    subject: str
    number: str

    def short(self, value: float) -> str:
        """Number and unit of a value."""
        return self.number.format(value)

    def whole(self, value: float) -> str:
        """Subject, number and unit of a value."""
        return f"{self.subject} {self.short(value)}".strip()


def towed_panels(
    runs: xr.Dataset, axis: str, values: tuple[float, ...], label: Label, current: str
) -> Figure:
    """Figs 11, 12, 14 without key: shapes, moments, axial motion; the motions' differences from the first.

    ``values``: of the axis; differences are from the first. ``current``: speed and direction, title of (a).
    """
    figure, axes = mosaic(["a b c", "a b d"], (1.95, 1.95))
    for colour, value in zip(ordered(OF_INPUT[axis], values), values, strict=True):
        run = runs.sel({axis: value}, method="nearest")
        shape = run["displacement_along"].sel(time=STATED).dropna("s")
        moment = run["bending_moment_size"].dropna("s")
        top = float(shape["s"][-1])
        axes[0].plot(-shape, top - shape["s"], color=colour, label=label.whole(value))
        axes[1].plot(moment / 1e3, top - moment["s"], color=colour)
    rise_and_differences(axes[2], axes[3], runs, axis, values, label)
    axes[2].tick_params(labelbottom=False)
    axes[2].set_xlabel("")
    panel_title(axes[0], current)
    panel_title(axes[1], "magnitude of the moment")
    down(axes[0], ASTERN)
    down(axes[1], MOMENT)
    return figure


def rise_and_differences(
    ax: Axes, below: Axes, runs: xr.Dataset, axis: str, values: tuple[float, ...], label: Label
) -> None:
    """Axial motion of the LMRP in the first case and, in the panel below, the differences of the others."""
    first = runs["lmrp_rise"].sel({axis: values[0]}, method="nearest")
    for colour, value in zip(ordered(OF_INPUT[axis], values), values, strict=True):
        run = runs["lmrp_rise"].sel({axis: value}, method="nearest")
        if value == values[0]:
            ax.plot(run["time"], run, color=colour)
        else:
            below.plot(run["time"], run - first, color=colour)
    ax.set_ylabel("LMRP rise (m)")
    below.set_ylabel("difference (m)")
    ax.set_xlabel(TIME)
    below.set_xlabel(TIME)
    panel_title(ax, f"axial motion, {label.short(values[0])}")
    panel_title(below, f"differences from {label.short(values[0])}")


def name_upright(ax: Axes, x: float, up: float, text: str) -> None:
    """Write the value of a vertical line on its left, at a height (share of the panel; 1: below its end)."""
    at_end = up == 1.0
    ax.annotate(
        text, (x, up), xycoords=("data", "axes fraction"), xytext=(-3.0, -4.0 if at_end else 0.0),
        textcoords="offset points", ha="right", va="top" if at_end else "center", fontsize="small",
    )  # fmt: skip


def down(ax: Axes, label: str) -> None:
    """Label a panel whose depth increases downwards."""
    ax.set_xlabel(label)
    ax.set_ylabel(DEPTH)
    ax.invert_yaxis()


def sign_of_largest(moment: xr.DataArray) -> float:
    """Sign of a moment at its largest magnitude; multiplied by it, the largest moment is positive."""
    return float(np.sign(moment.isel(s=int(abs(moment).argmax("s")))))
