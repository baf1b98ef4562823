"""Liu et al. 2020: numbers that the errata quote."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from chapters.liu2020.below_ring import RING
from chapters.liu2020.claims.system import (
    SECTION_MODULUS,
    WITHOUT,
    constant_tension,
    lags,
    largest_moment,
    moves_less,
    surges_less,
)
from chapters.liu2020.periods import half_swing
from riserstudy.grading.found import answers
from riserstudy.grading.verdict import ALMOST_ALWAYS
from riserstudy.grading.word_of_size import Word
from riserstudy.records.words import listed

RELAXATION = 0.81318 / np.pi  # s, by Eq. 16 with a damping ratio of 1: at_period divided by pi
HEAVE_PERIOD = 15.0  # s
WET = 220.0 / 15.24  # kg/m in water, for a joint of Table 1


def tensions(readings: xr.Dataset) -> dict[str, Any]:
    """Tension (t) in the interpretations that the erratum names, and its ratio to the submerged weight."""
    every = constant_tension(readings).value.sel(gravity=9.81, pressures="absolute")
    tonnes = every.sel(mid_stroke="riser in equilibrium")
    sevens = tonnes.sel(cylinders="seven", pistons="6050 kg each")
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
        "ratio": 1e3 * once / (RING * WET),
        "each": float(tonnes.sel(cylinders="six", pistons="6050 kg each", inclination=0.0)),
        "seven": float(sevens.sel(inclination=9.5)),
        "upright": float(sevens.sel(inclination=0.0)),
        "leaning": float(tonnes.sel(cylinders="six", pistons="massless", inclination=12.8)),
    }


def forces(
    force: xr.Dataset, calibrated: xr.Dataset, slow: float, middle: float, fast: float
) -> dict[str, Any]:
    """Horizontal forces (N) in the calibrated currents, and the drag coefficients that profiles require.

    ``slow``, ``middle``, ``fast``: the forces printed for 0.2, 0.6 and 1 m/s (N).
    """
    both = calibrated["horizontal_force"]
    tuned, other = (
        both.sel(calibration=f"8765 N by {counted}") for counted in ("all cylinders", "one cylinder")
    )
    fastest = force["horizontal_force"].sel(surface_speed=1.0)
    printed = {0.2: slow, 0.6: middle, 1.0: fast}
    apart = [each / float(tuned.sel(surface_speed=u)) for u, each in printed.items()]
    needed = fast / fastest  # drag coefficient, to which force is proportional; computed with 1
    return {
        "slow": float(tuned.sel(surface_speed=0.2)),
        "middle": float(tuned.sel(surface_speed=0.6)),
        "fast": float(tuned.sel(surface_speed=1.0)),
        "one": float(other.sel(surface_speed=1.0)),
        # a drag coefficient multiplies all forces by one factor
        "spread": (max(apart) - min(apart)) / (max(apart) + min(apart)),
        "linear_all": float(needed.sel(current_profile="linear", counted="all cylinders")),
        "linear_one": float(needed.sel(current_profile="linear", counted="one cylinder")),
        "surface_all": float(needed.sel(current_profile="exponential 50 m", counted="all cylinders")),
    }


def varied(variants: xr.Dataset) -> dict[str, Any]:
    """Relative change of the moment in variants of the scene at 5 and 10 s; moment at another length (kN m).

    With the printed damping: the largest change, its period (s), and the change of the curvature there. The
    moment is E I (k + tau dk/dt), in periodic motion sqrt(1 + (w tau)^2) times the elastic moment.
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
        "shorter": float(moment.sel(variant="533 m to the upper flex joint", roll_period=10.0)) / 1e3,
    }


def heave_compared(heave: xr.Dataset, upright: xr.Dataset) -> dict[str, Any]:
    """Amplitude of the axial force at the bottom (kN), with cylinders in space and with upright cylinders."""
    swing = half_swing(upright["effective_tension"].isel(s=0), HEAVE_PERIOD)
    at = heave["axial_force_amplitude"].sel(heave_amplitude=2.0, heave_period=HEAVE_PERIOD)
    return {"space": float(at) / 1e3, "upright": float(swing.squeeze()) / 1e3}


def left_out(roll: xr.Dataset, heave: xr.Dataset) -> dict[str, Any]:
    """Relative change of roll moment by the pistons' mass, and of axial force under heave by losses."""
    swing = half_swing(heave["effective_tension"].isel(s=0), HEAVE_PERIOD)
    lossless = swing.sel(losses="none")
    changes = {
        name: float(swing.sel(losses=of) / lossless - 1.0)
        for name, of in (("small", "967 N s/m a cylinder"), ("large", "10 kN s/m a cylinder"))
    }
    facts = varied(roll)
    return changes | {name: facts[name] for name in ("pistons", "pistons_slow")}


def baselines(readings: xr.Dataset, surge: xr.Dataset, smaller: Word, later: Word) -> dict[str, Any]:
    """Shares of samples in which the static (Q2) and dynamic claims (Q8, Q9) are true, by baseline.

    Also named are the baselines with which both Q2 and Q8 are almost always true.
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
    sentences = [_true_with(claim, each) for claim, each in shares.items()]
    share = f"in at least {100 * ALMOST_ALWAYS:.0f} % of the samples"
    sentence = f"With {listed(f'“{model}”' for model in both)}, both Q2 and Q8 are true {share}."
    if not both:
        sentence = f"No definition makes both Q2 and Q8 true {share}."
    return {"shares": " ".join(sentences), "both": sentence}


def _true_with(claim: str, shares: dict[str, float]) -> str:
    """The share of samples in which a claim is true with each definition of the riser without tensioners."""
    true = [f"“{model}”" for model, share in shares.items() if share > 0.0]
    found = [f"{100 * share:.0f} %" for share in shares.values() if share > 0.0]
    if not true:
        return f"Claim {claim} is true in no sample."
    only = "" if len(true) == len(shares) else "only "
    noun, these = ("definition", "this") if len(true) == 1 else ("definitions", "these")
    named = f"Claim {claim} is true {only}with the {noun} {listed(true)}"
    return f"{named}, in {listed(found)} of the samples with {these} {noun}."


def waves_on_the_riser(waves: xr.Dataset) -> dict[str, Any]:
    """Ratio of the stress amplitude with waves on the riser to the amplitude by platform motion alone.

    Results are the least and the largest ratio over wave periods with their periods (s), and the largest
    difference (%) between the interpretations of the waves above the mean level.
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
    """Stress of the printed moment (MPa), as an amplitude and as a peak-to-peak range."""
    return {
        "moment": float(largest_moment(roll, 4.0, 10.0).value),
        "amplitude": 32.8e3 / SECTION_MODULUS / 1e6,
        "range": 2.0 * 32.8e3 / SECTION_MODULUS / 1e6,
    }


def peaks(roll: xr.Dataset) -> dict[str, Any]:
    """Periods (s) at which the largest moment has peaks, for a roll of 4 degrees."""
    moment = roll["largest_bending_moment"].sel(roll_amplitude=4.0)
    values, period = moment.values, moment["roll_period"].values
    inside = (values[1:-1] > values[:-2]) & (values[1:-1] > values[2:])
    return {"peaks": listed(f"{x:g} s" for x in period[1:-1][inside])}
