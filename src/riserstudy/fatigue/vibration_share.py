"""Share of vortex-induced vibration in the damage over years, from a study with it and a study without it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from riserstudy.errors import InputError
from riserstudy.fatigue.years import Worst, Years


class Share(NamedTuple):
    """A detail at the place where its damage with vibration is largest."""

    of: Worst
    without: float  # damage there without vibration (1/year), unfactored
    largest_without: float  # damage without vibration where that is largest (1/year)

    @property
    def share(self) -> float:
        """Share of vibration in the damage at the place (1); negative if vibration reduces damage."""
        return 1.0 - self.without / self.of.rate if self.of.rate > 0.0 else math.nan


def shares(years: Years, without: Years) -> list[Share]:
    """Share of vibration in the damage of each detail that both studies have.

    Damage is compared at one place of the riser and its wall; without vibration, the largest damage may be
    elsewhere. ``without``: damage in the same sea states and currents; its places along the riser may differ.
    Raises InputError when the studies cannot be compared: vibration in the second one, or none in the first
    one, no common detail, other places around the wall, or other curves, places or factors of a detail.
    """
    _check(years, without)
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


def _check(years: Years, without: Years) -> None:
    """Refuse studies that cannot be compared."""
    common = {of.detail for of in years.worst} & {of.detail for of in without.worst}
    same = years.rates.shape[1] == without.rates.shape[1]
    own, others = ({of.name: of for of in each.details} for each in (years, without))
    unlike = [name for name in own if name in others and own[name] != others[name]]
    faults = {
        "is simulated with vortex-induced vibration": any(sea.vibrates for sea in without.seas),
        "the second study has no fatigue detail of the first study": not common,
        "the studies have different numbers of fatigue.angles": not same,
        f"the studies have different curves, places or factors of {', '.join(unlike)}": unlike,
    }
    allowed = "give a dataset of the same study with `riser[*].viv: null`"
    for found, there in faults.items():
        if there:
            raise InputError("fatigue", "--without", found, allowed)
    if not any(sea.vibrates for sea in years.seas):
        found = "the first study has no vortex-induced vibration in these sea states"
        raise InputError("fatigue", "--without", found, "omit --without")
