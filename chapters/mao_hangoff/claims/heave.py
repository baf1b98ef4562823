"""Mao, Zeng, Liu: results against which claims on axial motion, Figs 9d to 14c, are checked.

a is the amplitude of axial motion at the period of the heave. The rise is the largest height of a curve above
its elevation on the riser that hangs in still water; it includes the mean level and the amplitude. Where the
text describes curves as "stretched", its word amplitude means this rise.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr

from chapters.mao_hangoff.hanging import largest_rise
from chapters.mao_hangoff.runs import at_angle, last_over_first, with_printed_lmrp
from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import above, everywhere
from riserstudy.grading.word_of_size import Word
from riserstudy.grading.yardstick import alike, all_along, all_of, growing, more

SETTLED = 70.0  # s, time at which every ramp of the heave has ended
STEADY = 0.9  # least share of motion at the heave's period that counts as one frequency
FIRST = 40.0  # s, end of the first phase, the second time of Fig 9c


def one_frequency(heave: xr.Dataset, depths: list[float]) -> Found:
    """The heave's period explains 90 % of the motion at all depths; value: the smallest share."""
    share = harmonic(with_printed_lmrp(_z_at(heave, depths)), heave)["share"].min("depth")
    return judged(share, above(share, STEADY))


def amplitude_grows_with_depth(heave: xr.Dataset, depths: list[float], increases: Word) -> Found:
    """Amplitude a increases with depth; value: ratio of the deepest to the first."""
    a = harmonic(with_printed_lmrp(_z_at(heave, depths)), heave)["amplitude"]
    ratio = a.isel(depth=-1, drop=True) / a.isel(depth=0, drop=True)
    return judged(ratio, growing(a, "depth", increases))


def level_rises(heave: xr.Dataset, depth: float) -> Found:
    """The mean level at a depth rises while the riser trails; value: rate (m per minute)."""
    fit = harmonic(with_printed_lmrp(_z_at(heave, [depth])), heave).isel(depth=0, drop=True)
    rate = 60.0 * fit["drift"]
    return judged(rate, above(rate, 0.0, over=fit["amplitude"]))


def amplitude_follows(heave: xr.Dataset, axis: str, sign: float, change: Word) -> Found:
    """Amplitude a of the LMRP increases or decreases along an axis, at one frequency; value: last / first."""
    fit = lmrp_motion(heave)
    steady = everywhere(above(fit["share"], STEADY), axis)
    a = fit["amplitude"]
    return judged(last_over_first(a, axis), all_of(growing(a, axis, change, sign), steady))


def amplitude_hardly_changes(heave: xr.Dataset, axis: str, small: Word) -> Found:
    """Amplitude a of the LMRP changes little along an axis; value: last / first."""
    return _hardly_changes(lmrp_motion(heave)["amplitude"], axis, small)


def rise_follows(heave: xr.Dataset, axis: str, sign: float, change: Word) -> Found:
    """The LMRP's largest rise increases or decreases along an axis; value: last / first."""
    rise = largest_rise(heave)
    return judged(last_over_first(rise, axis), growing(rise, axis, change, sign))


def rise_hardly_changes(heave: xr.Dataset, axis: str, small: Word) -> Found:
    """The LMRP's largest rise changes little along an axis; value: last / first."""
    return _hardly_changes(largest_rise(heave), axis, small)


def _hardly_changes(values: xr.DataArray, axis: str, small: Word) -> Found:
    first, last = (values.isel({axis: end}, drop=True) for end in (0, -1))
    return judged(last / first, alike(last, first, small))


def lows_deeper_at_first(heave: xr.Dataset, depths: list[float], lower: Word) -> Found:
    """In the first phase, depths sink farther below their start than the top; value: least ratio."""
    z = with_printed_lmrp(_z_at(heave, [0.0, *depths]))
    fallen = (z.isel(time=0) - z.sel(time=slice(0.0, FIRST))).max("time")
    deep, top = fallen.sel(depth=depths), fallen.sel(depth=0.0, drop=True)
    deeper = all_along(more(deep, top, lower), "depth")
    return judged((deep / top).min("depth"), deeper)


def amplitude_largest_at_0_degrees(heave: xr.Dataset, considerably: Word) -> Found:
    """The LMRP's amplitude a is considerably larger at 0 deg than at 45 and 90 deg; value: 90 / 0 deg."""
    return largest_at_0_degrees(lmrp_motion(heave)["amplitude"], considerably)


def rise_largest_at_0_degrees(heave: xr.Dataset, considerably: Word) -> Found:
    """The LMRP's largest rise is considerably larger at 0 deg than at 45 and 90 deg; value: 90 / 0 deg."""
    return largest_at_0_degrees(largest_rise(heave), considerably)


def largest_at_0_degrees(values: xr.DataArray, considerably: Word) -> Found:
    """Values at 0 deg are considerably larger than at 45 and 90 deg; value: 90 / 0 deg."""
    at0, at45, at90 = (at_angle(values, angle) for angle in (0, 45, 90))
    return judged(at90 / at0, all_of(more(at0, at45, considerably), more(at0, at90, considerably)))


def _z_at(heave: xr.Dataset, depths: list[float]) -> xr.DataArray:
    """Elevation at depths below the joint (m), over ``depth``."""
    z = heave["z"]
    s = xr.DataArray(float(z["s"][-1]) - np.array(depths), dims="depth", coords={"depth": depths})
    return z.sel(s=s, method="nearest").drop_vars("s")


def lmrp_motion(heave: xr.Dataset) -> xr.Dataset:
    """Amplitude (m), drift (m/s) and share of the LMRP's motion at the heave's period."""
    return harmonic(heave["z"].isel(s=0, drop=True), heave)


def harmonic(z: xr.DataArray, heave: xr.Dataset) -> xr.Dataset:
    """Amplitude (m) at the heave's period, drift (m/s), and the share of the motion at this period.

    Least-squares fit with a quadratic drift: amplitude and share exclude the slow change of level.
    """
    z = z.sel(time=slice(SETTLED, None))
    t = z["time"] - float(z["time"][0])
    period = _period(heave)

    def fit(z: Any, period: Any) -> tuple[float, float, float]:
        w = 2.0 * np.pi / period
        slow = np.stack([np.ones_like(t), t, t.values**2], axis=1)
        terms = np.concatenate([slow, np.cos(w * t.values)[:, None], np.sin(w * t.values)[:, None]], 1)
        fitted = np.linalg.lstsq(terms, z, rcond=None)[0]
        wave = z - slow @ fitted[:3]
        left = z - terms @ fitted
        share = 1.0 - float(left @ left) / float(wave @ wave)
        drift = float((slow[-1] - slow[0]) @ fitted[:3]) / float(t[-1])
        return float(np.hypot(*fitted[3:])), drift, share

    amplitude, drift, share = xr.apply_ufunc(
        fit, z, period, input_core_dims=[["time"], []], output_core_dims=[[], [], []], vectorize=True
    )
    return xr.Dataset({"amplitude": amplitude, "drift": drift, "share": share})


def _period(heave: xr.Dataset) -> xr.DataArray:
    """Period of the platform's heave (s): the sampled period, or else the period of the scene."""
    if "assumed_platform_heave_period" in heave:
        texts = heave["assumed_platform_heave_period"]
        return texts.copy(data=[float(str(text).split()[0]) for text in texts.values])
    scene = json.loads(heave.attrs["scene"])
    return xr.DataArray(float(scene["platform"]["heave"]["period"].split()[0]))
