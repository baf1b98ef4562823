"""Figures of Liu et al. 2020: the printed ones by number, others by what they show."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.chapters.liu2020.figures.colours import (
    ALL,
    OF_CALIBRATION,
    OF_PROFILE,
    OF_TOP,
    ONE,
)
from riserstudy.figures.direct import label_line
from riserstudy.figures.style import (
    GREY,
    PRINTED,
    headline,
    key_below,
    legend_below,
    panel_title,
    panels,
    shades,
)

SPEEDS = (0.2, 0.6, 1.0)  # m/s, at the surface
VERTICAL, ON_PLATFORM = "vertical force at the ring", "riser's top on the platform"
#: the individual riser as it may be meant; config/studies/liu2020.yaml, readings
CARRIED = "232 t carried to the upper flex joint"
MODELS = {
    "gas law": "tensioners",
    "constant": "constant pull along cylinders",
    VERTICAL: VERTICAL,
    CARRIED: "232 t carried to the flex joint",
    ON_PLATFORM: ON_PLATFORM,
}
#: dashes that show each of those that coincide with tensioners, which are drawn wide
LINES: dict[str, Any] = {
    "gas law": "-",
    "constant": (0, (4, 4)),
    VERTICAL: "--",
    CARRIED: (5, (2, 6)),
    ON_PLATFORM: "-",
}
#: currents and drag so that the cylinders push back with 8765 N, and what they are
CALIBRATIONS = {
    ALL: "calibrated: 50 m exponential, drag coefficient 0.7",
    ONE: "calibrated: 200 m exponential, drag coefficient 1.112",
}
#: N that the text gives at these speeds; config/published/liu2020.yaml, N2a to N2c
NEAR = 120.0  # m below the ring
DEPTH, TIME = "depth below the riser's top (m)", "time (s)"


# current and check riser


def fig09(current_profiles: xr.Dataset) -> Figure:
    """Current profiles over depth: printed surface speeds, assumed and calibrated shapes."""
    figure, axes = panels(1, 2, 3.8, sharey=True)
    share = current_profiles["current_share"]
    for speed in SPEEDS:
        curve = speed * share.sel(current_profile=f"calibrated: {ALL}")
        (drawn,) = axes[0].plot(
            curve, curve["depth"], color=OF_CALIBRATION[ALL], label=f"{speed:g} m/s"
        )
        label_line(axes[0], drawn, 0.0, (0.0, 4.0))
    for shape, colour in OF_PROFILE.items():
        curve = share.sel(current_profile=shape)
        axes[1].plot(curve, curve["depth"], color=colour, label=f"{shape} (assumed)")
    for calibration, colour in OF_CALIBRATION.items():
        curve = share.sel(current_profile=f"calibrated: {calibration}")
        axes[1].plot(curve, curve["depth"], "o", color=colour, mfc="none", ms=5, markevery=0.09,
                     label=f"calibrated: {calibration}")  # fmt: skip
    titles = ("fitted to 8765 N, by printed surface speed", "1 m/s at the surface")
    for ax, title in zip(axes, titles, strict=True):
        ax.set_xlabel("current speed (m/s)")
        panel_title(ax, title)
    axes[0].margins(x=0.08, y=0.12)
    axes[0].set_ylabel(DEPTH)
    axes[0].invert_yaxis()
    headline(
        figure,
        "8765 N by all cylinders requires a current near the surface",
    )
    key_below(figure, axes[1], 3)
    return figure


def fig10(codes: xr.Dataset) -> Figure:
    """Displacement of the check riser by three methods."""
    figure, axes = panels(1, 2, 4.2, sharey=True)
    lines = {"lumped masses": "-", "Hermite elements": "--", "collocation": "o"}
    titles = {"water": "filled with water", "air": "filled with air"}
    for ax, contents in zip(axes, titles, strict=True):
        moved = codes["displacement"].sel(contents=contents)
        ours_only = abs(moved.sel(code="lumped masses"))
        least = float(ours_only.max("depth").min())
        for shape in map(str, codes["current_profile"].values):
            for (code, line), width in zip(lines.items(), (3.0, 1.6, 1.6), strict=True):
                curve = moved.sel(code=code, current_profile=shape)
                ours = code == "lumped masses"
                (drawn,) = ax.plot(
                    curve,
                    curve["depth"],
                    line,
                    color=OF_PROFILE[shape] if ours else "black",
                    alpha=0.6 if ours else 1.0,
                    linewidth=width,
                    markersize=4,
                    markevery=0.12,
                    markerfacecolor="none",
                    label=shape if ours else None,
                )
                if ours:
                    side = -5.0 if float(abs(curve).max()) == least else 5.0
                    label_line(ax, drawn, _middle(curve), (side, 0.0), name=_on_two_rows(shape))
        panel_title(ax, titles[contents])
        ax.margins(x=0.16)
        ax.set_xlabel("lateral displacement (m)")
    key = axes[0].plot(
        [], [], color=GREY, alpha=0.6, linewidth=3.0, label="lumped masses (riserstudy)"
    )
    for code in ("Hermite elements", "collocation"):
        key += axes[0].plot(
            [], [], lines[code], color="black", linewidth=1.6, markersize=4, markerfacecolor="none",
            label=code,
        )  # fmt: skip
    axes[0].set_ylabel(DEPTH)
    axes[0].invert_yaxis()
    apart = 100.0 * float(codes["codes_apart"].max())
    headline(
        figure,
        f"Three methods agree to {apart:.1f} % of the displacement",
    )
    legend_below(figure, key, [str(line.get_label()) for line in key], 3)
    return figure


def _middle(curve: xr.DataArray) -> float:
    """Share of the points of a curve before its largest value."""
    return float(np.argmax(np.abs(curve.values))) / max(1, curve.size - 1)


def _on_two_rows(shape: object) -> str:
    """Name of a current's profile, narrow enough to stand between two curves."""
    return str(shape).replace("exponential", "exp.").replace(" ", "\n", 1)


