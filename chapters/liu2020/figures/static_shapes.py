"""Figures 11 and 12 of Liu et al. 2020: the riser in a current, on the tensioners and without them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from chapters.liu2020.below_ring import RING
from chapters.liu2020.figures.colours import ALL, CARRIED, NAMES, OF_TOP, ON_PLATFORM, ONE, VERTICAL
from chapters.liu2020.figures.motion_shared import DEPTH
from riserstudy.figures.direct import legible
from riserstudy.figures.insets import enlarge
from riserstudy.figures.style import headline, panel_title, panels, shades

SPEEDS = (0.2, 0.6, 1.0)  # m/s, at the surface
NEAR = 120.0  # m below the ring
#: dashed lines remain visible where they coincide with the wide line of the tensioners
LINES: dict[str, Any] = {
    "gas law": "-",
    "constant": (0, (4, 4)),
    VERTICAL: "--",
    CARRIED: (5, (2, 6)),
    ON_PLATFORM: "-",
}
#: names of the currents and drag coefficients for which the cylinders' horizontal force is 8765 N
CALIBRATIONS = {
    ALL: "calibrated: exponential 50 m, drag coefficient 0.7",
    ONE: "calibrated: exponential 200 m, drag coefficient 1.11",
}


def fig11(statics_calibrated: xr.Dataset, statics_tuned: xr.Dataset) -> Figure:
    """Displacement in currents, on the tensioners and in interpretations of a riser without them."""
    title = "1 m/s, tensioners and four interpretations of 232 t"
    figure = _at_rest(1.0 * statics_calibrated["x_static"], title, "lateral displacement (m)")
    low, high = _times(statics_tuned, "largest_displacement")
    headline(figure, f"A vertical force at the ring multiplies the displacement by {low:.1f} to {high:.1f}")
    _key(figure, "(a–d)")
    return figure


def fig12(statics_calibrated: xr.Dataset, statics_tuned: xr.Dataset) -> Figure:
    """Bending moment in currents, on the tensioners and in interpretations of a riser without them."""
    title = f"upper {NEAR:.0f} m, 1 m/s: the other three interpretations"
    figure = _at_rest(
        1e-3 * statics_calibrated["bending_moment_static"], title, "bending moment (kN m)",
        right=[model for model in NAMES if model != VERTICAL],
    )  # fmt: skip
    for left, right in zip(figure.axes[::2], figure.axes[1::2], strict=True):
        right.set_ylim(NEAR, -0.05 * NEAR)
        right.set_ylabel(DEPTH)
        low, high = right.get_xlim()
        inset = enlarge(left, (0.15, 0.17, 0.55, 0.4), (low, high), (-0.05 * NEAR, NEAR), 2.0)
        inset.set_xlabel("moment (kN m)", fontsize="x-small")
        inset.set_ylabel("depth (m)", fontsize="x-small")
        _compare_largest(left)
    low, high = _times(statics_tuned, "largest_bending_moment_near_ring")
    headline(figure, f"A vertical force at the ring multiplies the largest moment by {low:.0f} to {high:.0f}")
    _key(figure, "(a, c)")
    return figure


def _compare_largest(ax: Axes) -> None:
    """Note the largest moments near the ring at the highest speed: by a vertical force, and on tensioners."""
    of_models = {}
    for model in (VERTICAL, "gas law"):
        (line,) = (
            line for line in ax.get_lines() if line.get_label() == f"{SPEEDS[-1]:g} m/s, {NAMES[model]}"
        )
        moments, depths = (np.asarray(values, float) for values in line.get_data())
        near = np.flatnonzero(depths <= NEAR)
        k = near[np.argmax(abs(moments[near]))]
        of_models[model] = moments[k], depths[k]
    (vertical, depth), (tensioners, _) = of_models.values()
    vertically, tensioned = (f"{float(f'{m:.3g}'):g} kN m".replace("-", "−") for m in (vertical, tensioners))
    text = (
        f"{SPEEDS[-1]:g} m/s: {vertically}, {vertical / tensioners:.0f} times\nthe {tensioned} on tensioners"
    )
    ax.annotate(
        text, (vertical, depth), xytext=(0.06, 0.8), textcoords="axes fraction", fontsize="small",
        color=legible(OF_TOP[VERTICAL]), va="top",
        arrowprops={
            "arrowstyle": "-|>", "lw": 0.8, "color": legible(OF_TOP[VERTICAL]), "shrinkB": 1.0,
            "relpos": (0.0, 1.0),
        },
    )  # fmt: skip


def _times(tuned: xr.Dataset, name: str) -> tuple[float, float]:
    """Least and largest ratio, over currents and speeds, of a vertical force's result to the tensioners'."""
    at = tuned[name]
    ratio = at.sel(tensioner_model=VERTICAL) / at.sel(tensioner_model="gas law")
    return float(ratio.min()), float(ratio.max())


def _at_rest(values: xr.DataArray, title: str, across: str, right: Sequence[str] = tuple(NAMES)) -> Figure:
    """One row per calibrated current: the paper's comparison; interpretations (``right``) at 1 m/s."""
    figure, axes = panels(2, 2, 4.2)
    for row, calibration in zip((axes[:2], axes[2:]), CALIBRATIONS, strict=True):
        here = values.sel(calibration=calibration)
        for model in ("gas law", VERTICAL):
            # 1 m/s has the colour of the right panel, which shows only this speed
            colours = shades(OF_TOP[model], 2 * len(SPEEDS) - 1)[: len(SPEEDS)]
            for speed, colour in zip(SPEEDS, colours, strict=True):
                curve = here.sel(tensioner_model=model, surface_speed=speed)
                width = 2.8 if model == "gas law" else 1.3
                label = f"{speed:g} m/s, {NAMES[model]}"
                _by_depth(row[0], curve, LINES[model], colour, label, width)
        for model in right:
            curve = here.sel(tensioner_model=model, surface_speed=1.0)
            width = 3.5 if model == "gas law" else 1.3
            _by_depth(row[1], curve, LINES[model], OF_TOP[model], NAMES[model], width)
        panel_title(row[0], CALIBRATIONS[calibration])
        panel_title(row[1], title)
        row[0].set_ylabel(DEPTH)
    for ax in axes:  # the axes of the rows differ
        ax.set_xlabel(across)
    return figure


