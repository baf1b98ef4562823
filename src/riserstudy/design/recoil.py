"""Evaluation of emergency disconnects: lift, clearance, re-contact, stroke-out."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.study.spacing import stretches

FloatArray = NDArray[np.float64]
TOUCHING = 1e-6  # distance that counts as contact with the stack or a stop (m)


class Outcome(NamedTuple):
    """Results after the release, (points,) each."""

    lift: FloatArray  # largest (m)
    clearance: FloatArray  # smallest lift after its first maximum (m); NaN: it increases to the end
    recontact: NDArray[np.bool_]  # whether the lower end re-contacts the stack, or never leaves it
    shortest: FloatArray  # smallest reach of the cylinders from mid-stroke (m)
    stroked_out: NDArray[np.bool_]  # whether a cylinder reaches an end of its stroke


def outcome(lift: FloatArray, reach: FloatArray, ends: tuple[float, float]) -> Outcome:
    """Evaluate histories.

    Parameters
    ----------
    lift : height of the lower end above the stack (m), (points, times); zero until the release.
    reach : reach of the cylinder with the largest motion, from mid-stroke (m), (points, times).
    ends : ends of the stroke (m), shortest and longest.
    """
    highest = np.array([_first_height(row) for row in lift])
    after = np.arange(lift.shape[1]) >= highest[:, None]
    clearance = np.where(after, lift, np.inf).min(axis=1)
    clearance[highest >= lift.shape[1] - 1] = np.nan
    most = lift.max(axis=1)
    recontact = (clearance < TOUCHING) | (most < TOUCHING)
    shortest, longest = reach.min(axis=1), reach.max(axis=1)
    out = (shortest < ends[0] - TOUCHING) | (longest > ends[1] + TOUCHING)
    return Outcome(most, clearance, recontact, shortest, out)


def _first_height(lift: FloatArray) -> int:
    """Index at which the lift first decreases after it has begun; the end if it never does."""
    falls = np.flatnonzero((np.diff(lift) < 0.0) & (lift[:-1] > TOUCHING))
    return int(falls[0]) if len(falls) else len(lift) - 1


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
