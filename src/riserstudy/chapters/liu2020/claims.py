"""Liu et al. 2020: what its numbers, claims and errata are checked against."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from riserstudy.grading.grade import Found, answers, judged
from riserstudy.grading.margin import above, below, everywhere, least, rising
from riserstudy.grading.verdict import ALMOST_ALWAYS
from riserstudy.grading.word import Word
from riserstudy.grading.yardstick import Condition, all_along, all_of, growing, less, more

#: the individual riser as it may be meant; config/studies/liu2020.yaml, readings
WITHOUT = [
    "constant",
    "vertical force at the ring",
    "232 t carried to the upper flex joint",
    "riser's top on the platform",
]
#: periods (s) that Fig 20 may be drawn over
GRIDS = {
    "5, 10, 20 s": [5.0, 10.0, 20.0],
    "5, 10, 15, 20 s": [5.0, 10.0, 15.0, 20.0],
    "6, 12, 20 s": [6.0, 12.0, 20.0],
    "5, 8, 12, 20 s": [5.0, 8.0, 12.0, 20.0],
    "5, 6, 7, 8, 10, 12, 15, 20 s": [5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 15.0, 20.0],
}
INCH, DEGREES = 0.0254, 180.0 / np.pi  # m, a radian
LENGTH = 533.0  # m of riser
STEEPEST, GRAVITY = 0.142, 9.81  # height over length of a wave that breaks (Michell); m/s2
RELAXATION = 0.81318 / np.pi  # s, by Eq. 16 with a ratio of 1: at_period over pi
WET = 220.0 / 15.24  # kg/m in water, of a joint of Table 1

# Table 2 and the constant tension


def constant_tension(readings: xr.Dataset) -> Found:
    """Tension of all cylinders in tonnes, in every reading."""
    return Found(readings["top_tension"] / readings["gravity"] / 1e3)


# Fig 10: the check riser


def codes_agree(codes: xr.Dataset, nearly_same: Word) -> Found:
    """Three methods give nearly the same displacement; value: largest difference over the largest."""
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
    """With tensioners the riser moves less in every current; value: ratio to the other at 1 m/s."""
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
    """A pull carried to the upper flex joint gives other statics; value: largest difference."""
    apart = []
    for name in ("largest_displacement", "largest_bending_moment"):
        gas, simple = (
            readings[name].sel(tensioner_model=model, drop=True)
            for model in ("gas law", WITHOUT[2])
        )
        apart.append(abs(above(gas, simple)).max("surface_speed"))
    most = xr.concat(apart, "of").max("of")
    return judged(most, Condition(most - larger.bound, most < larger.band))


def _without(values: xr.DataArray) -> xr.DataArray:
    """Values of the riser without tensioners, as it may be meant."""
    return values.sel(tensioner_model=WITHOUT)


# Figs 13 to 15: heave


def uniform(heave: xr.Dataset, amplitude: float, period: float, same: Word) -> Found:
    """Axial force repeats itself, alike at both ends in amplitude, and in phase by as much of an amplitude.

    Value: largest relative difference, of the ends and of the last two periods.
    """
    run = heave.sel(heave_amplitude=amplitude, heave_period=period, drop=True)
    apart = abs(run["axial_force_amplitude_top"] / run["axial_force_amplitude"] - 1.0)
    worst = apart.where(apart > run["settling"], run["settling"])
    together = below(
        abs(run["axial_force_lag"]), same.bound
    )  # a lag of x rad is x of the amplitude
    return judged(worst, least(below(worst, same.bound), together))


def amplitude_not_period(heave: xr.Dataset, clearly: Word, little: Word) -> Found:
    """Force grows clearly with heave, and changes little with period; value: largest spread.

    Of heaves that a platform can have: no larger than waves of that period at which they break.
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
    """The axial force varies by a share of the tension; value: the share."""
    share = heave["axial_force_share"]
    share = share.sel(heave_amplitude=amplitude, heave_period=period, drop=True)
    return judged(share, above(share, felt.bound))


# Figs 16 to 18: surge


def travels_down(motion: xr.Dataset) -> Found:
    """Motion begins at each depth after the one above; value: time from 100 m to 400 m (s)."""
    arrival = motion["arrival"].sortby("depth")
    passed = arrival.isel(depth=-1, drop=True) - arrival.isel(depth=0, drop=True)
    return judged(passed, rising(arrival, "depth"))


