"""Figures 11 and 12 of Liu et al. 2020: the riser in a current, on the tensioners and without them."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.chapters.liu2020.figures.colours import (
    ALL,
    CARRIED,
    NAMES,
    OF_TOP,
    ON_PLATFORM,
    ONE,
    VERTICAL,
)
from riserstudy.chapters.liu2020.figures.motion_shared import DEPTH, RING
from riserstudy.figures.direct import legible
from riserstudy.figures.style import GREY, headline, panel_title, panels, shades

Place = Literal["outside lower left", "outside lower right"]
SPEEDS = (0.2, 0.6, 1.0)  # m/s, at the surface
NEAR = 120.0  # m below the ring
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
    ALL: "calibrated: exponential 50 m, drag coefficient 0.7",
    ONE: "calibrated: exponential 200 m, drag coefficient 1.112",
}


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
    title = "1 m/s, tensioners and four interpretations of 232 t"
    figure = _at_rest(1.0 * statics_calibrated["x_static"], title, "lateral displacement (m)")
    _forces(figure, statics_tuned, (slow, middle, fast), (0.97, 0.04), "right")
    low, high = _times(statics_tuned, "largest_displacement")
    headline(
        figure,
        f"Compared with tensioners, a vertical force multiplies displacement by {low:.1f} to {high:.1f}",
    )
    _keys(figure)
    return figure


def fig12(
    statics_calibrated: xr.Dataset,
    statics_tuned: xr.Dataset,
    slow: float,
    middle: float,
    fast: float,
) -> Figure:
    """Bending moment in currents, on the tensioners and on a constant tension; forces as in fig11."""
    title = f"upper {NEAR:.0f} m: 1 m/s, four interpretations of 232 t"
    figure = _at_rest(
        1e-3 * statics_calibrated["bending_moment_static"], title, "bending moment (kN m)"
    )
    _forces(figure, statics_tuned, (slow, middle, fast), (0.03, 0.3), "left")  # where no curve is
    for left, right in zip(figure.axes[::2], figure.axes[1::2], strict=True):
        _scale_of_tensioners(left, right)
        right.set_ylim(NEAR, -0.12 * NEAR)  # room for the tensioners' largest
        right.set_ylabel(DEPTH)
        _name_largest(right)
        _label_values_beyond(left, 0.1, (230.0, 170.0, 110.0))
        _label_values_beyond(right, 0.03, (0.9 * NEAR,))
    low, high = _times(statics_tuned, "largest_bending_moment_near_ring")
    headline(
        figure,
        f"A vertical force multiplies the tensioners' largest moment by {low:.0f} to {high:.0f}",
    )
    _keys(figure)
    return figure


def _scale_of_tensioners(left: Axes, right: Axes) -> None:
    """Both panels show all moments but the negative ones of the vertical force, which are far larger."""
    lines = right.get_lines()
    low = min(float(np.min(of.get_xdata())) for of in lines if of.get_label() != NAMES[VERTICAL])
    high = max(float(np.max(of.get_xdata())) for of in lines)
    room = 0.08 * (high - low)
    for ax in (left, right):
        ax.set_xlim(low - room, high + room)


def _name_largest(ax: Axes) -> None:
    """The largest moment on the tensioners (kN m), above the curve, beside which that at the ring is seen."""
    (curve,) = (line for line in ax.get_lines() if line.get_label() == NAMES["gas law"])
    moments, depths = (np.asarray(values, float) for values in curve.get_data())
    k = int(np.argmax(abs(moments)))
    largest = f"{moments[k]:.0f}".replace("-", "−")
    ax.annotate(
        f"{NAMES['gas law']}: largest {largest} kN m", (moments[k], depths[k]),
        xytext=(0.03, -0.06 * NEAR), textcoords=("axes fraction", "data"), fontsize="x-small",
        color=legible(OF_TOP["gas law"]), va="center",
        arrowprops={
            "arrowstyle": "-|>", "lw": 0.8, "color": legible(OF_TOP["gas law"]), "shrinkB": 1.0,
            "relpos": (0.07, 0.0),
        },
    )  # fmt: skip


def _label_values_beyond(ax: Axes, left: float, depths: tuple[float, ...]) -> None:
    """Where curves leave a panel to the left: their moments at the ring.

    They are written from a share ``left`` of the panel on, at ``depths`` (m), the fastest current first.
    """
    edge, _ = ax.get_xlim()
    away = [line for line in ax.get_lines() if float(np.min(line.get_xdata())) < edge]
    for line, depth in zip(reversed(away), depths, strict=False):
        moments, below = (np.asarray(values, float) for values in line.get_data())
        downwards = np.argsort(below)
        moments, below = moments[downwards], below[downwards]
        k = int(np.argmax(moments > edge))  # the first that is seen
        leaves = float(np.interp(edge, moments[k - 1 : k + 1], below[k - 1 : k + 1]))
        speed = str(line.get_label()).rpartition(", ")[0]
        at_ring = f"{moments[0]:.0f}".replace("-", "−")
        ax.annotate(
            f"{speed}{': ' * bool(speed)}{at_ring} kN m at the ring", (edge, leaves),
            xytext=(left, depth), textcoords=("axes fraction", "data"), fontsize="x-small",
            color=legible(line.get_color()), va="center",
            arrowprops={
                "arrowstyle": "-|>", "lw": 0.8, "color": legible(line.get_color()), "shrinkB": 0.0,
                "relpos": (0.0, 0.5),
            },
        )  # fmt: skip


def _times(tuned: xr.Dataset, name: str) -> tuple[float, float]:
    """A quantity under a vertical force over that on the tensioners at 1 m/s: least and most of currents."""
    at = tuned[name].sel(surface_speed=1.0)
    ratio = at.sel(tensioner_model=VERTICAL) / at.sel(tensioner_model="gas law")
    return float(ratio.min()), float(ratio.max())


def _at_rest(values: xr.DataArray, title: str, across: str) -> Figure:
    """A row for each calibrated current: the paper's comparison, and every interpretation at 1 m/s."""
    figure, axes = panels(2, 2, 4.2)
    for row, calibration in zip((axes[:2], axes[2:]), CALIBRATIONS, strict=True):
        here = values.sel(calibration=calibration)
        for model in ("gas law", VERTICAL):
            # the fastest as in the other panel, which has that speed alone
            colours = shades(OF_TOP[model], 2 * len(SPEEDS) - 1)[: len(SPEEDS)]
            for speed, colour in zip(SPEEDS, colours, strict=True):
                curve = here.sel(tensioner_model=model, surface_speed=speed)
                width = 2.8 if model == "gas law" else 1.3
                label = f"{speed:g} m/s, {NAMES[model]}"
                _by_depth(row[0], curve, LINES[model], colour, label, width)
        for model, name in NAMES.items():
            curve = here.sel(tensioner_model=model, surface_speed=1.0)
            width = 3.5 if model == "gas law" else 1.3
            _by_depth(row[1], curve, LINES[model], OF_TOP[model], name, width)
        panel_title(row[0], CALIBRATIONS[calibration])
        panel_title(row[1], title)
        row[0].set_ylabel(DEPTH)
    for ax in axes[2:]:
        ax.set_xlabel(across)
    return figure


