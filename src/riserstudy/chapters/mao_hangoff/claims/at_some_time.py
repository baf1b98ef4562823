"""Mao, Zeng, Liu: printed numbers where the time of a figure, or the phase of the heave, is not printed."""

from __future__ import annotations

import xarray as xr

from riserstudy.chapters.mao_hangoff.runs import STATED, distance, moments_over_time
from riserstudy.chapters.mao_hangoff.towed import displacement
from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import below

CYCLE = 10.0  # s, the heave's period; the moment at a phase is that at a time within it
SOME_TIME = (100.0, 200.0)  # s, of Fig 10


def distance_at_some_time(runs: xr.Dataset, light: float, within: float) -> Found:
    """With an LMRP of 120 t the distance passes a number; value: the distance nearest to it (m)."""
    away = _distances(runs)
    miss = abs(away / light - 1.0)
    # no axis has gaps: every cell has all times
    nearest = away.isel(time=miss.argmin("time"), drop=True)
    return judged(nearest.drop_vars("time", errors="ignore"), below(miss.min("time"), within))


def moment_at_some_phase(runs: xr.Dataset, moment: float, within: float) -> Found:
    """Over a cycle of the heave the largest moment passes a number; value: its mean over the cycle (kN m)."""
    size = _over_a_cycle(runs)
    return judged(size.mean("time"), below(_passed(size, moment), within))


def numbers_at_some_time(
    runs: xr.Dataset, heavy: float, light: float, moment: float, within: float
) -> Found:
    """One reading has all numbers, one at some time, one at some phase; value: worst miss."""
    misses = [
        abs(distance(runs).sel(lmrp_mass=140.0, drop=True) / heavy - 1.0),
        abs(_distances(runs) / light - 1.0).min("time"),
        _passed(_over_a_cycle(runs), moment),
    ]
    worst = xr.concat(misses, "number").max("number")
    return judged(worst, below(worst, within))


def _distances(runs: xr.Dataset) -> xr.DataArray:
    """Distance (m) of an LMRP of 120 t over the times that Fig 10 may be of."""
    away = abs(displacement(runs)).sel(lmrp_mass=120.0, drop=True).isel(s=0, drop=True)
    return away.sel(time=slice(*SOME_TIME))


def _over_a_cycle(runs: xr.Dataset) -> xr.DataArray:
    """Largest moment (kN m) with an LMRP of 140 t over the cycle that ends at the stated time."""
    moment = moments_over_time(runs).sel(lmrp_mass=140.0, drop=True)
    return moment.sel(time=slice(STATED - CYCLE, STATED)).max("s") / 1e3


def _passed(size: xr.DataArray, number: float) -> xr.DataArray:
    """By what share a number lies outside of the range over time; zero inside."""
    low, high = size.min("time"), size.max("time")
    outside: xr.DataArray = xr.where(number < low, low / number - 1.0, 1.0 - high / number)
    return outside.clip(0.0)
