"""Design, operability: offsets at which limits are reached over current, one figure per mode."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from riserstudy.dataset.limits import PARTS
from riserstudy.design.envelopes import words_of
from riserstudy.figures.direct import label_ends
from riserstudy.figures.names import in_words
from riserstudy.figures.style import COLOURS, GREY, headline, key_below, panel_title, panels, shades

#: colour of each limit, in all modes
OF_LIMIT = {
    "mean lfj_angle": COLOURS[0],
    "largest lfj_angle": shades(COLOURS[0], 3)[0],
    "mean ufj_angle": COLOURS[1],
    "largest ufj_angle": shades(COLOURS[1], 3)[0],
    "largest joint_stroke": COLOURS[3],
    "largest von_mises_stress": COLOURS[2],
    "smallest effective_tension": COLOURS[6],
}
#: activity that a mode allows, as written in the titles
ALLOWED = {"drilling": "drilling", "connected": "staying connected", "disconnect": "a disconnect"}


def operability_drilling(operability: xr.Dataset) -> Figure:
    """Offsets at which the platform may drill."""
    return _chart(operability, "drilling")


def operability_connected(operability: xr.Dataset) -> Figure:
    """Offsets at which the riser may stay connected without drilling."""
    return _chart(operability, "connected")


def operability_disconnect(operability: xr.Dataset) -> Figure:
    """Offsets at which the riser must have disconnected."""
    return _chart(operability, "disconnect")


def _chart(operability: xr.Dataset, mode: str) -> Figure:
    """Draw the limits of a mode over current, one panel per mud density; limits that govern are strong."""
    muds = operability["mud_weight"].values
    figure, axes = panels(1, len(muds), 4.2, sharey=True)
    of_mode = operability.isel(limit=operability["mode_of_limit"].values == mode)
    mine = sorted(
        zip(words_of(of_mode), *(of_mode[name].values for name in ("limit", *PARTS[1:])), strict=True),
        key=lambda one: [*OF_LIMIT, one[0]].index(one[0]),  # limits of one joint are neighbours in the key
    )
    limits = operability["offset_of_limit"]
    envelopes = operability["envelope_offset"].sel(operation=mode)
    strong: dict[str, list[Line2D]] = {}  # in the last panel
    for ax, mud in zip(axes, muds, strict=True):
        for limit, name, side, output in mine:
            if not np.isfinite(limits.sel(limit=name)).any():
                continue
            governs = bool(((limits.sel(limit=name) == envelopes) & np.isfinite(envelopes)).any())
            lines = _line(
                ax,
                limits.sel(limit=name, mud_weight=mud),
                OF_LIMIT.get(limit, GREY),
                _in_words(limit),
                governs,
            )
            if governs and mud == muds[-1]:
                strong[_in_words(output if side == "largest" else limit)] = lines
        _shade(ax, envelopes.sel(mud_weight=mud), operability.attrs["reach"])
        ax.axhline(0.0, color="black", linewidth=0.6)
        ax.set_xlabel("surface current speed (m/s)")
        panel_title(ax, f"mud density {mud:g} kg/m³")
    axes[0].set_ylabel("platform offset, + down current (m)")
    key_below(figure, axes[0], 3)
    headline(figure, _answer(operability.sel(operation=mode), mode))
    left, right = axes[0].get_xlim()
    ends = [(line, name) for name, lines in strong.items() for line in lines if _drawn_to_end(line)]
    if ends:
        names = [name.replace(" joint ", "\njoint ") for _, name in ends]
        label_ends(axes[-1], [line for line, _ in ends], names=names)
    for ax in axes:
        ax.set_xlim(left, right)
    return figure


def _in_words(limit: str) -> str:
    """A limit in words, as in the key."""
    return in_words(limit).replace("joint stroke", "telescopic joint stroke")


def _line(ax: Axes, offset: xr.DataArray, colour: str, name: str, governs: bool) -> list[Line2D]:
    """Draw both sides of one limit, with gaps where the search does not reach it."""
    look: dict[str, Any] = {"linewidth": 2.0} if governs else {"markersize": 2.0, "linewidth": 0.9}
    drawn = []
    for side, label in (("low", None), ("high", name)):
        one = offset.sel(offset_side=side)
        drawn += ax.plot(
            one["surface_speed"], one.where(np.isfinite(one)), ".-", color=colour, label=label, **look
        )
    return drawn


def _drawn_to_end(line: Line2D) -> bool:
    """Whether a line has a value at the right edge of its panel."""
    return bool(np.isfinite(np.asarray(line.get_ydata(), dtype=float)[-1]))


def _shade(ax: Axes, envelope: xr.DataArray, reach: float) -> None:
    low, high = (envelope.sel(offset_side=side).clip(-reach, reach) for side in ("low", "high"))
    ax.fill_between(
        envelope["surface_speed"], low, high, color="0.5", alpha=0.18, lw=0.0, label="all limits met"
    )


def _answer(of: xr.Dataset, mode: str) -> str:
    """Title: the offsets that all muds allow, in the strongest current with any; or there is none.

    The current is named where it is the only one, or where not all currents allow these offsets; by its speed
    if it is not the strongest of several.
    """
    low, high = (of["envelope_offset"].sel(offset_side=side) for side in ("low", "high"))
    lowest, highest = low.max("mud_weight", skipna=False), high.min("mud_weight", skipna=False)
    speeds = of["surface_speed"].values
    left = speeds[(lowest <= highest).values]
    if not len(left):
        return f"In no current does an offset allow {ALLOWED[mode]} in every mud"
    at = {"surface_speed": left[-1]}
    offsets = _offsets(float(lowest.sel(at)), float(highest.sel(at)))
    if not offsets:
        return f"At {left[-1]:g} m/s of current, no limit bounds the offset for {ALLOWED[mode]}"
    muds = "every mud" if of.sizes["mud_weight"] > 1 else "this mud"
    within = (lowest <= lowest.sel(at)) & (highest >= highest.sel(at))
    if len(speeds) > 1 and bool(within.all()):
        where = "every mud and current" if of.sizes["mud_weight"] > 1 else "every current"
        return f"{offsets.capitalize()} allow {ALLOWED[mode]} in {where}"
    strongest = len(speeds) > 1 and left[-1] == speeds.max()
    where = "Strongest current:" if strongest else f"At {left[-1]:g} m/s of current,"
    return f"{where} {offsets} allow {ALLOWED[mode]} in {muds}"


def _offsets(low: float, high: float) -> str:
    """Words for the offsets (m) between two that the limits set; none where neither side has a limit."""
    if np.isinf(low) and np.isinf(high):
        return ""
    digits = 0 if high - low > 2.0 else 2
    above, below = _inwards(np.ceil, low, digits), _inwards(np.floor, high, digits)
    if np.isinf(low):
        return f"offsets below {below} m"
    if np.isinf(high):
        return f"offsets above {above} m"
    return f"offsets from {above} to {below} m"


def _inwards(rounded: np.ufunc, offset: float, digits: int) -> str:
    """An offset (m), rounded so that all offsets named are allowed; zero has no sign."""
    return f"{rounded(offset * 10**digits) / 10**digits + 0.0:.{digits}f}".replace("-", "−")