def _by_depth(
    ax: Axes, curve: xr.DataArray, line: Any, colour: str, label: str, width: float
) -> None:
    riser = curve.where(curve["s_node"] < RING + 1e-6).dropna("s_node")
    style: dict[str, Any] = {"linestyle": line, "color": colour, "linewidth": width}
    ax.plot(riser, RING - riser["s_node"], label=label, **style)
    ax.set_ylim(560.0, -20.0)


def _forces(
    figure: Figure,
    tuned: xr.Dataset,
    printed: tuple[float, ...],
    place: tuple[float, float],
    side: Literal["left", "right"],
) -> None:
    """By what force (N) the cylinders push back, and the printed one, in a box of each left panel."""
    for ax, calibration in zip(figure.axes[::2], CALIBRATIONS, strict=True):
        cylinders = "one cylinder" if calibration == ONE else "all cylinders"
        force = tuned["horizontal_force"].sel(calibration=calibration, counted=cylinders)
        lines = [
            f"{speed:g} m/s: {float(force.sel(surface_speed=speed)):.0f} N ({of:.0f} N)"
            for speed, of in zip(SPEEDS, printed, strict=True)
        ]
        ax.annotate(
            "\n".join([f"horizontal force of {cylinders} (printed):", *lines]), place,
            xycoords="axes fraction", ha=side, va="bottom", fontsize="x-small",
            bbox={"facecolor": "white", "edgecolor": GREY, "linewidth": 0.5},
        )  # fmt: skip


def _keys(figure: Figure) -> None:
    """Keys of the left and of the right panels, below them."""
    places: tuple[Place, Place] = ("outside lower left", "outside lower right")
    titles = ("(a), (c):", "(b), (d):")
    for ax, place, title, columns in zip(figure.axes[:2], places, titles, (2, 1), strict=True):
        lines, names = ax.get_legend_handles_labels()
        key = figure.legend(
            lines, names, loc=place, ncols=columns, fontsize="small", title=title,
            title_fontsize="small",
        )  # fmt: skip
        key.set_alignment("left")
