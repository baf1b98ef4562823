"""Design, seas: offsets that allow drilling, by significant wave height."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.figure import Figure

from riserstudy.figures.style import headline, key_below, panel_title, panels

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
            angle = np.rad2deg(float(allowances["ufj_angle_allowance"].sel(significant_height=height)))
            for side, label in (("low", None), ("high", f"$H_s$ = {height:g} m (UFJ angle +{angle:.1f}°)")):
                one = at.sel(offset_side=side)
                ax.plot(one["surface_speed"], one, ".-", color=colour, lw=width, ms=5.0 + width, label=label)
        ax.axhline(0.0, color="black", linewidth=0.6)
        ax.set_xlabel("surface current speed (m/s)")
        panel_title(ax, f"mud of {mud:g} kg/m³")
    axes[0].set_ylabel("platform offset, + down current (m)")
    key_below(figure, axes[0], 3)
    headline(figure, _answer(operability_in_seas.sel(operation=MODE)))
    return figure


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
