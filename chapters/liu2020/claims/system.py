"""Liu et al. 2020: results against which its numbers and claims are checked."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import above, below, everywhere, least, rising
from riserstudy.grading.word_of_size import Word
from riserstudy.grading.yardstick import Condition, all_along, all_of, growing, less, more

#: possible meanings of the individual riser; config/studies/liu2020.yaml, readings
WITHOUT = [
    "constant",
    "vertical force at the ring",
    "232 t carried to the upper flex joint",
    "riser's top on the platform",
]
#: periods (s) at which Fig 20 may have been computed
GRIDS = {
    "5, 10, 20 s": [5.0, 10.0, 20.0],
    "5, 10, 15, 20 s": [5.0, 10.0, 15.0, 20.0],
    "6, 12, 20 s": [6.0, 12.0, 20.0],
    "5, 8, 12, 20 s": [5.0, 8.0, 12.0, 20.0],
    "5, 6, 7, 8, 10, 12, 15, 20 s": [5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 15.0, 20.0],
}
DEGREES = 180.0 / np.pi  # degrees per radian
OUTER, INNER = 21.0 * 0.0254, 19.0 * 0.0254  # m, diameters of the pipe
SECTION_MODULUS = np.pi / 32.0 * (OUTER**4 - INNER**4) / OUTER  # m3
STEEPEST, GRAVITY = 0.142, 9.81  # height of a breaking wave divided by its length (Michell); m/s2

# Table 2 and the constant tension


def constant_tension(readings: xr.Dataset) -> Found:
    """Tension of all cylinders (t), in every interpretation."""
    return Found(readings["top_tension"] / readings["gravity"] / 1e3)


# Fig 10: the check riser


def codes_agree(codes: xr.Dataset, nearly_same: Word) -> Found:
    """Three methods give nearly the same displacement; value: largest difference / largest displacement."""
    apart = codes["codes_apart"]
    return judged(apart, below(apart, nearly_same.bound))


# Figs 11 and 12: statics


def pushed_back(force: xr.Dataset, speed: float) -> Found:
    """Horizontal force of the tensioners at a surface speed (N)."""
    return Found(force["horizontal_force"].sel(surface_speed=speed, drop=True))


def opposes(readings: xr.Dataset) -> Found:
    """The tensioners push against the current at every speed; value: least force at 1 m/s (N)."""
    force = readings["horizontal_force"].sel(counted="all cylinders", drop=True)
    margin = above(force, 0.0, over=abs(force).max("surface_speed"))
    return judged(force.sel(surface_speed=1.0, drop=True), everywhere(margin, "surface_speed"))


def moves_less(readings: xr.Dataset, smaller: Word) -> Found:
    """With tensioners the riser moves less in every current; value: ratio to the other riser at 1 m/s."""
    return _less_on_tensioners(readings["largest_displacement"], smaller)


def bends_less_near_the_top(readings: xr.Dataset, smaller: Word) -> Found:
    """Within 60 m below the ring the riser bends less on the tensioners; value: ratio at 1 m/s."""
    return _less_on_tensioners(readings["largest_bending_moment_near_ring"], smaller)


def bends_less(readings: xr.Dataset, smaller: Word) -> Found:
    """The largest moment is smaller on the tensioners; value: ratio at 1 m/s."""
    return _less_on_tensioners(readings["largest_bending_moment"], smaller)


def _less_on_tensioners(values: xr.DataArray, smaller: Word) -> Found:
    on, without = values.sel(tensioner_model="gas law", drop=True), _without(values)
    condition = all_along(less(on, without, smaller), "surface_speed")
    return judged((on / without).sel(surface_speed=1.0, drop=True), condition)


def simple_model_differs(readings: xr.Dataset, larger: Word) -> Found:
    """A model without tensioners gives different statics; value: largest difference, by possible meaning."""
    apart = []
    for name in ("largest_displacement", "largest_bending_moment"):
        gas = readings[name].sel(tensioner_model="gas law", drop=True)
        apart.append(abs(above(gas, _without(readings[name]))).max("surface_speed"))
    most = xr.concat(apart, "of").max("of")
    return judged(most, Condition(most - larger.bound, most < larger.band))


def _without(values: xr.DataArray) -> xr.DataArray:
    """Values of the riser without tensioners, in all its possible meanings."""
    return values.sel(tensioner_model=WITHOUT)


# Figs 13 to 15: heave


def uniform(heave: xr.Dataset, amplitude: float, period: float, same: Word) -> Found:
    """Axial force is periodic, with equal amplitude and phase at both ends; a lag in rad has the same bound.

    Value: largest relative difference, between the two ends and between the last two periods.
    """
    run = heave.sel(heave_amplitude=amplitude, heave_period=period, drop=True)
    apart = abs(run["axial_force_amplitude_top"] / run["axial_force_amplitude"] - 1.0)
    worst = apart.where(apart > run["settling"], run["settling"])
    together = below(
        abs(run["axial_force_lag"]), same.bound
    )  # a lag of x rad makes a difference of x times the amplitude
    return judged(worst, least(below(worst, same.bound), together))


def amplitude_not_period(heave: xr.Dataset, clearly: Word, little: Word) -> Found:
    """Force increases clearly with heave, and changes little with period; value: largest spread.

    Only heave that a platform can have counts: at most the amplitude of a breaking wave of this period.
    """
    force, steepest = heave["axial_force_amplitude"], 0.5 * STEEPEST
    length = GRAVITY * heave["heave_period"] ** 2 / (2.0 * np.pi)
    possible = force.where(force["heave_amplitude"] <= steepest * length)
    spread = 1.0 - possible.min("heave_period") / possible.max("heave_period")
    grows = []
    for period in possible["heave_period"].values:
        curve = possible.sel(heave_period=period, drop=True).dropna("heave_amplitude", how="all")
        if curve.sizes["heave_amplitude"] > 1:
            grows.append(growing(curve, "heave_amplitude", clearly))
    most = spread.max("heave_amplitude")
    return judged(most, all_of(*grows, below(most, little.bound)))


def not_negligible(heave: xr.Dataset, amplitude: float, period: float, felt: Word) -> Found:
    """The axial force varies by a perceptible share of the tension; value: this share."""
    share = heave["axial_force_share"]
    share = share.sel(heave_amplitude=amplitude, heave_period=period, drop=True)
    return judged(share, above(share, felt.bound))


# Figs 16 to 18: surge


def travels_down(motion: xr.Dataset) -> Found:
    """Motion begins later at each greater depth; value: time from 100 m to 400 m (s)."""
    arrival = motion["arrival"].sortby("depth")
    passed = arrival.isel(depth=-1, drop=True) - arrival.isel(depth=0, drop=True)
    return judged(passed, rising(arrival, "depth"))


def seems_the_same(surge: xr.Dataset, same: Word) -> Found:
    """Displacement nearly equals the other model's; value: r.m.s. difference / r.m.s. with tensioners."""
    apart = _without(surge["displacement_apart"])
    return judged(apart, below(apart, same.bound))


