"""Design, tension: how much is needed, and what window the setting has."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, GREY, headline, panels

MUD = "mud weight (kg/m³)"


def minimum_tension(minimum_tension: xr.Dataset) -> Figure:
    """Tension needed along the riser, and over mud weight by formula and engine."""
    figure, (along, over) = panels(1, 2, 3.8)
    muds = minimum_tension["mud_weight"].values
    shown = muds[[0, len(muds) // 2, -1]]
    for colour, mud in zip(COLOURS, shown, strict=False):
        needed = minimum_tension["carrying_tension_along"].sel(mud_weight=mud)
        along.plot(needed / 1e6, needed["elevation"], ".-", color=colour, label=f"{mud:g} kg/m³")
    along.set_xlabel("tension needed at the top for this point (MN)")
    along.set_ylabel("elevation above the seabed (m)")
    along.legend(fontsize="small")
    formula, engine = (
        minimum_tension[name] / 1e6 for name in ("carrying_tension", "carrying_tension_engine")
    )
    over.plot(muds, formula, color=COLOURS[0], label="formula")
    over.plot(muds, engine, "o", color=COLOURS[1], label="engine: slack nowhere, in the current")
    over.set_xlabel(MUD)
    over.set_ylabel("smallest vertical tension (MN)")
    over.legend(fontsize="small")
    apart = float(abs(engine - formula).max()) * 1e3
    lowest = float(minimum_tension["governing_elevation"].max())
    headline(
        figure,
        f"The riser's lower end, {lowest:g} m above the seabed, asks for most tension; formula and engine "
        f"differ by {apart:.2g} kN at most",
    )
    return figure


def tension_window(
    tension_window: xr.Dataset, recoil_outcome: xr.Dataset, tension_ratio: float
) -> Figure:
    """Floors and ceiling of the setting over mud weight, a panel a number of failed units."""
    failed = tension_window["failed_units"].values
    figure, axes = panels(1, len(failed), 3.8, sharey=True)
    for ax, count in zip(axes, failed, strict=True):
        at = tension_window.sel(failed_units=count)
        mud, ceiling = at["mud_weight"], at["setting_ceiling"] / 1e6
        floor = at["setting_floor"].max("floor") / 1e6
        for colour, name in zip(COLOURS, at["floor"].values, strict=False):
            ax.plot(mud, at["setting_floor"].sel(floor=name) / 1e6, color=colour, label=f"{name}")
            engine = at["setting_floor_engine"].sel(floor=name) / 1e6
            label = "by the engine" if name == at["floor"].values[-1] else None
            ax.plot(mud, engine, "o", mfc="none", ms=4, color="black", label=label)
        ax.plot(mud, ceiling, color="black", label="0.9 of the dynamic tension limit")
        open_here = ceiling > floor
        ax.fill_between(mud, floor, ceiling, where=open_here, color=COLOURS[2], alpha=0.2, lw=0.0)
        if count == 0:
            _recoil(ax, recoil_outcome, tension_ratio)
        ax.set_xlabel(MUD)
        ax.set_title(f"{count} of the units failed", loc="right", fontsize="small")
        close = heaviest(at)
        if close is not None:
            ax.axvline(close, color=GREY, linestyle=":", label="no setting beyond")
    axes[0].set_ylabel("tension setting (MN)")
    of_all: dict[str, Artist] = {}
    for ax in axes:
        handles, labels = ax.get_legend_handles_labels()
        of_all |= dict(zip(labels, handles, strict=True))
    figure.legend(
        list(of_all.values()),
        list(of_all),
        loc="outside lower center",
        ncols=4,
        fontsize="small",
    )
    recoil = _allowed_by_recoil(recoil_outcome, tension_ratio)
    headline(figure, f"{_answer(tension_window)}; {recoil}")
    return figure


def _recoil(ax: Axes, outcome: xr.Dataset, tension_ratio: float) -> None:
    """From the least to the largest setting that serves a disconnect in the least heave, often the same."""
    calm = outcome.isel(heave_amplitude=0)
    heave = float(calm["heave_amplitude"])
    low, high = (calm[f"recoil_{end}"] / tension_ratio / 1e6 for end in ("minimum", "maximum"))
    label = f"of those tried, serve a disconnect\n(heave of {heave:g} m)"
    for mud, least, most in zip(calm["mud_weight"].values, low.values, high.values, strict=True):
        ax.plot([mud, mud], [least, most], "D-", color=COLOURS[3], ms=5, lw=2.0, label=label)
        label = ""


def _answer(tension_window: xr.Dataset) -> str:
    """Up to which mud there is a setting, by the number of failed units."""
    ends = {
        int(n): heaviest(tension_window.sel(failed_units=n)) for n in tension_window.failed_units
    }
    always = [n for n, end in ends.items() if end is None]
    said = [f"in every mud with up to {max(always)} of the units out"] if always else []
    said += [f"up to {end:.0f} kg/m³ with {n} out" for n, end in ends.items() if end is not None]
    return "There is a tension setting " + ", ".join(said)


def _allowed_by_recoil(outcome: xr.Dataset, tension_ratio: float) -> str:
    """The largest setting of those tried that serves a disconnect in the least heave, over all muds."""
    most = outcome["recoil_maximum"].isel(heave_amplitude=0) / tension_ratio / 1e6
    if most.isnull().all():
        return "no setting tried serves a disconnect"
    return f"of those tried recoil allows {float(most.max()):.1f} MN at most"


def heaviest(at: xr.Dataset) -> float | None:
    """Mud weight (kg/m3) from which on there is no setting; None where there always is."""
    gap, mud = at["setting_gap"].values, at["mud_weight"].values
    closed = np.flatnonzero(gap < 0.0)
    if not len(closed):
        return None
    k = int(closed[0])
    if k == 0:
        return float(mud[0])
    share = gap[k - 1] / (gap[k - 1] - gap[k])
    return float(mud[k - 1] + share * (mud[k] - mud[k - 1]))
