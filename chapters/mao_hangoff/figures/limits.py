"""Figures beyond Mao, Zeng, Liu: limits of the platform's speed, and the riser's tension in heave."""

from __future__ import annotations

import json

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Annotation
from matplotlib.ticker import NullFormatter
from numpy.typing import NDArray

from chapters.mao_hangoff.figures.colours import OF_INPUT
from riserstudy.figures.direct import label_ends, label_line
from riserstudy.figures.style import GREY, headline, legend_below, mosaic, panel_title, panels, shades
from riserstudy.scene.origin import unwrap

HUNG = {"hard": "locked to the platform", "soft": "on tensioners"}
MARKS = ("o", "s", "^", "v")  # of limits; the last if no limit is reached
KEPT, LOST = "Blues", "Oranges"  # of tension ranges
SHADES = 128  # of a colour bar


def speed_limits(speed_limits: xr.Dataset) -> Figure:
    """Largest speed over ground over length, by LMRP mass, one panel per current; marks: governing limit."""
    currents = speed_limits["current_speed"].values
    figure, axes = panels(1, len(currents), 3.6, sharey=True)
    names = [str(name) for name in speed_limits["limit"].values]
    governing = np.unique(speed_limits["governing_limit"].values.astype(int))
    for ax, current in zip(axes, currents, strict=True):
        at = speed_limits.sel(current_speed=current)
        _speeds(ax, at, governing)
        knots = float((at["speed_through_water"] - at["speed_limit"]).mean())
        words = f"opposing current: {current:g} m/s ({knots:.1f} kn)"
        panel_title(ax, words if current else "no current")
        ax.set_xticks(at["riser_length"].values)
        ax.set_xlabel("riser length (m)")
    axes[0].set_ylabel("largest speed over ground (kn)")
    if len(governing) > 1 or governing[0] < 0:
        marks = [
            Line2D([], [], ls="none", marker=MARKS[which], color=GREY, label=_governs(which, names))
            for which in governing
        ]
        legend_below(figure, marks, [str(mark.get_label()) for mark in marks], 4)
    else:
        axes[0].annotate(
            _limit_in_words(speed_limits, names[governing[0]]), (0.05, 0.05), xycoords="axes fraction",
            fontsize="small",
        )  # fmt: skip
    headline(figure, _slowest_and_fastest(speed_limits, names))
    for ax in axes[:-1]:
        ax.margins(x=0.0)
    label_ends(axes[-1])
    for ax in axes:
        ax.margins(x=0.05)  # room for whole marks, and between numbers of neighbouring panels
    highest = max(float(text.xy[1]) for text in axes[-1].texts if isinstance(text, Annotation))
    axes[-1].annotate(
        "LMRP\nmass", (1.0, highest), xycoords="axes fraction", xytext=(4.0, 7.0), fontsize="small",
        textcoords="offset points", va="bottom", annotation_clip=False,
    )  # fmt: skip
    return figure


def _speeds(ax: Axes, at: xr.Dataset, governing: NDArray[np.int_]) -> None:
    masses = at["lmrp_mass"].values
    for colour, mass in zip(shades(OF_INPUT["lmrp_mass"], len(masses)), masses, strict=True):
        one = at.sel(lmrp_mass=mass)
        ax.plot(one["riser_length"], one["speed_limit"], color=colour, label=f"{mass:g} t")
        for which in governing:
            held = one["speed_limit"].where(one["governing_limit"] == which)
            ax.plot(one["riser_length"], held, MARKS[which], color=colour, ms=5)


def _governs(which: int, names: list[str]) -> str:
    return "no limit reached up to this speed" if which < 0 else f"{names[which]} governs"


def _limit_in_words(speed_limits: xr.Dataset, name: str) -> str:
    """Text of a limit that governs everywhere, with its value and the status of the value."""
    plain, given, _ = unwrap(json.loads(speed_limits.attrs["settings"]))
    setting = name.replace(" ", "_")
    status = f" ({given[setting].status})" if setting in given else ""
    return f"on all lines the {name}\nreaches {plain[setting].replace(' deg', '°')}{status}"


