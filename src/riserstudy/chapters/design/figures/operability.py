"""Design, operability: offsets at which limits are reached against current, a figure a mode of operation."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, headline, key_below, panels

NAMES = {
    "lfj_angle": "lower flex joint",
    "ufj_angle": "upper flex joint",
    "joint_stroke": "stroke",
    "von_mises_stress": "von Mises stress",
    "effective_tension": "effective tension",
}

#: what a mode says of the offsets between which its limits are kept, and of there being none
ANSWERS = {
    "drilling": ("drilling goes on", "no offset lets drilling go on"),
    "connected": ("the riser may stay connected, not drilling", "no offset keeps it connected"),
    "disconnect": (
        "the riser can still be disconnected",
        "no offset keeps all limits of disconnect",
    ),
}


def operability_drilling(operability: xr.Dataset) -> Figure:
    """Where the platform may be while drilling."""
    return _chart(operability, "drilling")


def operability_connected(operability: xr.Dataset) -> Figure:
    """Where it may be while connected and not drilling."""
    return _chart(operability, "connected")


def operability_disconnect(operability: xr.Dataset) -> Figure:
    """Where the riser must have disconnected."""
    return _chart(operability, "disconnect")


def _chart(operability: xr.Dataset, mode: str) -> Figure:
    """A panel a mud weight."""
    muds = operability["mud_weight"].values
    figure, axes = panels(1, len(muds), 4.2, sharey=True)
    mine = [name for name in operability["limit"].values if str(name).startswith(mode + ":")]
    limits = operability["offset_of_limit"]
    for ax, mud in zip(axes, muds, strict=True):
        for colour, name in zip(COLOURS, mine, strict=False):
            reached = np.isfinite(limits.sel(limit=name)).any()
            said = _plain(str(name)) + ("" if reached else " (not reached)")
            _line(ax, limits.sel(limit=name, mud_weight=mud), colour, said)
        envelope = operability["envelope_offset"].sel(operation=mode, mud_weight=mud)
        _shade(ax, envelope, operability.attrs["reach"])
        ax.axhline(0.0, color="black", linewidth=0.6)
        ax.set_xlabel("current at the surface (m/s)")
        ax.set_title(f"mud of {mud:g} kg/m³", loc="right", fontsize="small")
    axes[0].set_ylabel("offset of the platform, + down current (m)")
    key_below(figure, axes[0], 3)
    headline(figure, _answer(operability.sel(operation=mode), mode))
    return figure


def _line(ax: Axes, offset: xr.DataArray, colour: str, name: str) -> None:
    """Both sides of one limit; where it is not reached within the search, nothing."""
    for side, label in (("low", None), ("high", name)):
        one = offset.sel(offset_side=side)
        ax.plot(one["surface_speed"], one.where(np.isfinite(one)), ".-", color=colour, label=label)


def _shade(ax: Axes, envelope: xr.DataArray, reach: float) -> None:
    low, high = (envelope.sel(offset_side=side).clip(-reach, reach) for side in ("low", "high"))
    ax.fill_between(
        envelope["surface_speed"], low, high, color="0.5", alpha=0.18, lw=0.0, label="all kept"
    )


def _answer(of: xr.Dataset, mode: str) -> str:
    """Where the platform may be in the strongest current that leaves it a place, and what governs."""
    low, high = (of["envelope_offset"].sel(offset_side=side) for side in ("low", "high"))
    lowest, highest = low.max("mud_weight", skipna=False), high.min("mud_weight", skipna=False)
    speeds = of["surface_speed"].values[(lowest <= highest).values]
    allowed, never = ANSWERS[mode]
    if not len(speeds):
        return f"In every current of the chart {never} in every mud"
    at = of["governing_limit_name"].sel(surface_speed=speeds[-1])
    low_by, high_by = (_words(_together(at.sel(offset_side=side))) for side in ("low", "high"))
    ends = [
        f"{float(end.sel(surface_speed=speeds[-1])):+.0f} m".replace("-", "−")
        for end in (lowest, highest)
    ]
    return (
        f"Up to {speeds[-1]:g} m/s of current, in every mud, {allowed}; at {speeds[-1]:g} m/s the platform "
        f"may be {ends[0]} ({low_by}) to {ends[1]} ({high_by}) from the well"
    )


def _together(names: xr.DataArray) -> str:
    """The limit that governs in all muds, or those that do."""
    return ", ".join(dict.fromkeys(str(name) for name in names.values))


def _words(name: str) -> str:
    for variable, said in NAMES.items():
        name = name.replace(variable, said)
    return name


def _plain(name: str) -> str:
    """A limit without its mode."""
    return _words(name.split(": ", 1)[1])
