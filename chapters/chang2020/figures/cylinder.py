"""Pressure and force of a cylinder over the displacement of its piston."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.interpolate import CubicSpline

from chapters.chang2020.figures.shared import GAS_LAW, MODELS, NAMES, OF_MODEL
from riserstudy.figures.direct import label_line
from riserstudy.figures.style import headline, panels

RANGE = (-8.0, 8.0)  # m, range of the line in Fig 9
PISTON = "piston displacement $X = x - a$ (m)"


def fig05(quasi_static: xr.Dataset) -> Figure:
    """Tensioner force over piston displacement."""
    figure, (ax,) = panels()
    law = _law(quasi_static, "gas law")
    law = law.interp(X=np.linspace(*RANGE, 201), method="cubic")
    ax.plot(law["X"], law / 1e6, color=GAS_LAW)
    ax.set_xlabel(PISTON)
    ax.set_ylabel("force of four cylinders (MN)")
    _per_cylinder(ax, "force of one cylinder (MN)")
    steps = law.diff("X")
    convex = bool((steps < 0.0).all() and (steps.diff("X") > 0.0).all())
    headline(figure, f"The tensioner's force decreases{' along a convex curve' if convex else ''}")
    return figure


def fig06(quasi_static: xr.Dataset) -> Figure:
    """Secant and tangent stiffness over piston displacement."""
    figure, (ax,) = panels()
    law = _law(quasi_static, "gas law")
    curve = CubicSpline(law["X"].values, law.values)
    at = np.linspace(*RANGE, 401)
    at = at[np.abs(at) > 1e-6]
    slope = np.abs(curve(at, 1)) / 1e6
    (tangent,) = ax.plot(at, slope, ":", color=GAS_LAW, lw=1.8, label=r"tangent $|dF/dX|$")
    secant = np.abs((curve(at) - curve(0.0)) / at)
    (chord,) = ax.plot(at, secant / 1e6, color=GAS_LAW, label="secant $|F(X) - F(0)| / |X|$ (Eq. 5)")
    ax.set_xlabel(PISTON)
    ax.set_ylabel("stiffness of four cylinders (MN/m)")
    label_line(ax, tangent, 0.15, (8.0, 4.0))
    label_line(ax, chord, 0.62, (4.0, 8.0))
    _per_cylinder(ax, "stiffness of one cylinder,\nas in Eq. 5 (MN/m)")
    exceeds = "exceeds" if bool((slope > secant / 1e6)[at < 0.0].all()) else "does not exceed"
    headline(figure, f"The tangent stiffness {exceeds} the secant stiffness of Eq. 5 in compression")
    return figure


def fig09(quasi_static: xr.Dataset) -> Figure:
    """Tensioner force by the gas law, and its least-squares line."""
    figure, (ax,) = panels()
    at = np.linspace(*RANGE, 161)
    laws = {model: _law(quasi_static, model).interp(X=at, method="cubic") for model in MODELS}
    for model, line in MODELS.items():
        (drawn,) = ax.plot(at, laws[model] / 1e6, line, color=OF_MODEL[model], label=NAMES[model])
        above = model == "linear"
        label_line(ax, drawn, 0.45, (6.0, 5.0) if above else (-6.0, -5.0))
    ax.set_xlabel(PISTON)
    ax.set_ylabel("force of four cylinders (MN)")
    _per_cylinder(ax, "force of one cylinder (MN)")
    apart = (laws["gas law"] - laws["linear"]).values
    least = min(float(apart[0]), float(apart[-1]))
    where = "most from the gas law at its ends" if least > -apart.min() else "from the gas law"
    headline(figure, f"The least-squares line deviates {where}")
    return figure


def _law(quasi_static: xr.Dataset, model: str) -> xr.DataArray:
    """Force of all cylinders (N) over X (m), from static equilibria at many heights of the platform."""
    rest = quasi_static.sel(tensioner_model=model)
    force = rest["tensioner_force_static"].sum("cylinder")
    displacement = -rest["tensioner_stroke_static"].isel(cylinder=0)
    order = np.argsort(displacement.values)
    return xr.DataArray(force.values[order], dims="X", coords={"X": displacement.values[order]}, name="force")


def _per_cylinder(ax: Axes, label: str) -> None:
    def one(force: Any) -> Any:
        return force / 4

    def four(force: Any) -> Any:
        return 4 * force

    right = ax.secondary_yaxis("right", functions=(one, four))
    right.set_ylabel(label)
