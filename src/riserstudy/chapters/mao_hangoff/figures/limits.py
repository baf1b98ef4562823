"""Figures beyond Mao, Zeng, Liu: what limits a captain's speed, and a riser's tension in heave."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, GREY, headline, key_below, panels

PERIODS = (6.0, 8.0)  # s, of heave


def speed_limits(speed_limits: xr.Dataset) -> Figure:
    """Largest speed through water, and over ground, over length and LMRP mass for each current.

    Coloured by the limit that governs.
    """
    currents = speed_limits["current_speed"].values
    figure, axes = panels(1, len(currents), 3.8, sharey=True)
    names = [str(name) for name in speed_limits["limit"].values]
    for ax, current in zip(axes, currents, strict=True):
        at = speed_limits.sel(current_speed=current)
        lengths, masses = at["riser_length"].values, at["lmrp_mass"].values
        for i, mass in enumerate(masses):
            for j, length in enumerate(lengths):
                one = at.sel(lmrp_mass=mass, riser_length=length)
                which = int(one["governing_limit"])
                colour = COLOURS[which] if which >= 0 else GREY
                ax.barh(i, 1.0, left=j - 0.5, height=1.0, color=colour, alpha=0.35, ec="white")
                more = "" if which >= 0 else ">"
                through, ground = float(one["speed_through_water"]), float(one["speed_limit"])
                text = f"{more}{through:.1f}\n({more}{ground:.1f})"
                ax.text(j, i, text, ha="center", va="center", fontsize="small")
        ax.set_xticks(range(len(lengths)), [f"{x:g}" for x in lengths])
        ax.set_yticks(range(len(masses)), [f"{x:g}" for x in masses])
        ax.set_title(f"current against: {current:g} m/s", loc="right", fontsize="small")
        ax.set_xlim(-0.5, len(lengths) - 0.5)
        ax.set_ylim(-0.5, len(masses) - 0.5)
        ax.set_xlabel("riser length (m)")
        ax.grid(visible=False)
    axes[0].set_ylabel("LMRP mass (t)")
    governing = set(speed_limits["governing_limit"].values.astype(int).ravel().tolist())
    for which in sorted(governing, reverse=True):
        colour, name = (
            (COLOURS[which], f"{names[which]} governs") if which >= 0 else (GREY, "none reached")
        )
        axes[0].bar(0, 0, color=colour, alpha=0.35, label=name)
    axes[0].bar(0, 0, color="none", label="kn through water at the surface")
    axes[0].bar(0, 0, color="none", label="(kn over ground)")
    key_below(figure, axes[0], 3)
    slowest = speed_limits["speed_limit"].where(speed_limits["governing_limit"] >= 0.0)
    headline(
        figure,
        f"From {float(slowest.min()):.1f} to {float(slowest.max()):.1f} kn over ground a limit is reached "
        f"(assumed), {_first_of_all(speed_limits)}",
    )
    return figure


def _first_of_all(speed_limits: xr.Dataset) -> str:
    """Which limit governs, if it is one everywhere."""
    which = set(speed_limits["governing_limit"].values.astype(int).ravel().tolist()) - {-1}
    names = [str(speed_limits["limit"].values[k]) for k in sorted(which)]
    return (
        f"everywhere that of the {names[0]}" if len(names) == 1 else f"that of {', '.join(names)}"
    )


def hang_off(tension_limits: xr.Dataset) -> Figure:
    """Tension range over heave, soft beside hard; the heave that loses tension, hard, over the riser."""
    figure, axes = panels(2, 2, 3.6)
    of_paper = tension_limits.isel(riser_length=-1, lmrp_mass=-1)
    spread = of_paper["tension_range"].transpose("mode", "heave_amplitude", "heave_period") / 1e6
    norm = LogNorm(float(spread.min()), float(spread.max()))
    for ax, mode in zip(axes, ("soft", "hard"), strict=False):
        at = of_paper.sel(mode=mode)
        slack = at["smallest_tension"].transpose("heave_amplitude", "heave_period") < 0.0
        _cells(ax, spread.sel(mode=mode), norm, slack)
        riser = f"{float(of_paper['riser_length']):g} m, {float(of_paper['lmrp_mass']):g} t"
        ax.set_title(f"{mode}, {riser}: range of top tension (MN)", fontsize="small", loc="right")
        ax.set_xlabel("heave period (s)")
        ax.set_ylabel("heave amplitude (m)")
    lost = tension_limits["heave_that_loses_tension"].transpose(..., "lmrp_mass", "riser_length")
    most = float(tension_limits["heave_amplitude"].max())
    for ax, wanted in zip(axes[2:], PERIODS, strict=True):
        hard = lost.sel(mode="hard").sel(heave_period=wanted, method="nearest")
        _cells(ax, hard, Normalize(0.0, most))
        period = float(hard["heave_period"])
        ax.set_title(
            f"hard, {period:g} s, each riser: heave that loses tension (m)",
            fontsize="small",
            loc="right",
        )
        ax.set_xlabel("riser length (m)")
        ax.set_ylabel("LMRP mass (t)")
    said = f"orange: tension is lost; on tensioners {_lost_softly(lost, most)}"
    figure.supxlabel(said, fontsize="small")
    headline(
        figure, "Locked to the platform a riser soon loses tension in heave; on tensioners late"
    )
    return figure


def _lost_softly(lost: xr.DataArray, most: float) -> str:
    """The least heave that loses tension on tensioners, and of which riser."""
    soft = lost.sel(mode="soft")
    if bool(soft.isnull().all()):
        return f"no riser loses it up to {most:g} m"
    at = soft.where(soft == soft.min(), drop=True)
    length, mass, period = (float(at[n][0]) for n in ("riser_length", "lmrp_mass", "heave_period"))
    riser = f"{length:g} m with {mass:g} t at {period:g} s"
    return f"the first to lose it are {riser}, from {float(soft.min()):.1f} m on"


def _cells(
    ax: Axes, values: xr.DataArray, norm: Normalize, lost: xr.DataArray | None = None
) -> None:
    """A table in colours, a cell a pair of coordinates; a dash where there is no number."""
    up, across = values.dims
    kept = values if lost is None else values.where(~lost)
    for shown, colours in ((kept, "Blues"), (values.where(kept.isnull()), "Oranges")):
        ax.pcolormesh(shown.values, norm=norm, cmap=colours, edgecolors="white")
    for i, row in enumerate(values.values):
        for j, value in enumerate(row):
            colour = "white" if norm(value) > 0.6 else "black"
            text = "–" if np.isnan(value) else f"{value:.2g}"
            ax.text(j + 0.5, i + 0.5, text, ha="center", va="center", size="small", color=colour)
    ax.set_xticks(np.arange(values.sizes[across]) + 0.5, [f"{x:g}" for x in values[across].values])
    ax.set_yticks(np.arange(values.sizes[up]) + 0.5, [f"{x:g}" for x in values[up].values])
    ax.grid(visible=False)