def _slowest_and_fastest(speed_limits: xr.Dataset, names: list[str]) -> str:
    """Title: least and largest speed that the limits allow, and the governing limits."""
    speed = speed_limits["speed_limit"]
    which = set(speed_limits["governing_limit"].values.astype(int).ravel().tolist())
    held = " or ".join(names[k] for k in sorted(which - {-1}))
    low, high = float(speed.min()), float(speed.max())
    if not held:
        return f"No limit is reached up to {high:.1f} kn"
    if -1 in which:  # with some risers, the fastest simulated speed is within all limits
        return f"The {held} limits the speed to {low:.1f} kn or more"
    return f"The {held} limits the speed to between {low:.1f} and {high:.1f} kn"


def hang_off(tension_limits: xr.Dataset) -> Figure:
    """Top tension range over heave, soft and hard; least heave with negative tension, hard, by LMRP mass.

    The title is about the heaviest LMRP, which the upper panels show.
    """
    figure, axes = mosaic(["a b", "c c"], [3.5, 3.1])
    of_paper = tension_limits.isel(riser_length=-1, lmrp_mass=-1)
    spread = of_paper["tension_range"].transpose("mode", "heave_amplitude", "heave_period") / 1e6
    norm = LogNorm(float(spread.min()), float(spread.max()))
    for ax, mode in zip(axes, ("soft", "hard"), strict=False):
        at = of_paper.sel(mode=mode)
        slack = at["smallest_tension"].transpose("heave_amplitude", "heave_period") < 0.0
        _cells(ax, spread.sel(mode=mode), norm, slack)
        riser = f"{float(of_paper['riser_length']):g} m, {float(of_paper['lmrp_mass']):g} t"
        panel_title(ax, f"{HUNG[mode]} ({mode}), {riser}")
        ax.set_xlabel("heave period (s)")
        ax.set_ylabel("heave amplitude (m)")
    _two_scales(_bar(figure, axes[:2], norm, LOST, "range of top tension (MN)", 8.0), norm)
    lost = tension_limits["heave_that_loses_tension"]
    _negative_from(axes[2], lost.sel(mode="hard"), float(tension_limits["heave_amplitude"].max()))
    headline(figure, _where_negative(lost.isel(lmrp_mass=-1)))
    return figure


def _negative_from(ax: Axes, lost: xr.DataArray, most: float) -> None:
    """Least heave with negative tension over the period, by LMRP mass; NaN: above ``most`` (m)."""
    masses = lost["lmrp_mass"].values
    for k, (colour, mass) in enumerate(zip(shades(OF_INPUT["lmrp_mass"], len(masses)), masses, strict=True)):
        one = lost.sel(lmrp_mass=mass)
        low = one.min("riser_length")
        high = one.fillna(most).max("riser_length").where(low.notnull())
        period = one["heave_period"]
        ax.fill_between(period, low, high, color=colour, alpha=0.2, lw=0.0)
        (line,) = ax.plot(period, low, "o-", color=colour, ms=4, lw=1.5, label=f"{mass:g} t")
        ends = np.flatnonzero(np.isfinite(low.values))
        if len(ends):  # the shortest line is that of the heaviest LMRP, whose right side is crowded
            side = (-7.0, 12.0) if k and k == len(masses) - 1 else (7.0, -3.0)
            label_line(ax, line, ends[-1] / max(len(low) - 1, 1), side, va="center")
    heaviest = lost.isel(lmrp_mass=-1)
    if bool(heaviest.notnull().any()):
        worst = heaviest.where(heaviest == heaviest.min(), drop=True)
        length, at = (float(worst[axis][0]) for axis in ("riser_length", "heave_period"))
        least = float(worst.min())
        ax.plot(at, least, "o", ms=10, mfc="none", color="black", mew=1.2)
        ax.annotate(
            f"{_two_digits(least)} m: LMRP of {masses[-1]:g} t, riser of {length:g} m", (at, least),
            xytext=(30.0, -12.0), textcoords="offset points", fontsize="small", va="center",
            arrowprops={"arrowstyle": "-", "lw": 0.7, "shrinkB": 5.0},
        )  # fmt: skip
    ax.set_ylim(0.0, most)
    ax.set_xticks(lost["heave_period"].values)
    ax.set_xlim(float(lost["heave_period"].min()) - 0.5, float(lost["heave_period"].max()) + 0.5)
    ax.text(
        0.985, 0.07, f"no line: tension stays positive up to {most:g} m", transform=ax.transAxes, ha="right",
        fontsize="small", color="0.3",
    )  # fmt: skip
    ax.set_xlabel("heave period (s)")
    ax.set_ylabel("least heave amplitude\nwith negative tension (m)")
    lengths = lost["riser_length"].values
    bands = f"bands: risers of {lengths[0]:g} to {lengths[-1]:g} m"
    panel_title(ax, f"{HUNG['hard']} (hard), by LMRP mass; {bands}")