def surges_less(surge: xr.Dataset, smaller: Word) -> Found:
    """With tensioners every depth moves less; value: largest ratio to the other model."""
    moved = surge["displacement_amplitude"]
    on, without = moved.sel(tensioner_model="gas law", drop=True), _without(moved)
    return judged((on / without).max("depth"), all_along(less(on, without, smaller), "depth"))


def lags(surge: xr.Dataset, later: Word) -> Found:
    """With tensioners every depth moves later; value: least lag behind the other model (degrees).

    A lag of x rad makes a difference of x times the amplitude. ``later`` bounds this difference.
    """
    lag = surge["displacement_lag"]
    return _later_at_every_depth(lag.sel(tensioner_model="gas law", drop=True) - _without(lag), later)


def _later_at_every_depth(phase_lag: xr.DataArray, later: Word) -> Found:
    """A lag (rad, in any turn) bounded at every depth; value: least lag (degrees)."""
    phase_lag = (phase_lag + np.pi) % (2.0 * np.pi) - np.pi
    by_depth = Condition(phase_lag - later.bound, abs(phase_lag) < later.band)
    return judged(phase_lag.min("depth") * DEGREES, all_along(by_depth, "depth"))


def flexibility_makes_the_lag(surge: xr.Dataset, stiff: xr.Dataset, later: Word) -> Found:
    """The riser lags more on the tensioners than on tensioners of almost constant length.

    Value: least phase lag of four depths (degrees).
    """
    gas = surge["displacement_lag"].sel(tensioner_model="gas law", drop=True)
    without = stiff["displacement_lag"].sel(tensioner_model="stiff", drop=True)
    return _later_at_every_depth(gas - without, later)


