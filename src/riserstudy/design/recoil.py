"""Evaluation of emergency disconnects: lift, clearance, re-contact, stroke-out."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.clearance import TOUCHING, lowest_after_rise
from riserstudy.records.arrays import FloatArray
from riserstudy.study.spacing import stretches


class Outcome(NamedTuple):
    """Results after the release, (points,) each."""

    lift: FloatArray  # largest (m)
    clearance: FloatArray  # smallest lift after its first maximum (m); NaN: the lower end never lifts off
    recontact: NDArray[np.bool_]  # whether the lower end re-contacts the stack, or never leaves it
    shortest: FloatArray  # smallest reach of the cylinders from mid-stroke (m)
    stroked_out: NDArray[np.bool_]  # whether a cylinder reaches an end of its stroke


def outcome(time: FloatArray, lift: FloatArray, reach: FloatArray, ends: tuple[float, float]) -> Outcome:
    """Evaluate histories.

    Parameters
    ----------
    time : times (s), (times,).
    lift : height of the lower end above the stack (m), (points, times); zero until the release.
    reach : reach of the cylinder with the largest motion, from mid-stroke (m), (points, times).
    ends : ends of the stroke (m), shortest and longest.

    Raises
    ------
    ValueError : a lower end still rises or falls at the end, so that a later re-contact is not excluded.
    """
    clearance = np.array([_clearance(time, row) for row in lift])
    most = lift.max(axis=1)
    unknown = np.flatnonzero(np.isnan(clearance) & (most > TOUCHING))
    if len(unknown):
        raise ValueError(
            f"recoil: in {len(unknown)} of {len(lift)} runs (the first is run {unknown[0]}), the lower end "
            "still moves at the end of the run, so re-contact is not excluded; increase analysis.duration"
        )
    recontact = (clearance < TOUCHING) | (most < TOUCHING)
    shortest, longest = reach.min(axis=1), reach.max(axis=1)
    out = (shortest < ends[0] - TOUCHING) | (longest > ends[1] + TOUCHING)
    return Outcome(most, clearance, recontact, shortest, out)


def _clearance(time: FloatArray, lift: FloatArray) -> float:
    """Smallest lift (m) of one run after its first maximum; NaN if it is not known."""
    after = lift > 0.0
    if not after.any():
        return float("nan")
    start = int(after.argmax())
    lowest = lowest_after_rise(time[start:], lift[start:])
    return float("nan") if lowest is None else float(lift[start + lowest])


class Limits(NamedTuple):
    """Settings that an analysis of recoil allows (N); NaN if none is allowed.

    Each limit is between two settings of the grid, one that is allowed and one that is not.
    """

    smallest: float  # smallest allowed setting
    below: float  # the next smaller setting, which is not allowed; NaN: none was tried
    largest: float  # largest allowed setting
    above: float  # the next larger setting, which is not allowed; NaN: none was tried


def limits(setting: FloatArray, recontact: NDArray[np.bool_], stroked_out: NDArray[np.bool_]) -> Limits:
    """Smallest and largest of increasing settings (N), (settings,), without re-contact and stroke-out.

    All settings between the two are allowed, too. If the allowed settings form several ranges, with settings
    in between that are not allowed, the result is the widest range.
    """
    serves = ~recontact & ~stroked_out
    ranges = stretches(serves, np.ones(len(serves) - 1, bool))
    if not len(ranges):
        return Limits(*[float("nan")] * 4)
    low, after = ranges[np.argmax(setting[ranges[:, 1] - 1] - setting[ranges[:, 0]])]
    below = float(setting[low - 1]) if low > 0 else float("nan")
    above = float(setting[after]) if after < len(setting) else float("nan")
    return Limits(float(setting[low]), below, float(setting[after - 1]), above)