def seems_the_same(surge: xr.Dataset, same: Word) -> Found:
    """Displacement is nearly that without tensioners; value: their difference over it, root mean square."""
    apart = _without(surge["displacement_apart"])
    return judged(apart, below(apart, same.bound))


def surges_less(surge: xr.Dataset, smaller: Word) -> Found:
    """With tensioners every depth moves less; value: largest ratio to the other model."""
    moved = surge["displacement_amplitude"]
    on, without = moved.sel(tensioner_model="gas law", drop=True), _without(moved)
    return judged((on / without).max("depth"), all_along(less(on, without, smaller), "depth"))


def lags(surge: xr.Dataset, later: Word) -> Found:
    """With tensioners every depth comes later; value: least lag behind the other model (degrees).

    A lag of x rad makes a difference of x of the amplitude, which is what a word bounds.
    """
    lag = surge["displacement_lag"]
    behind = lag.sel(tensioner_model="gas law", drop=True) - _without(lag)
    behind = (behind + np.pi) % (2.0 * np.pi) - np.pi
    by_depth = Condition(behind - later.bound, abs(behind) < later.band)
    return judged(behind.min("depth") * DEGREES, all_along(by_depth, "depth"))


def flexibility_makes_the_lag(surge: xr.Dataset, later: Word) -> Found:
    """The riser lags more on gas than on a constant pull; value: least of four depths (degrees)."""
    lag = surge["displacement_lag"]
    gas, constant = (lag.sel(tensioner_model=name, drop=True) for name in ("gas law", "constant"))
    behind = (gas - constant + np.pi) % (2.0 * np.pi) - np.pi
    by_depth = Condition(behind - later.bound, abs(behind) < later.band)
    return judged(behind.min("depth") * DEGREES, all_along(by_depth, "depth"))


# Figs 19 and 20: roll


def largest_moment(roll: xr.Dataset, amplitude: float, period: float) -> Found:
    """Largest bending moment (kN m)."""
    moment = roll["largest_bending_moment"].sel(
        roll_amplitude=amplitude, roll_period=period, drop=True
    )
    return Found(moment / 1e3)


def bending_stress(roll: xr.Dataset, amplitude: float, period: float) -> Found:
    """Stress of the largest moment at the outer fibre, as amplitude and peak to peak (MPa)."""
    outer, inner = 21.0 * INCH, 19.0 * INCH
    modulus = np.pi / 32.0 * (outer**4 - inner**4) / outer
    stress = 1e3 * largest_moment(roll, amplitude, period).value / modulus / 1e6
    names = xr.DataArray(["amplitude", "peak to peak"], dims="reading", name="reading")
    return Found(xr.concat([stress, 2.0 * stress], names))


def grows_with_amplitude(roll: xr.Dataset, increases: Word) -> Found:
    """Moment rises with roll amplitude at every period; value: least ratio of neighbours."""
    moment = roll["largest_bending_moment"]
    ratio = moment / moment.shift(roll_amplitude=1)
    smallest = ratio.min(["roll_amplitude", "roll_period"])
    grows = growing(moment, "roll_amplitude", increases)
    return judged(smallest, all_along(grows, "roll_period"))


def through_the_tensioners(
    roll: xr.Dataset, amplitude: float, period: float, larger: Word
) -> Found:
    """Roll bends the riser more with cylinders than without; value: moment without over that with them."""
    moment = roll["largest_bending_moment"].sel(
        roll_amplitude=amplitude, roll_period=period, drop=True
    )
    on, without = (moment.sel(tensioner_model=m, drop=True) for m in ("gas law", WITHOUT[2]))
    return judged(without / on, more(on, without, larger))