def _bar(
    figure: Figure, of: list[Axes], norm: Normalize, colours: str, label: str, aspect: float = 20.0
) -> Axes:
    """Panel of one colour bar for several panels; ``aspect``: its height relative to its width."""
    bar = figure.colorbar(ScalarMappable(norm, colours), ax=of, label=label, pad=0.01, aspect=aspect)
    bar.ax.yaxis.set_major_formatter("{x:g}")
    bar.ax.yaxis.set_minor_formatter(NullFormatter())
    return bar.ax


def _two_scales(bar: Axes, norm: Normalize) -> None:
    """Cover the left half of a colour bar by the colours of positive tension, and name both halves."""
    levels = np.geomspace(norm.vmin or 1.0, norm.vmax or 1.0, SHADES + 1)
    bar.pcolormesh([0.0, 0.5], levels, np.sqrt(levels[1:] * levels[:-1])[:, None], norm=norm, cmap=KEPT)
    bar.axvline(0.5, color="white", lw=1.5)
    for middle, name in ((0.25, "tension positive"), (0.75, "tension negative")):
        bar.text(
            middle, 0.03, name, transform=bar.transAxes, rotation=90.0, ha="center", va="bottom",
            fontsize="small",
        )  # fmt: skip


def _where_negative(lost: xr.DataArray) -> str:
    """Title: least heave at which tension becomes negative with one LMRP, locked and on tensioners."""
    least = {mode: float(lost.sel(mode=mode).min()) for mode in HUNG}  # NaN: no riser's
    locked, on_tensioners = (f"{_two_digits(least[mode])} m" for mode in ("hard", "soft"))
    lmrp = f"the {float(lost['lmrp_mass']):g} t LMRP"
    if np.isnan(least["hard"]) and np.isnan(least["soft"]):
        return f"With {lmrp} no riser's tension becomes negative"
    if np.isnan(least["soft"]):
        return f"With {lmrp}, only locked risers' tension becomes negative, from {locked} heave amplitude"
    if np.isnan(least["hard"]):
        return f"With {lmrp}, only tension on tensioners becomes negative, from {on_tensioners} amplitude"
    where = f"from {locked} if locked, {on_tensioners} on tensioners"
    return f"With the heaviest LMRP, tension becomes negative {where}"


def _two_digits(value: float) -> str:
    """A number with two significant digits; a final zero is kept."""
    return f"{value:#.2g}".removesuffix(".")


def _cells(ax: Axes, values: xr.DataArray, norm: Normalize, lost: xr.DataArray) -> None:
    """A coloured table, one cell per pair of coordinates; in other colours where tension is lost."""
    up, across = values.dims
    for drawn, colours in ((values.where(~lost), KEPT), (values.where(lost), LOST)):
        ax.pcolormesh(drawn.values, norm=norm, cmap=colours, edgecolors="white")
    for (i, j), value in np.ndenumerate(values.values):
        colour = "white" if float(norm(value)) > 0.6 else "black"
        ax.text(j + 0.5, i + 0.5, _two_digits(value), ha="center", va="center", size="small", color=colour)
    ax.set_xticks(np.arange(values.sizes[across]) + 0.5, [f"{x:g}" for x in values[across].values])
    ax.set_yticks(np.arange(values.sizes[up]) + 0.5, [f"{x:g}" for x in values[up].values])
    ax.grid(visible=False)
