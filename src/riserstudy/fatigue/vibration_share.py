"""How much of the damage over years vortex-induced vibration brings, by a study with it and one without."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.fatigue.years import Worst, Years

Array = NDArray[np.float64]


class Share(NamedTuple):
    """A detail at the place where its damage with vibration is largest."""

    of: Worst
    without: float  # damage there without vibration (1/year), unfactored
    largest_without: float  # damage without vibration where that is largest (1/year)

    @property
    def share(self) -> float:
        """Of the damage at the place: what vibration brings (1); negative where vibration saves damage."""
        return 1.0 - self.without / self.of.rate if self.of.rate > 0.0 else math.nan


def shares(years: Years, without: Years) -> list[Share]:
    """What vibration brings at each detail that both studies have.

    Damage is compared at one place of the riser and its wall; without vibration it may be largest elsewhere.

    Parameters
    ----------
    without : of the same sea states and currents; its places along the riser may be others.
    """
    at_rest = {of.detail: k for k, of in enumerate(without.worst)}
    found = []
    for of in years.worst:
        if of.detail not in at_rest:
            continue
        k = at_rest[of.detail]
        angle = round(of.angle * without.rates.shape[1] / 360.0) % without.rates.shape[1]
        rates = without.rates[k, angle]
        known = np.isfinite(rates)
        there = float(np.interp(of.s, without.s[known], rates[known]))
        found.append(Share(of, there, without.worst[k].rate))
    return found
