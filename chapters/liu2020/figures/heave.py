"""Effective tension under heave, and the heave at which the tensioners stroke out."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from chapters.liu2020.below_ring import RING
from chapters.liu2020.figures.colours import LINEAR, LINEARISED, ON_TENSIONERS, VERTICAL_CYLINDERS
from chapters.liu2020.figures.motion_shared import DEPTH, TIME
from riserstudy.figures.direct import label_ends
from riserstudy.figures.insets import enlarge, name_axes
from riserstudy.figures.style import GREY, field, headline, key_below, panel_title, panels, shades
from riserstudy.records.numerals import rounded_up

DEPTHS = (100.0, 200.0, 300.0, 400.0)  # m below the riser's top, as in Fig 18
ALIKE = 0.02  # share of an amplitude, below which a difference is invisible
STROKE = 7.5  # m, in both directions
ABOUT_ZERO = (6.6, 7.5), (-0.6, 1.4)  # heave (m) and tension (MN) of the inset
TENSION = "effective tension (kN)"
LEVELS = 100.0  # kN, between lines of equal tension
AMPLITUDE, PERIOD = "heave amplitude of the platform (m)", "heave period of the platform (s)"


def fig13(heave_case: xr.Dataset) -> Figure:
    """Effective tension over depth and time."""
    figure, (ax,) = panels(height=3.8)
    tension = _by_depth(heave_case.sel(tensioner_model="gas law"))["effective_tension"] / 1e3
    field(figure, ax, tension, "time", "depth", TENSION)
    _equal(ax, tension)
    ax.set_xlabel(TIME)
    ax.set_ylabel(DEPTH)
    ax.invert_yaxis()
    top, bottom = (0.5 * float(at.max() - at.min()) for at in (tension.isel(depth=0), tension.isel(depth=-1)))
    headline(
        figure,
        f"Heave varies the tension equally at all depths, by ±{0.5 * (top + bottom):.0f} kN"
        if abs(top / bottom - 1.0) < ALIKE
        else f"Heave gives a tension amplitude of {top:.0f} kN at the top, {bottom:.0f} kN at the bottom",
    )
    return figure


def _equal(ax: Axes, tension: xr.DataArray) -> None:
    """Draw lines of equal tension, which are upright where tension is alike at all depths."""
    low, high = (float(end) / LEVELS for end in (tension.min(), tension.max()))
    levels = LEVELS * np.arange(np.ceil(low), np.floor(high) + 1.0)
    by_depth = tension.transpose("depth", "time")
    lines = ax.contour(by_depth["time"], by_depth["depth"], by_depth, levels, colors="0.25", linewidths=0.7)
    name = f"lines of equal tension, every {LEVELS:g} kN"
    lines.set_label(name)
    panel_title(ax, name)


def fig14(heave_case: xr.Dataset, heave_upright: xr.Dataset) -> Figure:
    """Effective tension over time at four depths, and the difference of other models at the first."""
    figure, (ax, below) = panels(2, 1, 2.8, sharex=True)
    tension = _by_depth(heave_case)["effective_tension"] / 1e3
    law = tension.sel(tensioner_model="gas law")
    for colour, depth in zip(shades(ON_TENSIONERS, len(DEPTHS)), DEPTHS, strict=True):
        curve = law.interp(depth=depth)
        ax.plot(curve["time"], curve, color=colour, linewidth=1.3, label=f"at {depth:.0f} m")
    vertical = _by_depth(heave_upright)["effective_tension"].squeeze("tensioner_model") / 1e3
    others = {
        LINEARISED: (LINEAR, tension.sel(tensioner_model="linear")),
        "vertical cylinders": (VERTICAL_CYLINDERS, vertical),
    }
    for label, (colour, other) in others.items():
        apart = (other - law).interp(depth=DEPTHS[0])
        below.plot(apart["time"], apart, color=colour, linewidth=1.3, label=label)
    panel_title(ax, "gas law, inclined cylinders")
    panel_title(below, f"other models minus (a), at {DEPTHS[0]:.0f} m")
    below.axhline(0.0, color=GREY, linewidth=0.8)
    below.set_xlabel(TIME)
    ax.set_ylabel(TENSION)
    below.set_ylabel("difference (kN)")
    swing = 0.5 * (law.max("time") - law.min("time"))
    share = 100.0 * float(swing.isel(depth=0) / law.isel(depth=0).mean())
    headline(
        figure,
        f"Heave gives a tension amplitude of up to {float(swing.max()):.0f} kN, {share:.0f} % of the tension",
    )
    for panel in (ax, below):
        label_ends(panel)
    return figure


def fig15(heave: xr.Dataset) -> Figure:
    """Amplitude of the effective tension over heave amplitude, for all periods, and over period."""
    figure, axes = panels(1, 2, 3.8, sharey=True)
    law, line = heave["axial_force_amplitude"] / 1e3, heave["axial_force_amplitude_linear"] / 1e3
    at = law["heave_amplitude"]
    axes[0].fill_between(
        at, law.min("heave_period"), law.max("heave_period"), color=ON_TENSIONERS, alpha=0.3, lw=0.0,
        label=f"gas law, {float(law['heave_period'].min()):g} to {float(law['heave_period'].max()):g} s",
    )  # fmt: skip
    middle = {"heave_period": 15.0}
    axes[0].plot(at, law.sel(middle), ".-", color=ON_TENSIONERS, label="gas law, 15 s")
    axes[0].plot(at, line.sel(middle), "--", color=LINEAR, label=f"{LINEARISED}, 15 s")
    for amplitude in at.values:
        curve = law.sel(heave_amplitude=amplitude)
        axes[1].plot(curve["heave_period"], curve, ".-", color=ON_TENSIONERS, ms=4, label=f"{amplitude:g} m")
    axes[0].set_xlabel(AMPLITUDE)
    axes[0].set_ylabel("amplitude of the effective tension (kN)")
    axes[1].set_xlabel(PERIOD)
    panel_title(axes[0], "tension over heave amplitude")
    panel_title(axes[1], "gas law, over heave period, by heave amplitude")
    spread = float((law.max("heave_period") / law.min("heave_period") - 1.0).max())
    most = rounded_up(100.0 * spread, 2)
    headline(figure, f"Heave amplitude sets the tension amplitude; the period adds at most {most} %")
    key_below(figure, axes[0], 3)
    label_ends(axes[1])
    axes[1].margins(x=0.02)  # room for whole marks at both ends
    return figure


def heave_limit(heave_limit: xr.Dataset) -> Figure:
    """Stroke and tension up to and beyond the end stops."""
    figure, axes = panels(1, 2, 3.6)
    reach = heave_limit["tensioner_stroke"].isel(cylinder=0)
    tension = heave_limit["effective_tension"].isel(s=0) / 1e6
    stops = heave_limit["stop_stiffness"].values
    colours = shades(VERTICAL_CYLINDERS, len(stops))
    for colour, width, stiffness in zip(colours, (5.0, 3.0, 1.2), stops, strict=False):
        for quantity, ax in ((reach, axes[0]), (tension, axes[1])):
            curve = quantity.sel(stop_stiffness=stiffness)
            for side in ("max", "min"):
                ends = getattr(curve, side)("time")
                label = f"stop stiffness {stiffness:g} MN/m" if side == "max" else None
                ax.plot(ends["heave_amplitude"], ends, color=colour, linewidth=width, marker=".", label=label)
    for limit, name in ((-STROKE, "stop, retracted"), (STROKE, "stop, extended")):
        axes[0].axhline(limit, color="black", linewidth=1.0)
        axes[0].annotate(
            f"{name}: {limit:+g} m".replace("-", "−"), (0.02, limit), xycoords=("axes fraction", "data"),
            xytext=(0, 4 if limit > 0.0 else -4), textcoords="offset points", fontsize="small",
            va="bottom" if limit > 0.0 else "top",
        )  # fmt: skip
    axes[0].margins(y=0.15)
    axes[1].axhline(0.0, color="black", linewidth=1.0)
    axes[1].annotate(
        "negative below", (0.02, 0.0), xycoords=("axes fraction", "data"), xytext=(0, -4),
        textcoords="offset points", fontsize="small", va="top",
    )  # fmt: skip
    axes[0].set_ylabel("stroke of a cylinder (m)")
    axes[1].set_ylabel("effective tension (MN)")
    panel_title(axes[0], "largest and smallest stroke")
    panel_title(axes[1], "largest and smallest tension at the bottom")
    for ax in axes:
        ax.set_xlabel(AMPLITUDE)
    negative = _from(-tension.min(("time", "stop_stiffness")), 0.0)
    free, stopped = _between(abs(reach).max(("time", "stop_stiffness")), STROKE)
    if stopped is not None:
        _shade(axes, free, stopped)
    if negative is not None:
        name = f"negative from\n{negative:.1f} m of heave"
        _mark(axes[1], (negative, 0.0), name, (-14.0, -62.0))
        _near_zero(axes[1])
    words = "Tension stays positive" if negative is None else (
        f"Tension becomes negative at {negative:.1f} m of heave"
    )  # fmt: skip
    acts = "no stop acts" if stopped is None else f"a stop acts at {stopped:g} m"
    first = negative is not None and stopped is not None and negative <= free
    headline(figure, f"{words}, before a stop acts" if first else f"{words}; {acts}")
    key_below(figure, axes[0], 3)
    return figure


def _between(values: xr.DataArray, level: float) -> tuple[float, float | None]:
    """Heave (m) of the last run up to a level and of the first run above it; None if no run is above it."""
    heave, over = values["heave_amplitude"].values, values.values > level
    if not over.any():
        return float(heave[-1]), None
    k = int(np.argmax(over))
    return float(heave[max(k - 1, 0)]), float(heave[k])


def _shade(axes: list[Axes], free: float, stopped: float) -> None:
    """Shade the interval between the runs in which a stop is first reached."""
    for ax in axes:
        ax.axvspan(free, stopped, color="0.85", lw=0.0, zorder=0)
    axes[0].annotate(
        "first contact with a stop\nbetween these runs", (0.5 * (free + stopped), 0.0), xytext=(-24.0, 0.0),
        textcoords="offset points", ha="right", va="center", fontsize="small",
        arrowprops={"arrowstyle": "-", "lw": 0.7, "shrinkB": 0.0},
    )  # fmt: skip


def _mark(ax: Axes, at: tuple[float, float], text: str, offset: tuple[float, float]) -> None:
    """Mark the point where a curve first reaches a level, with a text at an offset in points."""
    ax.plot(*at, "o", color="black", ms=7, mfc="none", mew=1.2, zorder=5)
    ax.annotate(
        text, at, xytext=offset, textcoords="offset points", ha="center", va="bottom",
        fontsize="small", arrowprops={"arrowstyle": "-", "lw": 0.7, "shrinkB": 4.0},
    )  # fmt: skip


def _near_zero(ax: Axes) -> None:
    """Enlarge, in the panel's empty part, the tension near the heave (m) at which it becomes negative."""
    inset = enlarge(ax, (0.14, 0.54, 0.36, 0.3), *ABOUT_ZERO, 3.0)
    name_axes(inset, "heave amplitude (m)", "tension (MN)")


def _from(values: xr.DataArray, level: float) -> float | None:
    """Heave (m) where values first exceed a level, interpolated linearly; None if they never exceed it."""
    heave, over = values["heave_amplitude"].values, values.values - level
    if not (over > 0.0).any():
        return None
    k = int(np.argmax(over > 0.0))
    if not k:
        return float(heave[0])
    return float(np.interp(0.0, over[k - 1 : k + 1], heave[k - 1 : k + 1]))


def _by_depth(runs: xr.Dataset) -> xr.Dataset:
    """Replace the arclength from the riser's bottom by the depth below its top."""
    runs = runs.sel(s=runs["s"] <= RING + 1e-6)
    length = float(np.max(runs["s"]))
    return runs.assign_coords(depth=length - runs["s"]).swap_dims(s="depth").sortby("depth")