# statics of the system


def fig11(
    statics_calibrated: xr.Dataset,
    statics_tuned: xr.Dataset,
    slow: float,
    middle: float,
    fast: float,
) -> Figure:
    """Displacement in currents, on the tensioners and on a constant tension.

    ``slow``, ``middle``, ``fast``: printed forces of the tensioners by surface speed (N).
    """
    forces, label = (slow, middle, fast), "lateral displacement (m)"
    figure = _at_rest(statics_calibrated, statics_tuned, "x_static", 1.0, label, forces)
    low, high = _times(statics_tuned, "largest_displacement")
    headline(
        figure,
        f"A vertical force increases the displacement by factors of {low:.1f} to {high:.1f}",
    )
    return figure


def fig12(
    statics_calibrated: xr.Dataset,
    statics_tuned: xr.Dataset,
    slow: float,
    middle: float,
    fast: float,
) -> Figure:
    """Bending moment in currents, on the tensioners and on a constant tension; forces as in fig11."""
    forces, label = (slow, middle, fast), "bending moment (kN m)"
    figure = _at_rest(
        statics_calibrated, statics_tuned, "bending_moment_static", 1e-3, label, forces
    )
    low, high = _times(statics_tuned, "largest_bending_moment_near_ring")
    figure.axes[1].legend(fontsize="x-small", loc=(0.03, 0.22))  # where no curve is
    for left, right in zip(figure.axes[::2], figure.axes[1::2], strict=True):
        _near_the_ring(right)
        # the whole riser on the same scale, so that its lower end is seen as well
        left.set_xlim(right.get_xlim())
        left.texts[0].set(position=(0.03, 0.3), ha="left")
    headline(
        figure,
        f"A vertical force multiplies the largest moment by {low:.0f} to {high:.0f}",
    )
    return figure


def _near_the_ring(ax: Axes) -> None:
    """A panel cut to what bends near the ring, all but the vertical force, which is told."""
    drawn = [line.get_xdata() for line in ax.get_lines() if line.get_label() != VERTICAL]
    low = min(float(np.min(values)) for values in drawn)
    high = max(float(np.max(values)) for values in drawn)
    room = 0.08 * (high - low)
    ax.set_xlim(low - room, high + room)
    ax.set_ylim(NEAR, 0.0)
    curve = next(line for line in ax.get_lines() if line.get_label() == VERTICAL)
    moments, depths = (np.asarray(values, float) for values in curve.get_data())
    off = f"{moments[np.argmin(depths)]:.0f}".replace("-", "−")
    ax.annotate(
        f"at the ring under\nthe vertical force:\n{off} kN m",
        (0.04, 0.04),
        xycoords="axes fraction",
        fontsize="x-small",
        bbox={"facecolor": "white", "edgecolor": GREY, "linewidth": 0.5},
    )


def _times(tuned: xr.Dataset, name: str) -> tuple[float, float]:
    """A quantity under a vertical force over that on the tensioners at 1 m/s: least and most of currents."""
    at = tuned[name].sel(surface_speed=1.0)
    ratio = at.sel(tensioner_model=VERTICAL) / at.sel(tensioner_model="gas law")
    return float(ratio.min()), float(ratio.max())