def falls_with_period(roll: xr.Dataset, decreases: Word) -> Found:
    """Moment falls over the periods of a grid and never rises; value: largest ratio of neighbours.

    Judged over each of the grids that Fig 20 may have, as far as its periods are there.
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
    """Surge has the largest peak and the largest mean share over periods; others are not negligible.

    Value: mean share of surge.
    """
    peak, period = rao["stress_amplitude"].max("wave_period"), rao["wave_period"]
    # periods stand closer where lateral modes answer
    share = rao["stress_share"].integrate("wave_period") / float(period.max() - period.min())
    surge, others = {"motion": "surge"}, {"motion": ["heave", "pitch"]}
    largest = [less(x.sel(others), x.sel(surge, drop=True), larger) for x in (peak, share)]
    condition = all_of(*largest, above(share.sel(others), felt.bound))
    return judged(share.sel(surge, drop=True), all_along(condition, "motion"))


# errata


def tensions(readings: xr.Dataset) -> dict[str, Any]:
    """Tonnes in the readings that the erratum names, and times the riser's weight in water."""
    every = constant_tension(readings).value.sel(gravity=9.81, pressures="absolute")
    tonnes = every.sel(mid_stroke="riser in equilibrium")
    six = every.sel(cylinders="six", pistons="6050 kg in all")
    once, other = (
        float(six.sel(mid_stroke=zero, inclination=0.0))
        for zero in ("riser in equilibrium", "riser unstretched")
    )
    return {
        "once": once,
        "unstretched": other,
        "lost": once - other,
        "inclined": float(six.sel(mid_stroke="riser in equilibrium", inclination=11.3)),
        "ratio": 1e3 * once / (LENGTH * WET),
        "each": float(tonnes.sel(cylinders="six", pistons="6050 kg each", inclination=0.0)),
        "seven": float(tonnes.sel(cylinders="seven", pistons="6050 kg each", inclination=9.5)),
        "leaning": float(tonnes.sel(cylinders="six", pistons="massless", inclination=12.8)),
    }


def forces(
    force: xr.Dataset, calibrated: xr.Dataset, slow: float, middle: float, fast: float
) -> dict[str, Any]:
    """Horizontal forces (N) in the calibrated currents, and drag coefficients that profiles would need.

    ``slow``, ``middle``, ``fast``: those printed for 0.2, 0.6 and 1 m/s (N).
    """
    both = calibrated["horizontal_force"]
    tuned, other = (
        both.sel(calibration=f"8765 N by {counted}")
        for counted in ("all cylinders", "one cylinder")
    )
    fastest = force["horizontal_force"].sel(surface_speed=1.0)
    printed = {0.2: slow, 0.6: middle, 1.0: fast}
    apart = [each / float(tuned.sel(surface_speed=u)) for u, each in printed.items()]
    needed = fast / fastest  # of a drag coefficient of 1, to which the force is proportional
    return {
        "slow": float(tuned.sel(surface_speed=0.2)),
        "middle": float(tuned.sel(surface_speed=0.6)),
        "fast": float(tuned.sel(surface_speed=1.0)),
        "one": float(other.sel(surface_speed=1.0)),
        # one factor on all forces, which are proportional to the drag coefficient
        "spread": (max(apart) - min(apart)) / (max(apart) + min(apart)),
        "linear_all": float(needed.sel(current_profile="linear", counted="all cylinders")),
        "linear_one": float(needed.sel(current_profile="linear", counted="one cylinder")),
        "surface_all": float(
            needed.sel(current_profile="exponential 50 m", counted="all cylinders")
        ),
    }


def varied(variants: xr.Dataset) -> dict[str, Any]:
    """Moment of variants over that of the scene (-, at 5 and 10 s), and with another length (kN m).

    With the damping that is printed, the largest change and its period (s), and that of the curvature: the
    moment is E I (k + tau dk/dt), in periodic motion sqrt(1 + (w tau)^2) of the elastic one.
    """
    moment = variants["largest_bending_moment"]
    base = moment.sel(variant="as it is")
    heavy = moment.sel(variant="damping ratio 1") / base - 1.0
    turning = moment.sel(variant="damping by Eq. 16") / base - 1.0
    printed = moment.sel(variant="damping by Eq. 16 with a ratio of 1") / base - 1.0
    worst = float(abs(printed).idxmax("roll_period"))
    pistons = moment.sel(variant="pistons on the ring") / base - 1.0
    relaxing = 2.0 * np.pi / worst * RELAXATION
    elastic = (1.0 + float(printed.sel(roll_period=worst))) / np.hypot(1.0, relaxing) - 1.0
    return {
        "heavy": float(heavy.sel(roll_period=5.0)),
        "heavy_slow": float(heavy.sel(roll_period=10.0)),
        "turning": float(turning.sel(roll_period=5.0)),
        "turning_slow": float(turning.sel(roll_period=10.0)),
        "printed": float(printed.sel(roll_period=worst)),
        "printed_at": worst,
        "elastic": elastic,
        "base": float(base.sel(roll_period=10.0)) / 1e3,
        "pistons": float(pistons.sel(roll_period=5.0)),
        "pistons_slow": float(pistons.sel(roll_period=10.0)),
        "shorter": float(moment.sel(variant="533 m to the upper flex joint", roll_period=10.0))
        / 1e3,
    }


