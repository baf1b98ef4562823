"""Mao, Zeng, Liu: printed numbers where the time of a figure, or the phase of the heave, is not printed.

Fig 9 is of 130 s, which is some phase of a heave whose phase is open; Fig 10 has no time. Numbers are judged
with both at 130 s, and with the time of Fig 10 and the phase of the heave as what they have to be.
"""

from __future__ import annotations

import xarray as xr

from chapters.mao_hangoff.runs import STATED, distance, moments_over_time
from chapters.mao_hangoff.towed import displacement
from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import below

CYCLE = 10.0  # s, the heave's period; the moment at a phase is that at a time within it
SOME_TIME = (100.0, 200.0)  # s, of Fig 10
STRICT, FREE = "all at 130 s", "Fig 10 from 100 to 200 s, any phase of the heave"


def lmrp_distance(runs: xr.Dataset, lmrp_mass: float) -> Found:
    """Distance (m) of Fig 9, which is of 130 s, with an LMRP of a mass (t)."""
    away = distance(runs).sel(lmrp_mass=lmrp_mass, drop=True)
    return Found(_either(away, away))


def distance_of_fig10(runs: xr.Dataset, lmrp_mass: float, printed: float) -> Found:
    """Distance (m) at 130 s, or that of the times of Fig 10 which is nearest to the printed one."""
    away = distance(runs).sel(lmrp_mass=lmrp_mass, drop=True)
    return Found(_either(away, _nearest(_distances(runs, lmrp_mass), printed)))


def moment_of_fig9(runs: xr.Dataset, lmrp_mass: float, printed: float) -> Found:
    """Largest moment (kN m) at 130 s, or that of the heave's cycle which is nearest to the printed one."""
    cycle = _over_a_cycle(runs, lmrp_mass)
    return Found(_either(cycle.isel(time=-1, drop=True), _nearest(cycle, printed)))


def numbers_at_some_time(
    runs: xr.Dataset, heavy: float, light: float, moment: float, within: float
) -> Found:
    """One reading has all numbers, one at some time, one at some phase; value: worst miss."""
    pairs = [
        (distance(runs).sel(lmrp_mass=140.0, drop=True), heavy),
        (_nearest(_distances(runs, 120.0), light), light),
        (_nearest(_over_a_cycle(runs, 140.0), moment), moment),
    ]
    worst = xr.concat([abs(found / printed - 1.0) for found, printed in pairs], "number")
    worst = worst.max("number")
    return judged(worst, below(worst, within))


def _either(strict: xr.DataArray, free: xr.DataArray) -> xr.DataArray:
    """Both interpretations of when numbers are read."""
    return xr.concat([strict, free], xr.DataArray([STRICT, FREE], dims="when", name="when"))


def _distances(runs: xr.Dataset, lmrp_mass: float) -> xr.DataArray:
    """Distance (m) over the times that Fig 10 may be of."""
    away = abs(displacement(runs)).sel(lmrp_mass=lmrp_mass, drop=True).isel(s=0, drop=True)
    return away.sel(time=slice(*SOME_TIME))


def _over_a_cycle(runs: xr.Dataset, lmrp_mass: float) -> xr.DataArray:
    """Largest moment (kN m) over the cycle of the heave that ends at the stated time."""
    moment = moments_over_time(runs).sel(lmrp_mass=lmrp_mass, drop=True)
    return moment.sel(time=slice(STATED - CYCLE, STATED)).max("s") / 1e3


def _nearest(values: xr.DataArray, printed: float) -> xr.DataArray:
    """The value nearest to a printed one of all that are passed in time."""
    low, high = values.min("time"), values.max("time")
    nearest = low.where(low > printed, high.where(high < printed, printed))
    return nearest.where(low.notnull())