def _at_rest(
    runs: xr.Dataset,
    tuned: xr.Dataset,
    name: str,
    scale: float,
    label: str,
    forces: tuple[float, ...],
) -> Figure:
    """A row for each calibrated current: the paper's comparison, and every reading of it at 1 m/s."""
    figure, axes = panels(2, 2, 4.2)
    for row, calibration in zip((axes[:2], axes[2:]), CALIBRATIONS, strict=True):
        here = scale * runs[name].sel(calibration=calibration)
        for model in ("gas law", VERTICAL):
            line, top_load = LINES[model], MODELS[model]
            # the fastest as in the other panel, which has that speed alone
            colours = shades(OF_TOP[model], 2 * len(SPEEDS) - 1)[: len(SPEEDS)]
            for speed, colour in zip(SPEEDS, colours, strict=True):
                curve = here.sel(tensioner_model=model, surface_speed=speed)
                width = 2.8 if model == "gas law" else 1.3
                _by_depth(row[0], curve, line, colour, f"{speed:g} m/s, {top_load}", width)
        for model, top_load in MODELS.items():
            curve = here.sel(tensioner_model=model, surface_speed=1.0)
            width = 3.5 if model == "gas law" else 1.3
            _by_depth(row[1], curve, LINES[model], OF_TOP[model], top_load, width)
        cylinders = "one cylinder" if "one" in calibration else "all cylinders"
        force = tuned["horizontal_force"].sel(calibration=calibration, counted=cylinders)
        lines = [
            f"{speed:g} m/s: {float(force.sel(surface_speed=speed)):.0f} N ({printed:.0f} N)"
            for speed, printed in zip(SPEEDS, forces, strict=True)
        ]
        row[0].annotate(
            "pushed back by " + cylinders + " (printed):\n" + "\n".join(lines),
            (0.97, 0.04),
            xycoords="axes fraction",
            ha="right",
            va="bottom",
            fontsize="x-small",
            bbox={"facecolor": "white", "edgecolor": GREY, "linewidth": 0.5},
        )
        panel_title(row[0], CALIBRATIONS[calibration])
        panel_title(row[1], "1 m/s, every interpretation of the riser alone")
        row[0].set_ylabel(DEPTH)
    for ax in axes[2:]:
        ax.set_xlabel(label)
    axes[1].legend(fontsize="x-small", loc="lower right")
    key_below(figure, axes[0], 2)
    return figure


def _by_depth(
    ax: Axes, curve: xr.DataArray, line: Any, colour: str, label: str, width: float = 1.3
) -> None:
    riser = curve.where(curve["s_node"] < 533.0 + 1e-6).dropna("s_node")
    style: dict[str, Any] = {"linestyle": line, "color": colour, "linewidth": width}
    ax.plot(riser, 533.0 - riser["s_node"], label=label, **style)
    ax.set_ylim(560.0, -20.0)


def dat_force(
    dat_force: xr.Dataset,
    dat_force_calibrated: xr.Dataset,
    slow: float,
    middle: float,
    fast: float,
) -> Figure:
    """Horizontal force of the tensioners over surface speed, as multiples of the printed (N)."""
    printed = xr.DataArray(
        [slow, middle, fast], dims="surface_speed", coords={"surface_speed": list(SPEEDS)}
    )
    figure, (wide, close) = panels(1, 2, 3.8)
    _profiles(wide, dat_force["horizontal_force"] / printed)
    calibrated = dat_force_calibrated["horizontal_force"] / printed
    for (calibration, colour), aside in zip(OF_CALIBRATION.items(), (-0.012, 0.012), strict=True):
        over = calibrated.sel(calibration=calibration)
        close.plot(
            over["surface_speed"] + aside, 100.0 * (over - 1.0), "o", color=colour, ms=7,
            mfc=colour if calibration == ALL else "none", label=f"calibrated: {calibration}",
        )  # fmt: skip
    close.axhline(0.0, label="printed", **PRINTED)
    forces = (slow, middle, fast)
    names = [f"{speed:g}\n({force:g} N)" for speed, force in zip(SPEEDS, forces, strict=True)]
    close.set_xticks(SPEEDS, names)
    close.set_xlabel("surface speed (m/s), printed force (N)")
    close.set_ylabel("force / printed force − 1 (%)")
    close.margins(0.15)
    panel_title(close, "by surface speed; current calibrated at 1 m/s")
    close.legend(fontsize="small", loc="center right")
    away = 100.0 * float(calibrated.sel(surface_speed=SPEEDS[0], calibration=ALL) - 1.0)
    missed = "exceeded" if away > 0.0 else "missed"
    headline(
        figure,
        f"Fitted to the largest printed force, the smallest is {missed} by {abs(away):.0f} %",
    )
    return figure


def _profiles(ax: Axes, over: xr.DataArray) -> None:
    """A row a profile that was assumed: its force over the printed, over all speeds."""
    profiles = [str(shape) for shape in over["current_profile"].values]
    for counted, away in (("all cylinders", -0.12), ("one cylinder", 0.12)):
        of = over.sel(counted=counted)
        low, high = of.min("surface_speed"), of.max("surface_speed")
        for row, shape in enumerate(profiles):
            ends = [float(end.sel(current_profile=shape)) for end in (low, high)]
            colour = OF_PROFILE[shape]
            filled = colour if counted == "all cylinders" else "white"
            ax.plot(ends, [row + away] * 2, "o-", color=colour, mfc=filled, lw=2.0, ms=6)
        ax.plot([], [], "o", color=GREY, mfc=filled if filled == "white" else GREY, ms=6,
                label=f"force of {counted}")  # fmt: skip
    ax.axvline(1.0, label="printed", **PRINTED)
    ax.set_xscale("log")
    ax.set_xticks([0.3, 1.0, 3.0, 10.0])
    ax.xaxis.set_major_formatter("{x:g}")
    ax.set_yticks(range(len(profiles)), profiles)
    ax.set_ylim(len(profiles) + 0.4, -0.5)  # with room for the key below the rows
    ax.set_xlabel("force / printed force, at three speeds")
    panel_title(ax, "by current profile, assumed")
    ax.legend(fontsize="small", loc="lower right")