def _by_depth(ax: Axes, curve: xr.DataArray, line: Any, colour: str, label: str, width: float) -> None:
    riser = curve.where(curve["s_node"] < RING + 1e-6).dropna("s_node")
    style: dict[str, Any] = {"linestyle": line, "color": colour, "linewidth": width}
    ax.plot(riser, RING - riser["s_node"], label=label, **style)
    ax.set_ylim(560.0, -20.0)


def _key(figure: Figure, panels_of_force: str) -> None:
    """Key below the panels, a column for each model with three speeds and one for models at 1 m/s.

    ``panels_of_force``: letters of the panels that show the vertical force.
    """
    left, right = (dict(zip(*ax.get_legend_handles_labels()[::-1], strict=True)) for ax in figure.axes[:2])
    columns: dict[str, dict[str, Any]] = {}
    titles = {"gas law": "tensioners (a–d)", VERTICAL: f"232 t as a vertical force {panels_of_force}"}
    for model, title in titles.items():
        columns[title] = {f"{speed:g} m/s": left[f"{speed:g} m/s, {NAMES[model]}"] for speed in SPEEDS}
    others = [NAMES[model] for model in NAMES if model not in titles]
    columns["232 t in other ways, 1 m/s (b, d)"] = {name: right[name] for name in others}
    blank = Line2D([], [], color="none")
    handles = [one for of in columns.values() for one in (blank, *of.values())]
    names = [name for title, of in columns.items() for name in (title, *of)]
    key = figure.legend(handles, names, loc="outside lower center", ncols=len(columns), fontsize="small")
    for k in range(0, len(names), 1 + len(SPEEDS)):
        key.get_texts()[k].set_fontweight("bold")
