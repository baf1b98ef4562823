"""Chang et al. 2020: what its numbers, claims and errata are checked against.

x is the rise of the ring above the unstretched riser, a that of the platform, X = x - a the piston's.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from riserstudy.grading.grade import Found

FloatArray = NDArray[np.float64]


# Fig 8: how much the tensioner takes off


def reduction(reductions: xr.Dataset, quantity: str) -> Found:
    """Reduction of the oscillation of one quantity, in every reading."""
    return Found(reductions["reduction"].sel(quantity=quantity, drop=True))


def both_reductions(reductions: xr.Dataset, tension: float, heave: float, rounding: float) -> Found:
    """Whether tension and heave are reduced as printed in one reading; value: their difference."""
    table = reductions["reduction"]
    found = {name: table.sel(quantity=name, drop=True) for name in ("tension", "heave")}
    near = [
        abs(found[name] - wanted) <= 0.5 * rounding
        for name, wanted in (("tension", tension), ("heave", heave))
    ]
    return Found((found["heave"] - found["tension"]).round(9), near[0] & near[1])


# Figs 5, 6, 9: the tensioner's law


def falls_convex(law: xr.Dataset) -> Found:
    """Force falls and its slope rises everywhere; value: steepest over flattest slope."""

    def slopes(x: FloatArray, f: FloatArray) -> tuple[float, bool]:
        slope = np.diff(f) / np.diff(x)
        steepness = slope.min() / slope.max()
        return float(steepness), bool((slope < 0).all() and (np.diff(slope) > 0).all())

    return _of_curves(slopes, law, "gas law")


def secant_falls(law: xr.Dataset) -> Found:
    """Secant stiffness of Eq. 5 falls with X; value: that at X = -8 m over that at 8 m."""

    def secants(x: FloatArray, f: FloatArray) -> tuple[float, bool]:
        curve = CubicSpline(x, f)
        at = np.append(np.linspace(-8, -0.1, 80), np.linspace(0.1, 8, 80))
        secant = np.abs((curve(at) - curve(0.0)) / at)
        return float(secant[0] / secant[-1]), bool((np.diff(secant) < 0).all())

    return _of_curves(secants, law, "gas law")


def line_differs(law: xr.Dataset, at_least: float) -> Found:
    """The least-squares line leaves the gas law; value: largest gap over the force at X = 0."""
    at = np.linspace(-8, 8, 161)

    def curve(x: FloatArray, f: FloatArray) -> FloatArray:
        return np.append(CubicSpline(x, f)(at), CubicSpline(x, f)(0.0))

    gas, line = (
        xr.apply_ufunc(
            curve,
            *_curves(law, model),
            input_core_dims=[["heave_position"], ["heave_position"]],
            output_core_dims=[["X"]],
            vectorize=True,
        )
        for model in ("gas law", "linear")
    )
    gap = abs(line - gas).isel(X=slice(None, -1)).max("X") / gas.isel(X=-1)
    return Found(gap, gap >= at_least)


def _of_curves(
    judge: Callable[[FloatArray, FloatArray], tuple[float, bool]], law: xr.Dataset, model: str
) -> Found:
    value, true = xr.apply_ufunc(
        judge,
        *_curves(law, model),
        input_core_dims=[["heave_position"], ["heave_position"]],
        output_core_dims=[[], []],
        vectorize=True,
    )
    return Found(value, true)


def _curves(law: xr.Dataset, model: str) -> tuple[xr.DataArray, xr.DataArray]:
    """X (m), rising, and the force of all cylinders (N)."""
    rest = law.sel(tensioner_model=model, drop=True).sortby("heave_position", ascending=False)
    return -rest["tensioner_stroke_static"].isel(cylinder=0), rest["tensioner_force_static"].sum(
        "cylinder"
    )


# Figs 10 to 14: the response


def agree(gas: xr.Dataset, linear: xr.Dataset, amplitude: float, at_most: float) -> Found:
    """Heave with both models agrees within a share of its swing; value: largest difference over it."""
    apart = _apart(gas, linear, amplitude)
    return Found(apart.min("compared"), apart <= at_most)


def differ(
    gas: xr.Dataset, linear: xr.Dataset, amplitude: float, at_least: float, asymmetry: float
) -> Found:
    """Heave with both models differs, and that with the gas law is asymmetric; value: as `agree`."""
    apart = _apart(gas, linear, amplitude)
    up, down = _sides(_model(gas, "gas law"))
    index = (up / down).sel(heave_amplitude=amplitude, drop=True)
    return Found(apart.min("compared"), (apart >= at_least) & (index >= asymmetry))


def asymmetry_grows(runs: xr.Dataset, amplitudes: list[float] | None = None) -> Found:
    """S rises from each amplitude to the next; value: S at the largest."""
    up, down = _sides(_model(runs, "gas law"), amplitudes)
    index = up / down
    return Found(
        index.isel(heave_amplitude=-1, drop=True),
        (index.diff("heave_amplitude") > 0).all("heave_amplitude"),
    )


def upper_side_larger(runs: xr.Dataset) -> Found:
    """x_p > x_n at all amplitudes, and both grow with it; value: x_p - x_n at the largest (m)."""
    up, down = _sides(_model(runs, "gas law"))
    growing = [(side.diff("heave_amplitude") > 0).all("heave_amplitude") for side in (up, down)]
    larger = (up > down).all("heave_amplitude")
    return Found((up - down).isel(heave_amplitude=-1, drop=True), larger & growing[0] & growing[1])


def pushed_in_harder(runs: xr.Dataset, amplitudes: list[float]) -> Found:
    """Piston moves less but force changes more towards X < 0; value: ratio of force changes.

    The value belongs to the largest amplitude.
    """
    runs = _model(runs, "gas law").isel(cylinder=0)
    law = {"X": (-1.0, "tensioner_stroke"), "F": (1.0, "tensioner_force")}
    rest, moving = _rest(runs), runs.sel(heave_amplitude=amplitudes)
    away = {
        name: sign * (moving[variable] - rest[variable + "_static"])
        for name, (sign, variable) in law.items()
    }
    inward = -away["X"].min("time") < away["X"].max("time")
    stronger = away["F"].max("time") > -away["F"].min("time")
    ratio = away["F"].max("time") / -away["F"].min("time")
    return Found(
        ratio.isel(heave_amplitude=-1, drop=True), (inward & stronger).all("heave_amplitude")
    )


def stays_in_tension(runs: xr.Dataset, amplitudes: list[float]) -> Found:
    """The riser is never compressed; value: smallest tension (MN)."""
    tension = _model(runs, "gas law")["effective_tension_min"].sel(heave_amplitude=amplitudes)
    smallest = tension.min(["s_node", "heave_amplitude"]) / 1e6
    return Found(smallest, smallest > 0)


def _apart(gas: xr.Dataset, linear: xr.Dataset, amplitude: float) -> xr.DataArray:
    """Largest difference over the gas law's swing, as it stands and from either's own equilibrium."""
    models = {"gas law": gas, "linear": linear}
    heave, rest = {}, {}
    for model, runs in models.items():
        chosen = _model(runs, model)
        heave[model] = chosen["z"].isel(s=-1, drop=True).sel(heave_amplitude=amplitude, drop=True)
        rest[model] = _rest(chosen)["z_static"].isel(s_node=-1, drop=True)
    difference = heave["linear"] - heave["gas law"]
    offset = rest["linear"] - rest["gas law"]
    swing = heave["gas law"].max("time") - heave["gas law"].min("time")
    ways = [abs(difference).max("time"), abs(difference - offset).max("time")]
    names = xr.DataArray(["as it stands", "from equilibrium"], dims="compared", name="compared")
    return xr.concat(ways, names) / swing


def _model(runs: xr.Dataset, model: str) -> xr.Dataset:
    if "tensioner_model" in runs.dims:
        return runs.sel(tensioner_model=model, drop=True)
    return runs


def _rest(runs: xr.Dataset) -> xr.Dataset:
    """The state at rest: of the smallest amplitude, since a moving platform may begin off its mean."""
    return runs.sel(heave_amplitude=runs["heave_amplitude"].min(), drop=True)


def _sides(
    runs: xr.Dataset, amplitudes: list[float] | None = None
) -> tuple[xr.DataArray, xr.DataArray]:
    """x_p and x_n (m) of all amplitudes above zero, or of some."""
    top = runs.isel(s_node=-1, drop=True)
    rest = _rest(top)["z_static"]
    moving = top.sel(heave_amplitude=top["heave_amplitude"] > 0)
    if amplitudes is not None:
        moving = moving.sel(heave_amplitude=amplitudes)
    return moving["z_max"] - rest, rest - moving["z_min"]


# errata


def readings(reductions: xr.Dataset) -> dict[str, Any]:
    """Reductions in words of the erratum on 30 % and 50 %."""
    table = reductions["reduction"]
    swing = table.sel(quantity="heave", measure="swing")
    apart = abs(table.sel(quantity="heave") - table.sel(quantity="tension")).max()
    return {
        "apart": float(apart),
        "amplitude": float(swing.sel(height="amplitude", reading="from_rest")),
        "height": float(swing.sel(height="height", reading="from_rest")),
        "settled": float(swing.sel(height="amplitude", reading="steady")),
    }


def ringing(asymmetry: xr.Dataset) -> dict[str, Any]:
    """Displacements at 5 m, from rest and settled (m)."""
    at = asymmetry.sel(heave_amplitude=5.0, tensioner_model="gas law")
    return {
        f"{side}_{reading}": float(at[f"displacement_{side}"].sel(reading=reading))
        for side in ("up", "down")
        for reading in ("from_rest", "steady")
    }


def equilibria(law: xr.Dataset) -> dict[str, Any]:
    """Equilibria of gas law and line (m), and what the force at X = 0 has over the weight (MN)."""
    rest = law.sel(heave_position=0.0).isel(s_node=-1)
    zero = float(law["s_node"][-1])
    x = {
        model: float(rest["z_static"].sel(tensioner_model=model)) - zero
        for model in ("gas law", "linear")
    }
    stroke, force = _curves(law, "gas law")
    at_zero = float(CubicSpline(stroke, force)(0.0))
    line_stroke, line = _curves(law, "linear")
    line_at_zero = float(CubicSpline(line_stroke, line)(0.0))
    tension = float(rest["effective_tension_static"].sel(tensioner_model="gas law"))
    weight = float(rest["tensioner_force_static"].sel(tensioner_model="gas law").sum()) - tension
    return {
        "gas": x["gas law"],
        "line": x["linear"],
        "intercept": line_at_zero / at_zero - 1.0,
        "surplus": (at_zero - weight) / 1e6,
        "reach": float(stroke.min()),
    }


def stiffnesses(law: xr.Dataset) -> dict[str, Any]:
    """Secant and tangent stiffness of all cylinders at X = -8 m (MN/m)."""
    curve = CubicSpline(*_curves(law, "gas law"))
    return {
        "secant": float((curve(-8.0) - curve(0.0)) / 8.0) / 1e6,
        "tangent": float(-curve(-8.0, 1)) / 1e6,
    }


def mass_places(runs: xr.Dataset) -> dict[str, Any]:
    """Equilibrium and settled swing at 5 m (m) with the mass at the ring and along the riser."""
    top = runs.sel(heave_amplitude=5.0).isel(s_node=-1)
    zero = float(runs["s_node"][-1])
    words = {"at the ring": "ring", "along the riser": "riser"}
    found = {}
    for place, word in words.items():
        run = top.sel(mass_place=place)
        found[f"rest_{word}"] = float(run["z_static"]) - zero
        found[f"swing_{word}"] = float(run["z_max"] - run["z_min"])
    return found
