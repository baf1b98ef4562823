"""Design, seas: where drilling goes on, by the height of the sea."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from riserstudy.chapters.design.figures.operability import NAMES
from riserstudy.figures.style import COLOURS, headline, key_below, panels

MODE = "drilling"


def operability_in_seas(operability_in_seas: xr.Dataset, allowances: xr.Dataset) -> Figure:
    """The envelope of drilling over current, a colour a sea, a panel a mud weight."""
    envelope = operability_in_seas["envelope_offset"].sel(operation=MODE)
    muds, heights = envelope["mud_weight"].values, envelope["significant_height"].values
    figure, axes = panels(1, len(muds), 4.0, sharey=True)
    for ax, mud in zip(axes, muds, strict=True):
        for colour, height in zip(COLOURS, heights, strict=False):
            at = envelope.sel(mud_weight=mud, significant_height=height)
            angle = np.rad2deg(
                float(allowances["ufj_angle_allowance"].sel(significant_height=height))
            )
            for side, label in (
                ("low", None),
                ("high", f"{height:g} m sea: upper flex joint +{angle:.1f}°"),
            ):
                one = at.sel(offset_side=side)
                ax.plot(one["surface_speed"], one, ".-", color=colour, label=label)
        ax.axhline(0.0, color="black", linewidth=0.6)
        ax.set_xlabel("current at the surface (m/s)")
        ax.set_title(f"mud of {mud:g} kg/m³", loc="right", fontsize="small")
    axes[0].set_ylabel("offset of the platform, + down current (m)")
    key_below(figure, axes[0], 3)
    headline(figure, _answer(operability_in_seas.sel(operation=MODE)))
    return figure


def _answer(of: xr.Dataset) -> str:
    """What the highest sea takes of the room that the lowest leaves, in no current."""
    calm = of.isel(surface_speed=0)
    ends = calm["envelope_offset"]
    room = ends.sel(offset_side="high") - ends.sel(offset_side="low")
    low, high = room.isel(significant_height=0), room.isel(significant_height=-1)
    heights = of["significant_height"].values
    names = calm["governing_limit_name"].isel(significant_height=-1).sel(offset_side="high").values
    governs = ", ".join(dict.fromkeys(_plain(str(name)) for name in names))
    if np.isnan(high).any():
        return f"In a sea of {heights[-1]:g} m no offset keeps all limits of drilling"
    taken = float((1.0 - high / low).max())
    less = f"{100 * taken:.0f} % of the room" if taken > 0.005 else "nothing of the room"
    return (
        f"A sea of {heights[-1]:g} m takes {less} that one of {heights[0]:g} m leaves for drilling "
        f"without current; what governs there: {governs}"
    )


def _plain(name: str) -> str:
    for variable, said in NAMES.items():
        name = name.replace(variable, said)
    return name
