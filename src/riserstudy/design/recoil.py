"""Emergency disconnects judged: lift, clearance, what comes down again, what runs out of stroke."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
TOUCHING = 1e-6  # contact, with the stack or a stop (m)


class Outcome(NamedTuple):
    """What points did after their release, (points,) each."""

    lift: FloatArray  # largest (m)
    clearance: FloatArray  # smallest from the first height on (m); NaN: rises to the end
    recontact: NDArray[np.bool_]  # comes down on the stack again, or never leaves it
    shortest: FloatArray  # reach of the cylinders from mid-stroke (m)
    stroked_out: NDArray[np.bool_]  # touches an end of the stroke


def outcome(lift: FloatArray, reach: FloatArray, ends: tuple[float, float]) -> Outcome:
    """Judge histories.

    Parameters
    ----------
    lift : of the lower end above the stack (m), (points, times); zero until the release.
    reach : of the cylinder that goes farthest, from mid-stroke (m), (points, times).
    ends : of the stroke (m), shortest and longest.
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
    """Where the lift, once it has begun, falls for the first time; the end where it never does."""
    falls = np.flatnonzero((np.diff(lift) < 0.0) & (lift[:-1] > TOUCHING))
    return int(falls[0]) if len(falls) else len(lift) - 1


class Limits(NamedTuple):
    """Settings that an analysis of recoil allows (N); NaN where none does.

    Each lies between two settings of the grid: what was tried and serves, and what was tried and does not.
    """

    smallest: float  # of all that serve
    below: float  # the next one below it, which comes down again; NaN: none was tried
    largest: float  # of all that serve
    above: float  # the next one above it, which runs out of stroke; NaN: none was tried


def limits(
    setting: FloatArray, recontact: NDArray[np.bool_], stroked_out: NDArray[np.bool_]
) -> Limits:
    """Smallest and largest of rising settings (N), (settings,), that neither come down nor stroke out."""
    serves = np.flatnonzero(~recontact & ~stroked_out)
    if not len(serves):
        return Limits(*[float("nan")] * 4)
    low, high = int(serves[0]), int(serves[-1])
    below = float(setting[low - 1]) if low > 0 else float("nan")
    above = float(setting[high + 1]) if high + 1 < len(setting) else float("nan")
    return Limits(float(setting[low]), below, float(setting[high]), above)
