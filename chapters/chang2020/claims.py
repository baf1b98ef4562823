"""Chang et al. 2020: checks of its numbers, claims and errata.

x is the rise of the ring above the unstretched riser, a the rise of the platform, X = x - a the displacement
of the piston.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from scipy.interpolate import CubicSpline

from chapters.chang2020.between_outputs import extremes
from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import above, below, everywhere
from riserstudy.grading.word_of_size import Word
from riserstudy.grading.yardstick import Condition, alike, all_along, all_of, growing, less, more, plain
from riserstudy.records.arrays import FloatArray

DRAWN = 8.0  # range of the piston in Figs 5, 6 and 9, either way (m)


# Fig 8: reduction by the tensioner


def reduction(reductions: xr.Dataset, quantity: str) -> Found:
    """Reduction of the oscillation of one quantity, in every interpretation."""
    return Found(reductions["reduction"].sel(quantity=quantity, drop=True))


def reduced(reductions: xr.Dataset, obvious: Word) -> Found:
    """The tensioner reduces the oscillations of tension and heave; value: the smaller reduction."""
    least = reductions["reduction"].min("quantity", skipna=False)
    # the oscillation without a tensioner is 1
    return judged(least, less(1.0 - least, 1.0, obvious))


# Figs 5, 6, 9: the tensioner's law


def falls_convex(law: xr.Dataset) -> Found:
    """Force falls and its slope rises everywhere; value: steepest over flattest slope."""

    def slopes(x: FloatArray, f: FloatArray) -> tuple[float, float]:
        slope = CubicSpline(x, f)(np.linspace(-DRAWN, DRAWN, 161), 1)
        steepness = slope.min() / slope.max()
        falling = -slope.max() / abs(slope).max()
        convex = float(above(slope[1:], slope[:-1]).min())
        return float(steepness), min(float(falling), convex)

    return _of_curves(slopes, law)


def secant_falls(law: xr.Dataset) -> Found:
    """Secant stiffness of Eq. 5 falls with X; value: that at X = -8 m over that at 8 m."""

    def secants(x: FloatArray, f: FloatArray) -> tuple[float, float]:
        curve = CubicSpline(x, f)
        at = np.append(np.linspace(-DRAWN, -0.1, 80), np.linspace(0.1, DRAWN, 80))
        secant = np.abs((curve(at) - curve(0.0)) / at)
        return float(secant[0] / secant[-1]), float(below(secant[1:], secant[:-1]).min())

    return _of_curves(secants, law)


def line_differs(law: xr.Dataset, visibly: Word) -> Found:
    """The least-squares line leaves the gas law; value: largest gap over the force at X = 0."""
    at = np.linspace(-DRAWN, DRAWN, 161)

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
    return judged(gap, above(gap, visibly.bound))


def _of_curves(judge: Callable[[FloatArray, FloatArray], tuple[float, float]], law: xr.Dataset) -> Found:
    value, margin = xr.apply_ufunc(
        judge,
        *_curves(law, "gas law"),
        input_core_dims=[["heave_position"], ["heave_position"]],
        output_core_dims=[[], []],
        vectorize=True,
    )
    return judged(value, margin)


def _curves(law: xr.Dataset, model: str) -> tuple[xr.DataArray, xr.DataArray]:
    """X (m), rising, and the force of all cylinders (N)."""
    rest = law.sel(tensioner_model=model, drop=True).sortby("heave_position", ascending=False)
    return -rest["tensioner_stroke_static"].isel(cylinder=0), rest["tensioner_force_static"].sum("cylinder")


# Figs 10 to 14: the response


def agree(gas: xr.Dataset, linear: xr.Dataset, amplitude: float, well: Word) -> Found:
    """Heave with both models agrees within a share of its range; value: largest difference over the range.

    Of two comparisons the one with the better agreement is used.
    """
    apart = _apart(gas, linear, amplitude).min("compared")
    return judged(apart, below(apart, well.bound))


def differ(
    gas: xr.Dataset, linear: xr.Dataset, amplitude: float, significantly: Word, asymmetric: Word
) -> Found:
    """Heave with both models differs, and with the gas law it is asymmetric; value: as in `agree`."""
    apart = _apart(gas, linear, amplitude).min("compared")
    up, down = (x.sel(heave_amplitude=amplitude, drop=True) for x in _sides(_model(gas, "gas law")))
    sides = more(up, down, asymmetric)
    return judged(apart, all_of(above(apart, significantly.bound), sides))


def asymmetry_grows(runs: xr.Dataset, increases: Word, amplitudes: list[float] | None = None) -> Found:
    """S rises with amplitude and never falls; value: S at the largest."""
    up, down = _sides(_model(runs, "gas law"), amplitudes)
    index = up / down
    grows = growing(index, "heave_amplitude", increases)
    return judged(index.isel(heave_amplitude=-1, drop=True), grows)


def upper_side_larger(runs: xr.Dataset, larger: Word) -> Found:
    """x_p exceeds x_n at the largest amplitude, and at none is below it; value: x_p - x_n there (m)."""
    up, down = _sides(_model(runs, "gas law"))
    difference, last = above(up, down), {"heave_amplitude": -1}
    never_below = plain(everywhere(difference, "heave_amplitude") + larger.band)
    at_last = more(up.isel(last, drop=True), down.isel(last, drop=True), larger)
    return judged((up - down).isel(last, drop=True), all_of(at_last, never_below))


def pushed_in_harder(runs: xr.Dataset, smaller: Word, amplitudes: list[float]) -> Found:
    """On the negative side displacement is smaller and the tensioner force changes more.

    Judged for the displacement X of the piston and x of the riser; value: change of force at the lowest
    position over its magnitude at the highest, at the largest amplitude.
    """
    runs = _model(runs, "gas law").isel(cylinder=0)
    rest, moving = _rest(runs), runs.sel(heave_amplitude=amplitudes)
    force = moving["tensioner_force"] - rest["tensioner_force_static"]
    ways = {
        "piston, X": rest["tensioner_stroke_static"] - moving["tensioner_stroke"],
        "riser, x": moving["z"].isel(s=-1, drop=True) - rest["z_static"].isel(s_node=-1, drop=True),
    }
    ratios, harder = [], []
    for away in ways.values():
        inward, outward = (_when(force, away, sign) for sign in (-1.0, 1.0))
        ratios.append(inward / abs(outward))
        less_far = less(-away.min("time"), away.max("time"), smaller)
        both = all_of(less_far, more(inward, abs(outward), smaller))
        harder.append(all_along(both, "heave_amplitude"))
    names = xr.DataArray(list(ways), dims="displacement", name="displacement")
    ratio = xr.concat(ratios, names).isel(heave_amplitude=-1, drop=True)
    condition = Condition(*(xr.concat(parts, names) for parts in zip(*harder, strict=True)))
    return judged(ratio, condition)


def _when(force: xr.DataArray, away: xr.DataArray, sign: float) -> xr.DataArray:
    """Force at the time of the largest displacement to one side; records may end early."""
    farthest = (sign * away).fillna(-np.inf).argmax("time")
    return force.isel(time=farthest).drop_vars("time")


def keeps_more_tension(gas: xr.Dataset, linear: xr.Dataset, amplitudes: list[float], larger: Word) -> Found:
    """The riser's smallest tension is larger with the gas law, at each amplitude; value: difference (MN)."""
    smallest = [
        _model(runs, model)["effective_tension_min"].sel(heave_amplitude=amplitudes).min("s_node")
        for model, runs in (("gas law", gas), ("linear", linear))
    ]
    gained = (smallest[0] - smallest[1]) / 1e6
    return judged(gained, more(smallest[0], smallest[1], larger))


