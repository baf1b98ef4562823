"""Smallest clearance of a riser that was disconnected, from the history of its lift."""

from __future__ import annotations

import numpy as np

from riserstudy.records.arrays import FloatArray

TOUCHING = 1e-6  # distance that counts as contact with the stack or an end of the stroke (m)
SETTLED = 1e-3  # share of its lift within which a lower end at rest may move


def lowest_after_rise(time: FloatArray, lift: FloatArray) -> int | None:
    """Index of the smallest lift after its first maximum; None if it is not known.

    It is not known if the lower end never lifts off, or still rises or falls at the end. It counts as at rest
    there if, in the second half of the times, the lift is constant within ``SETTLED`` of it.

    Parameters
    ----------
    time : times after the release (s), (times,).
    lift : height of the lower end above the stack (m), (times,).
    """
    falls = np.flatnonzero((np.diff(lift) < 0.0) & (lift[:-1] > TOUCHING))
    if not len(falls):
        return None
    lowest = int(falls[0]) + int(lift[falls[0] :].argmin())
    if lowest == len(lift) - 1 and lift[lowest] > TOUCHING:
        late = lift[time >= 0.5 * (time[0] + time[-1])]
        if np.ptp(late) > SETTLED * lift[lowest]:
            return None
    return lowest