def heave_beside(heave: xr.Dataset, upright: xr.Dataset) -> dict[str, Any]:
    """Amplitude of the axial force at the bottom (kN) with cylinders in space and upright."""
    upright_force = upright["effective_tension"].isel(s=0)
    swing = 0.5 * (upright_force.max("time") - upright_force.min("time"))
    at = heave["axial_force_amplitude"].sel(heave_amplitude=2.0, heave_period=15.0)
    return {"space": float(at) / 1e3, "upright": float(swing.squeeze()) / 1e3}


def left_out(roll: xr.Dataset, heave: xr.Dataset) -> dict[str, Any]:
    """What cylinders' masses and losses would change: moment under roll, axial force under heave (-)."""
    force = heave["effective_tension"].isel(s=0)
    swing = force.max("time") - force.min("time")
    lossless = swing.sel(losses="none")
    changes = {
        name: float(swing.sel(losses=of) / lossless - 1.0)
        for name, of in (("small", "967 N s/m a cylinder"), ("large", "10 kN s/m a cylinder"))
    }
    facts = varied(roll)
    return changes | {name: facts[name] for name in ("pistons", "pistons_slow")}


def baselines(
    readings: xr.Dataset, surge: xr.Dataset, smaller: Word, later: Word
) -> dict[str, Any]:
    """Shares of samples in which static (Q2) and dynamic claims (Q8, Q9) are true, by baseline.

    Named are the baselines with which Q2 and Q8 are both almost always true.
    """
    claims = {
        "Q2": moves_less(readings, smaller),
        "Q8": surges_less(surge, smaller),
        "Q9": lags(surge, later),
    }
    shares: dict[str, dict[str, float]] = {}
    for claim, claim_shares in claims.items():
        answer = answers(claim_shares)
        others = [dim for dim in answer.dims if dim != "tensioner_model"]
        rate = (answer > 0.0).where(answer.notnull()).mean(others)
        shares[claim] = {model: float(rate.sel(tensioner_model=model)) for model in WITHOUT}
    both = [m for m in WITHOUT if min(shares["Q2"][m], shares["Q8"][m]) >= ALMOST_ALWAYS]
    sentences = [
        f"{claim} " + ", ".join(f"{model} {100 * share:.0f} %" for model, share in each.items())
        for claim, each in shares.items()
    ]
    return {"shares": "; ".join(sentences), "both": " and ".join(both) or "none"}


def waves_on_the_riser(waves: xr.Dataset) -> dict[str, Any]:
    """Stress amplitude with waves on the riser too over that by the platform's motion alone.

    Named are the least and the most over wave periods with their periods (s), and the most by which what
    waves do above the mean level tells readings apart (%).
    """
    stress = waves["stress_amplitude"]
    alone = "on the platform alone"
    readings = stress.drop_sel(waves=alone)
    ratio = stress.sel(waves="stretched to the surface") / stress.sel(waves=alone)
    period = ratio["wave_period"].values
    apart = readings.max("waves") / readings.min("waves") - 1.0
    return {
        "least": float(ratio.min()),
        "least_at": period[ratio.values.argmin()],
        "most": float(ratio.max()),
        "most_at": period[ratio.values.argmax()],
        "above": 100.0 * float(apart.max()),
    }


def stresses(roll: xr.Dataset) -> dict[str, Any]:
    """Stress of the printed moment in both readings (MPa)."""
    outer, inner = 21.0 * INCH, 19.0 * INCH
    modulus = np.pi / 32.0 * (outer**4 - inner**4) / outer
    return {
        "moment": float(largest_moment(roll, 4.0, 10.0).value),
        "amplitude": 32.8e3 / modulus / 1e6,
        "range": 2.0 * 32.8e3 / modulus / 1e6,
    }


def peaks(roll: xr.Dataset) -> dict[str, Any]:
    """Periods (s) at which the largest moment peaks, 4 degrees of roll."""
    moment = roll["largest_bending_moment"].sel(roll_amplitude=4.0)
    values, period = moment.values, moment["roll_period"].values
    inside = (values[1:-1] > values[:-2]) & (values[1:-1] > values[2:])
    return {"peaks": ", ".join(f"{x:g} s" for x in period[1:-1][inside]) or "none"}