def keeps_more_pull(gas: xr.Dataset, linear: xr.Dataset, amplitudes: list[float], larger: Word) -> Found:
    """The cylinders' smallest pull is larger with the gas law, at each amplitude; value: difference (MN)."""
    smallest = [
        _least_pull(_model(runs, m), amplitudes) for m, runs in (("gas law", gas), ("linear", linear))
    ]
    return judged((smallest[0] - smallest[1]) / 1e6, more(smallest[0], smallest[1], larger))


def _least_pull(runs: xr.Dataset, amplitudes: list[float]) -> xr.DataArray:
    """Smallest force of all cylinders together (N)."""
    pull = runs["tensioner_force"].sel(heave_amplitude=amplitudes).sum("cylinder", skipna=False)
    return extremes(pull)[1]


def caused_by_the_law(
    gas: xr.Dataset, linear: xr.Dataset, amplitude: float, asymmetric: Word, symmetric: Word
) -> Found:
    """The gas law's response is asymmetric and a line's is not; value: S of the gas law over the line's."""
    sides = [_sides(_model(runs, m)) for m, runs in (("gas law", gas), ("linear", linear))]
    curved, straight = ((up / down).sel(heave_amplitude=amplitude, drop=True) for up, down in sides)
    condition = all_of(more(curved, 1.0, asymmetric), alike(straight, 1.0, symmetric))
    return judged(curved / straight, condition)


