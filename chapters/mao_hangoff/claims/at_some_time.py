"""Mao, Zeng, Liu: printed numbers where the time of a figure, or the phase of the heave, is not printed.

Fig 9 is at 130 s, but the phase of the heave at that time is unspecified. Fig 10 states no time. Numbers
are judged twice: with both figures at 130 s, and with the best-fitting time of Fig 10 and phase of the heave.
"""

from __future__ import annotations

import xarray as xr

from chapters.mao_hangoff.runs import STATED, distance, moments_over_time
from chapters.mao_hangoff.towed import displacement
from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import below

CYCLE = 10.0  # s, period of the heave; a phase of the heave is a time within it
SOME_TIME = (100.0, 200.0)  # s, range of possible times of Fig 10
STRICT, FREE = "all at 130 s", "Fig 10 from 100 to 200 s, any phase of the heave"


def lmrp_distance(runs: xr.Dataset, lmrp_mass: float) -> Found:
    """Distance (m) of Fig 9, which is at 130 s, for an LMRP mass (t)."""
    away = distance(runs).sel(lmrp_mass=lmrp_mass, drop=True)
    return Found(_either(away, away))


def distance_of_fig10(runs: xr.Dataset, lmrp_mass: float, printed: float) -> Found:
    """Distance (m) at 130 s, or the distance nearest to the printed one within the times of Fig 10."""
    away = distance(runs).sel(lmrp_mass=lmrp_mass, drop=True)
    return Found(_either(away, _nearest(_distances(runs, lmrp_mass), printed)))


def moment_of_fig9(runs: xr.Dataset, lmrp_mass: float, printed: float) -> Found:
    """Largest moment (kN m) at 130 s, or the one nearest to the printed moment within a heave cycle."""
    cycle = _over_a_cycle(runs, lmrp_mass)
    return Found(_either(cycle.isel(time=-1, drop=True), _nearest(cycle, printed)))


def numbers_at_some_time(runs: xr.Dataset, heavy: float, light: float, moment: float, within: float) -> Found:
    """One interpretation meets all numbers, one at some time, one at some phase; value: largest error."""
    pairs = [
        (distance(runs).sel(lmrp_mass=140.0, drop=True), heavy),
        (_nearest(_distances(runs, 120.0), light), light),
        (_nearest(_over_a_cycle(runs, 140.0), moment), moment),
    ]
    worst = xr.concat([abs(found / printed - 1.0) for found, printed in pairs], "number")
    worst = worst.max("number")
    return judged(worst, below(worst, within))


def _either(strict: xr.DataArray, free: xr.DataArray) -> xr.DataArray:
    """Values in both interpretations of the time at which numbers are taken."""
    return xr.concat([strict, free], xr.DataArray([STRICT, FREE], dims="when", name="when"))


def _distances(runs: xr.Dataset, lmrp_mass: float) -> xr.DataArray:
    """Distance (m) over the possible times of Fig 10."""
    away = abs(displacement(runs)).sel(lmrp_mass=lmrp_mass, drop=True).isel(s=0, drop=True)
    return away.sel(time=slice(*SOME_TIME))


def _over_a_cycle(runs: xr.Dataset, lmrp_mass: float) -> xr.DataArray:
    """Largest moment along the riser (kN m), over the heave cycle that ends at the stated time."""
    moment = moments_over_time(runs).sel(lmrp_mass=lmrp_mass, drop=True)
    return moment.sel(time=slice(STATED - CYCLE, STATED)).max("s") / 1e3


def _nearest(values: xr.DataArray, printed: float) -> xr.DataArray:
    """Value nearest to the printed one, between the least and the largest value over time."""
    low, high = values.min("time"), values.max("time")
    nearest = low.where(low > printed, high.where(high < printed, printed))
    return nearest.where(low.notnull())
