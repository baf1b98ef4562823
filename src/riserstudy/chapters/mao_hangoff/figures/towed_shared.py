"""What figures of a towed riser have in common: labels and profiles."""

from __future__ import annotations

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.chapters.mao_hangoff.runs import STATED
from riserstudy.figures.insets import close_up
from riserstudy.figures.style import (
    COLOURS,
    panel_title,
    panels,
)

AGAINST = "current 1 m/s, against"  # of Figs 9, 10 and 14
ASTERN, DEPTH = "displacement astern (m)", "depth below the joint (m)"
MOMENT = "|bending moment| at 130 s (kN m)"
RISE = "rise of the LMRP (m)"
TIME = "time (s)"
NESTED = (
    2.6,
    1.6,
    0.7,
)  # points, of lines that nearly coincide: the first is seen on both sides of the next


def changes(runs: xr.Dataset, axis: str, first: float, last: float) -> dict[str, float]:
    """Change (%) of displacement, largest moment and largest rise of the LMRP along an axis."""
    ends = [runs.sel({axis: value}, method="nearest") for value in (first, last)]
    ratios = {
        "displacement": [abs(run["lmrp_displacement"].sel(time=STATED)) for run in ends],
        "largest moment": [run["bending_moment_size"].max("s") for run in ends],
        "largest rise": [run["lmrp_rise"].max("time") for run in ends],
    }
    return {name: 100.0 * (float(new) / float(old) - 1.0) for name, (old, new) in ratios.items()}


def three_panels(
    runs: xr.Dataset,
    axis: str,
    values: tuple[float, ...],
    label: str,
    current: str,
    motion: str = "axial motion",
) -> Figure:
    """Panels (a) to (c) of Figs 10 to 14, without a key.

    ``current``: speed and direction, of panel (a); ``motion``: title of panel (c).
    """
    figure, axes = panels(1, 3, 3.7)
    for colour, value, width in zip(COLOURS, values, NESTED, strict=False):
        run = runs.sel({axis: value}, method="nearest")
        shape = run["displacement_along"].sel(time=STATED).dropna("s")
        moment = run["bending_moment_size"].dropna("s")
        name = label.format(value)
        top = float(shape["s"][-1])
        axes[0].plot(-shape, top - shape["s"], color=colour, label=name)
        axes[1].plot(moment / 1e3, top - moment["s"], color=colour)
        axes[2].plot(run["time"], run["lmrp_rise"], color=colour, lw=width)
    for ax, title in zip(axes, (current, "size of the moment", motion), strict=True):
        panel_title(ax, title)
    down(axes[0], ASTERN)
    down(axes[1], MOMENT)
    axes[2].set_xlabel(TIME)
    axes[2].set_ylabel(RISE)
    close_up(axes[2])
    return figure


def down(ax: Axes, label: str) -> None:
    """Label a panel whose depth counts downwards."""
    ax.set_xlabel(label)
    ax.set_ylabel(DEPTH)
    ax.invert_yaxis()
