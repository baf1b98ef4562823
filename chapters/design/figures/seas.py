"""Design, seas: offsets that allow drilling, by significant wave height."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from riserstudy.figures.style import headline, legend_below, panel_title, panels

MODE = "drilling"


def operability_in_seas(operability_in_seas: xr.Dataset, allowances: xr.Dataset) -> Figure:
    """Offsets that allow drilling, over current, one colour per sea state, one panel per mud density."""
    envelope = operability_in_seas["envelope_offset"].sel(operation=MODE)
    muds, heights = envelope["mud_weight"].values, envelope["significant_height"].values
    figure, axes = panels(1, len(muds), 4.0, sharey=True)
    for ax, mud in zip(axes, muds, strict=True):
        widths = np.linspace(3.5, 1.2, len(heights))  # coinciding lines stay visible
        for colour, height, width in zip(_rising(len(heights)), heights, widths, strict=True):
            at = envelope.sel(mud_weight=mud, significant_height=height)
            angle = _degrees(allowances["ufj_angle_allowance"].sel(significant_height=height))
            speed, low, high = (at["surface_speed"], *(at.sel(offset_side=side) for side in ("low", "high")))
            for one, label in ((low, None), (high, f"$H_s$ = {height:g} m (UFJ angle allowance {angle}°)")):
                ax.plot(speed, one, ".-", color=colour, lw=width, ms=5.0 + width, label=label)
            ax.fill_between(speed, low, high, color=colour, alpha=0.12, lw=0.0)
            _mark_end(ax, low, high, colour)
        ax.axhline(0.0, color="black", linewidth=0.6)
        ax.set_xlabel("surface current speed (m/s)")
        panel_title(ax, f"mud density {mud:g} kg/m³")
    axes[0].set_ylabel("platform offset, + down current (m)")
    handles, labels = axes[0].get_legend_handles_labels()
    shade = Patch(color="0.5", alpha=0.3, lw=0.0)
    none = Line2D([], [], linestyle="", marker="x", color="0.3")
    words = ("shaded: all drilling limits met", "no offset meets all limits")
    legend_below(figure, [*handles, shade, none], [*labels, *words], 2)
    headline(figure, _answer(operability_in_seas.sel(operation=MODE)))
    return figure


def _degrees(angles: xr.DataArray) -> str:
    """The smallest and the largest of some angles (rad), in degrees with one decimal."""
    low, high = (f"{np.rad2deg(float(one)):.1f}" for one in (angles.min(), angles.max()))
    return low if low == high else f"{low} to {high}"


def _mark_end(ax: Axes, low: xr.DataArray, high: xr.DataArray, colour: Any) -> None:
    """Close the range of offsets at the fastest current that has one, and mark faster currents."""
    there = (low <= high).values
    speeds = low["surface_speed"].values
    if there.all() or not there.any():
        return
    last = int(np.flatnonzero(there)[-1])
    ends = float(low[last]), float(high[last])
    ax.plot([speeds[last]] * 2, ends, color=colour, lw=1.2)
    beyond = speeds[last + 1 :]
    level = np.full(beyond.size, 0.05)  # of the panel, below the lines
    ax.plot(beyond, level, "x", color=colour, ms=6.0, mew=1.5, transform=ax.get_xaxis_transform())


def _answer(of: xr.Dataset) -> str:
    """Title: currents in which the highest sea allows drilling, or the reduction of the window by it."""
    heights = of["significant_height"].values
    ends = of["envelope_offset"]
    room = ends.sel(offset_side="high") - ends.sel(offset_side="low")
    low, high = room.isel(significant_height=0), room.isel(significant_height=-1)
    sea = f"$H_s$ = {heights[-1]:g} m"
    if np.isnan(high).all():
        return f"At {sea} no offset allows drilling"
    is_open = high.notnull().all("mud_weight").values
    if not is_open[0]:
        return f"At {sea} some muds do not allow drilling"
    if not is_open.all():
        fastest = float(of["surface_speed"][int(is_open.argmin()) - 1])
        return f"At {sea} every mud allows drilling up to {fastest:g} m/s of current"
    taken = 100.0 * (1.0 - high / low)
    least, most = (f"{float(end):.0f}" for end in (taken.min(), taken.max()))
    by = most if least == most else f"{least} to {most}"
    return f"Raising $H_s$ from {heights[0]:g} to {heights[-1]:g} m reduces the drilling window by {by} %"


def _rising(count: int) -> list[tuple[float, ...]]:
    """Colours of an ordered quantity, from light to dark."""
    return [tuple(colour) for colour in colormaps["viridis_r"](np.linspace(0.15, 0.95, count))]