# Figs 19 and 20: roll


def largest_moment(roll: xr.Dataset, amplitude: float, period: float) -> Found:
    """Largest bending moment (kN m)."""
    moment = roll["largest_bending_moment"].sel(roll_amplitude=amplitude, roll_period=period, drop=True)
    return Found(moment / 1e3)


def bending_stress(roll: xr.Dataset, amplitude: float, period: float) -> Found:
    """Outer-fibre stress of the largest moment, as amplitude and as peak-to-peak range (MPa)."""
    stress = 1e3 * largest_moment(roll, amplitude, period).value / SECTION_MODULUS / 1e6
    names = xr.DataArray(["amplitude", "peak to peak"], dims="reading", name="reading")
    return Found(xr.concat([stress, 2.0 * stress], names))


def grows_with_amplitude(roll: xr.Dataset, increases: Word) -> Found:
    """Moment increases with roll amplitude at every period; value: least ratio of neighbours."""
    moment = roll["largest_bending_moment"]
    ratio = moment / moment.shift(roll_amplitude=1)
    smallest = ratio.min(["roll_amplitude", "roll_period"])
    grows = growing(moment, "roll_amplitude", increases)
    return judged(smallest, all_along(grows, "roll_period"))


def through_the_tensioners(roll: xr.Dataset, amplitude: float, period: float, larger: Word) -> Found:
    """Roll bends the riser more with cylinders than without; value: ratio without / with."""
    moment = roll["largest_bending_moment"].sel(roll_amplitude=amplitude, roll_period=period, drop=True)
    on, without = (moment.sel(tensioner_model=m, drop=True) for m in ("gas law", WITHOUT[2]))
    return judged(without / on, more(on, without, larger))


def falls_with_period(roll: xr.Dataset, decreases: Word) -> Found:
    """Moment decreases over the periods of a grid, never increases; value: largest ratio of neighbours.

    Each grid of periods that Fig 20 may have is judged, if all of its periods were simulated.
    """
    moment = roll["largest_bending_moment"]
    there = [name for name, grid in GRIDS.items() if set(grid) <= set(moment["roll_period"].values)]
    names, steps, falls = xr.DataArray(there, dims="grid", name="grid"), [], []
    for name in there:
        chosen = moment.sel(roll_period=GRIDS[name])
        ratio = chosen / chosen.shift(roll_period=1)
        steps.append(ratio.max(["roll_amplitude", "roll_period"]))
        falls.append(all_along(growing(chosen, "roll_period", decreases, -1.0), "roll_amplitude"))
    condition = Condition(*(xr.concat(parts, names) for parts in zip(*falls, strict=True)))
    return judged(xr.concat(steps, names), condition)


# Figs 23 and 24: response in waves


def surge_largest(rao: xr.Dataset, larger: Word, felt: Word) -> Found:
    """Surge has the largest peak and mean share over periods; other motions are not negligible.

    Value: mean share of surge.
    """
    peak, period = rao["stress_amplitude"].max("wave_period"), rao["wave_period"]
    # periods are closer together near resonances of lateral modes
    share = rao["stress_share"].integrate("wave_period") / float(period.max() - period.min())
    surge, others = {"motion": "surge"}, {"motion": ["heave", "pitch"]}
    largest = [less(x.sel(others), x.sel(surge, drop=True), larger) for x in (peak, share)]
    condition = all_of(*largest, above(share.sel(others), felt.bound))
    return judged(share.sel(surge, drop=True), all_along(condition, "motion"))