def similar_then_apart(
    gas: xr.Dataset, linear: xr.Dataset, similar: Word, significantly: Word, amplitudes: list[float]
) -> Found:
    """Both models give similar heave at the smaller amplitude, and differ at the larger one.

    Value: ratio of the differences, the one at the larger amplitude over the other.
    """
    small, large = (_apart(gas, linear, amplitude).min("compared") for amplitude in amplitudes)
    both = all_of(below(small, similar.bound), above(large, significantly.bound))
    return judged(large / small, both)


def grows_with_the_bend(volumes: xr.Dataset, increases: Word) -> Found:
    """S rises as the gas volume falls, which curves the law; value: S of the smallest over the largest."""
    top = volumes.isel(s_node=-1, drop=True).sortby("gas_volume", ascending=False)
    index = (top["z_max"] - top["z_static"]) / (top["z_static"] - top["z_min"])
    ratio = index.isel(gas_volume=-1, drop=True) / index.isel(gas_volume=0, drop=True)
    return judged(ratio, growing(index, "gas_volume", increases))


def _apart(gas: xr.Dataset, linear: xr.Dataset, amplitude: float) -> xr.DataArray:
    """Largest difference over the gas law's range, directly and relative to each model's equilibrium."""
    models = {"gas law": gas, "linear": linear}
    heave, rest = {}, {}
    for model, runs in models.items():
        chosen = _model(runs, model)
        heave[model] = chosen["z"].isel(s=-1, drop=True).sel(heave_amplitude=amplitude, drop=True)
        rest[model] = _rest(chosen)["z_static"].isel(s_node=-1, drop=True)
    difference = heave["linear"] - heave["gas law"]
    offset = rest["linear"] - rest["gas law"]
    high, low = extremes(heave["gas law"])
    ways = [_farthest(difference), _farthest(difference - offset)]
    names = xr.DataArray(["as it stands", "from equilibrium"], dims="compared", name="compared")
    return xr.concat(ways, names) / (high - low)


def _farthest(history: xr.DataArray) -> xr.DataArray:
    """Largest magnitude over time."""
    high, low = extremes(history)
    return high.where(high > -low, -low)


def _model(runs: xr.Dataset, model: str) -> xr.Dataset:
    if "tensioner_model" in runs.dims:
        return runs.sel(tensioner_model=model, drop=True)
    return runs


def _rest(runs: xr.Dataset) -> xr.Dataset:
    """The state at rest, from the smallest amplitude, as a moving platform may start off its mean."""
    return runs.sel(heave_amplitude=runs["heave_amplitude"].min(), drop=True)


