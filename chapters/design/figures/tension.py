"""Design, tension: minimum top tension, and window of the tension setting."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, GREY, headline, legend_below, panel_title, panels, shades
from riserstudy.records.arrays import FloatArray

MUD = "mud density (kg/m³)"


def minimum_tension(minimum_tension: xr.Dataset) -> Figure:
    """Minimum top tension for each point of the riser, and over mud density by formula and simulation."""
    figure, (along, over) = panels(1, 2, 3.8)
    muds = minimum_tension["mud_weight"].values
    chosen = muds[[0, len(muds) // 2, -1]]
    for colour, mud in zip(shades(COLOURS[0], len(chosen)), chosen, strict=True):
        needed = minimum_tension["carrying_tension_along"].sel(mud_weight=mud)
        along.plot(needed / 1e6, needed["elevation"], ".-", color=colour, label=f"{mud:g} kg/m³")
    along.set_xlabel("top tension that an elevation requires (MN)")
    along.set_ylabel("elevation above the seabed (m)")
    along.legend(fontsize="small", title="mud density", title_fontsize="small")
    panel_title(along, "required at each elevation, by formula")
    formula, engine = (
        minimum_tension[name] / 1e6 for name in ("carrying_tension", "carrying_tension_engine")
    )
    over.plot(muds, formula, color="black", label="formula")
    over.plot(muds, engine, "o", mfc="none", color="black", label="simulation, in the current")
    over.set_xlabel(MUD)
    over.set_ylabel("minimum top tension, vertical (MN)")
    over.legend(fontsize="small")
    apart = _less_than(100.0 * float((abs(engine - formula) / formula).max()))
    panel_title(over, f"formula and simulation differ by {apart}")
    lowest = float(minimum_tension["governing_elevation"].max()) == float(minimum_tension["elevation"].min())
    headline(
        figure,
        "The lower end of the riser governs the minimum top tension"
        if lowest
        else "Minimum top tension by formula and by simulation",
    )
    return figure


def _less_than(percent: float) -> str:
    """Words for a small difference: the next power of ten above it; from 1 % on, its number."""
    if percent >= 1.0:
        return f"{percent:.2g} %"
    bound = 10.0 ** (np.floor(np.log10(max(percent, 1e-6))) + 1.0)
    return f"less than {np.format_float_positional(bound, precision=3, fractional=False, trim='-')} %"


def tension_window(tension_window: xr.Dataset, recoil_outcome: xr.Dataset, tension_ratio: float) -> Figure:
    """Floors and ceiling of the setting over mud density, one panel per number of failed units.

    The range between floors and ceiling is hatched. Diamonds are settings that a simulated disconnect
    allows, filled at or above the floors; crosses are settings that failed it.
    """
    failed = tension_window["failed_units"].values
    figure, axes = panels(1, len(failed), 3.8, sharey=True)
    for ax, count in zip(axes, failed, strict=True):
        at = tension_window.sel(failed_units=count)
        mud, ceiling = at["mud_weight"], at["setting_ceiling"] / 1e6
        floor = at["setting_floor"].max("floor") / 1e6
        for colour, name in zip(COLOURS, at["floor"].values, strict=False):
            ax.plot(mud, at["setting_floor"].sel(floor=name) / 1e6, color=colour, label=f"floor: {name}")
            engine = at["setting_floor_engine"].sel(floor=name) / 1e6
            label = "floors by simulation" if name == at["floor"].values[-1] else None
            ax.plot(mud, engine, "o", mfc="none", ms=4, color="black", label=label)
        ax.plot(mud, ceiling, color="black", label="ceiling: share of the dynamic tension limit")
        ax.fill_between(
            mud, floor, ceiling, where=ceiling > floor, facecolor="none", edgecolor="0.75",
            hatch="///", lw=0.0, label="window between floors and ceiling",
        )  # fmt: skip
        title = f"{count or 'no'} unit{'' if count == 1 else 's'} failed"
        if count == 0:
            _recoil(ax, recoil_outcome, at, tension_ratio)
        else:
            title += "; no disconnect run"
        ax.set_xlabel(MUD)
        panel_title(ax, title)
        close = heaviest(at)
        if close is not None:
            ax.axvline(close, color=GREY, linestyle=":")
            ax.annotate(
                "no window\nbeyond", (close, 0.04), (-4, 0), xycoords=("data", "axes fraction"), ha="right",
                textcoords="offset points", fontsize="small", color="0.3",
            )  # fmt: skip
    axes[0].set_ylabel("tension setting (MN)")
    of_all: dict[str, Artist] = {}
    for ax in axes:
        handles, labels = ax.get_legend_handles_labels()
        of_all |= dict(zip(labels, handles, strict=True))
    legend_below(figure, list(of_all.values()), list(of_all), 3)
    headline(figure, _allowed(recoil_outcome, tension_ratio))
    return figure


def _recoil(ax: Axes, outcome: xr.Dataset, window: xr.Dataset, tension_ratio: float) -> None:
    """Draw the tested settings: diamonds where a disconnect in the smallest heave is safe, else crosses."""
    calm = outcome.isel(heave_amplitude=0)
    heave = float(calm["heave_amplitude"])
    floor = window["setting_floor"].max("floor").interp(mud_weight=calm["mud_weight"])
    setting, safe = xr.broadcast(calm["setting"] / tension_ratio, calm["recoil_verdict"] == 0)
    below = setting < floor  # not so where no floor is known: for muds outside of the window's
    known = f"disconnect, {heave:g} m heave amplitude"
    faces: dict[str, Any] = {"ms": 6.0, "color": COLOURS[2], "zorder": 2.5}
    for label, where, mark, look in (
        (f"safe {known}", safe & ~below, "D", faces),
        (f"safe {known}, below a floor", safe & below, "D", faces | {"mfc": "white"}),
        (f"failed {known}", ~safe, "x", {"ms": 5.0, "color": GREY}),
    ):
        if bool(where.any()):
            muds, values = xr.broadcast(calm["mud_weight"], (setting / 1e6).where(where))
            ax.plot(
                muds.values.ravel(), values.transpose(*muds.dims).values.ravel(), mark, label=label, **look
            )


def _ends(outcome: xr.Dataset, tension_ratio: float) -> tuple[FloatArray, FloatArray]:
    """Smallest and largest tested settings (MN) for a disconnect in the smallest heave, (muds,) each."""
    calm = outcome.isel(heave_amplitude=0).sortby("mud_weight")
    low, high = (calm[f"recoil_{end}"] / tension_ratio / 1e6 for end in ("minimum", "maximum"))
    return low.values, high.values


def _allowed(outcome: xr.Dataset, tension_ratio: float) -> str:
    """Title: how the tested settings that allow a disconnect depend on mud density."""
    low, high = _ends(outcome, tension_ratio)
    if np.isnan(high).all():
        return "No tested tension setting allows a safe disconnect"
    if not np.isnan(high).any() and all(
        end[0] < end[-1] and (np.diff(end) >= 0.0).all() for end in (low, high)
    ):
        return "The tension setting for a safe disconnect increases with mud density"
    least, most = f"{np.nanmin(low):.1f}", f"{np.nanmax(high):.1f}"
    if least == most:
        return f"Of the tested tension settings, only {most} MN allows a safe disconnect"
    return f"Tension settings from {least} to {most} MN allow a safe disconnect"


def heaviest(at: xr.Dataset) -> float | None:
    """Mud density (kg/m3) above which no setting is allowed; None if every density has one."""
    gap, mud = at["setting_gap"].values, at["mud_weight"].values
    closed = np.flatnonzero(gap < 0.0)
    if not len(closed):
        return None
    k = int(closed[0])
    if k == 0:
        return float(mud[0])
    share = gap[k - 1] / (gap[k - 1] - gap[k])
    return float(mud[k - 1] + share * (mud[k] - mud[k - 1]))