def _sides(runs: xr.Dataset, amplitudes: list[float] | None = None) -> tuple[xr.DataArray, xr.DataArray]:
    """x_p and x_n (m) of all amplitudes above zero, or of the given ones."""
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
    swing = table.sel(quantity="heave", measure="peak-to-peak range")
    half = table.sel(height="H is twice the amplitude", reading="from_rest")
    apart = abs(table.sel(quantity="heave") - table.sel(quantity="tension")).max()
    return {
        "apart": float(apart),
        "amplitude": float(swing.sel(height="H is the amplitude", reading="from_rest")),
        "height": float(swing.sel(height="H is twice the amplitude", reading="from_rest")),
        "settled": float(swing.sel(height="H is the amplitude", reading="steady")),
        "tension": float(half.sel(quantity="tension", measure="peak-to-peak range")),
        "heave": float(half.sel(quantity="heave", measure="standard deviation")),
    }


def ringing(asymmetry: xr.Dataset) -> dict[str, Any]:
    """Displacements at 5 m, from rest and in steady state (m)."""
    at = asymmetry.sel(heave_amplitude=5.0, tensioner_model="gas law")
    return {
        f"{side}_{reading}": float(at[f"displacement_{side}"].sel(reading=reading))
        for side in ("up", "down")
        for reading in ("from_rest", "steady")
    }


def two_displacements(runs: xr.Dataset) -> dict[str, Any]:
    """Tensioner force (MN) at lowest and highest position of riser and piston, in steady state at 10 m."""
    run = _model(runs, "gas law").sel(heave_amplitude=10.0).isel(s=-1)
    force = run["tensioner_force"].sum("cylinder") / 1e6
    places = {"x": run["z"] - float(runs["s"][-1]), "X": -run["tensioner_stroke"].isel(cylinder=0)}
    swings = {}
    for name, place in places.items():
        swings[f"{name}_low"] = float(force.isel(time=int(place.argmin("time"))))
        swings[f"{name}_high"] = float(force.isel(time=int(place.argmax("time"))))
    swings["lowest"] = float(places["x"].min())
    return swings


def kept_in_tension(settled: xr.Dataset, start: xr.Dataset, bare: xr.Dataset) -> dict[str, Any]:
    """Smallest tensions of the riser (MN) with the tensioner at 5 and 10 m, and without it at 5 m."""
    cases = {"settled": _model(settled, "gas law"), "start": _model(start, "gas law")}
    facts = {
        f"{name}_{amplitude:g}": float(
            runs["effective_tension_min"].sel(heave_amplitude=amplitude).min() / 1e6
        )
        for name, runs in cases.items()
        for amplitude in (5.0, 10.0)
    }
    pressed = bare["effective_tension_min"].sel(heave_amplitude=5.0).min()
    return facts | {"bare": -float(pressed) / 1e6}


def equilibria(law: xr.Dataset) -> dict[str, Any]:
    """Equilibria of gas law and line (m), and the excess of the force at X = 0 over the weight (MN)."""
    rest = law.sel(heave_position=0.0).isel(s_node=-1)
    zero = float(law["s_node"][-1])
    x = {model: float(rest["z_static"].sel(tensioner_model=model)) - zero for model in ("gas law", "linear")}
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
    return {"secant": float((curve(-8.0) - curve(0.0)) / 8.0) / 1e6, "tangent": float(-curve(-8.0, 1)) / 1e6}


def mass_places(runs: xr.Dataset) -> dict[str, Any]:
    """Equilibrium and steady range at 5 m (m) with the mass at the ring and along the riser."""
    top = runs.sel(heave_amplitude=5.0).isel(s_node=-1)
    zero = float(runs["s_node"][-1])
    words = {"at the ring": "ring", "along the riser": "riser"}
    changes = {}
    for place, word in words.items():
        run = top.sel(mass_place=place)
        changes[f"rest_{word}"] = float(run["z_static"]) - zero
        changes[f"swing_{word}"] = float(run["z_max"] - run["z_min"])
    return changes
