"""Mao, Zeng, Liu: results against which its numbers and claims on shape and moment are checked.

x is the LMRP's distance from the platform along the track, and M is the largest moment, both at 130 s. a is
the amplitude of axial motion at the period of the heave.
"""

from __future__ import annotations

import xarray as xr

from chapters.mao_hangoff.claims.heave import lmrp_motion
from chapters.mao_hangoff.hanging import largest_rise
from chapters.mao_hangoff.runs import (
    PRINTED,
    STATED,
    at_angle,
    distance,
    halves,
    largest,
    last_over_first,
    misses_of_print,
    moments,
    with_printed_lmrp,
)
from chapters.mao_hangoff.towed import displacement
from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import above, below, everywhere, least, rising
from riserstudy.grading.word_of_size import Word
from riserstudy.grading.yardstick import all_of, growing, less, more

SURFACE_ZONE = 150.0  # m below the joint, where C_D is large
TIMES = [10.0, 40.0, 70.0, 100.0, 130.0]  # s, of Fig 9c
NEARLY = 0.99  # share of the largest value that counts as the largest


# printed numbers


def all_numbers(runs: xr.Dataset, heavy: float, light: float, moment: float, within: float) -> Found:
    """One interpretation meets the three numbers within a share; value: its largest error."""
    misses = misses_of_print(runs, heavy, light, moment)
    worst = xr.concat([misses[name] for name in PRINTED], "number").max("number")
    return judged(worst, below(worst, within))


# Fig 9: the base case


def grows_with_depth(runs: xr.Dataset, same: Word) -> Found:
    """Distance increases with depth at 130 s, except negligible decreases; value: x / largest distance."""
    away = abs(with_printed_lmrp(displacement(runs))).sel(time=STATED, drop=True)
    largest_above = away.sortby("s", ascending=False).rolling(s=away.sizes["s"], min_periods=1).max()
    short = (largest_above - away) / away.max("s")
    return judged(away.isel(s=0, drop=True) / away.max("s"), everywhere(below(short, same.bound), "s"))


def upright_at_the_lmrp(runs: xr.Dataset, at_most: float) -> Found:
    """The slope over the lowest 50 m is much smaller than the mean slope; value: their ratio."""
    away = abs(with_printed_lmrp(displacement(runs))).sel(time=STATED, drop=True)
    lowest = (away.isel(s=0, drop=True) - away.interp(s=50.0).drop_vars("s")) / 50.0
    mean = away.isel(s=0, drop=True) / (float(away["s"][-1]) - float(away["s"][0]))
    return judged(lowest / mean, below(lowest, at_most * mean))


def steep_near_the_surface(runs: xr.Dataset, depth: float, steeper: Word) -> Found:
    """The mean slope down to a depth (m) exceeds the mean slope of the riser; value: their ratio."""
    away = abs(with_printed_lmrp(displacement(runs))).sel(time=STATED, drop=True)
    top = float(away["s"][-1])
    near = away.interp(s=top - depth).drop_vars("s") / depth
    mean = away.isel(s=0, drop=True) / (top - float(away["s"][0]))
    return judged(near / mean, more(near, mean, steeper))


def moment_at_the_top(runs: xr.Dataset) -> Found:
    """M occurs in the surface zone; value: depth of M below the joint (m)."""
    moment = with_printed_lmrp(moments(runs))
    depth = float(moment["s"][-1]) - moment.idxmax("s")
    return judged(depth, below(depth, SURFACE_ZONE))


def small_below(runs: xr.Dataset, depth: float, at_most: float) -> Found:
    """Moments below a depth (m) are small; value: ratio of the largest there to M."""
    moment = with_printed_lmrp(moments(runs))
    deeper = moment.where(moment["s"] < float(moment["s"][-1]) - depth).max("s")
    share = deeper / moment.max("s")
    return judged(share, below(share, at_most))


def grows_in_time(runs: xr.Dataset, at_most: float) -> Found:
    """Distance x increases from time to time of Fig 9c and is small at first; value: first / last."""
    x = abs(with_printed_lmrp(displacement(runs))).sel(time=TIMES).isel(s=0, drop=True)
    first = x.isel(time=0, drop=True) / x.isel(time=-1, drop=True)
    return judged(first, least(rising(x, "time"), below(first, at_most)))


def lower_half_moves_more(runs: xr.Dataset) -> Found:
    """The LMRP is farthest at all times, the lower half farther than the upper; value: ratio at 130 s."""
    away = abs(with_printed_lmrp(displacement(runs))).sel(time=TIMES)
    lower, upper = halves(away)
    farthest = above(away.isel(s=0, drop=True), NEARLY * away.max("s"))
    ratio = lower / upper
    margin = everywhere(least(farthest, above(ratio, 1.0)), "time")
    return judged(ratio.isel(time=-1, drop=True), margin)


# Figs 10 to 14: effects of the inputs


def distance_and_moment_follow(runs: xr.Dataset, axis: str, sign: float, change: Word) -> Found:
    """Both x and M increase (sign 1) or decrease (-1) along an axis; value: last x / first."""
    x, m = distance(runs), largest(runs)
    both = all_of(*(growing(values, axis, change, sign) for values in (x, m)))
    return judged(last_over_first(x, axis), both)


def distance_follows(runs: xr.Dataset, axis: str, sign: float, change: Word) -> Found:
    """Distance x increases or decreases along an axis; value: last / first."""
    x = distance(runs)
    return judged(last_over_first(x, axis), growing(x, axis, change, sign))


def moment_follows(runs: xr.Dataset, axis: str, sign: float, change: Word) -> Found:
    """M increases or decreases along an axis; value: last / first."""
    m = largest(runs)
    return judged(last_over_first(m, axis), growing(m, axis, change, sign))


def top_moment_follows(runs: xr.Dataset, axis: str, sign: float, change: Word) -> Found:
    """M increases or decreases along an axis, and is near the top everywhere on it; value: last / first."""
    over_s = moments(runs)
    m = over_s.max("s")
    depth = float(over_s["s"][-1]) - over_s.idxmax("s")
    near_top = everywhere(below(depth, SURFACE_ZONE), axis)
    condition = all_of(growing(m, axis, change, sign), near_top)
    return judged(last_over_first(m, axis), condition)


def joint_angle_follows(runs: xr.Dataset, axis: str, sign: float, change: Word) -> Found:
    """The flex joint angle at 130 s increases or decreases along an axis; value: last / first."""
    angle = abs(runs["ufj_angle"].sel(time=STATED, drop=True))
    return judged(last_over_first(angle, axis), growing(angle, axis, change, sign))


def change_near_the_lmrp(runs: xr.Dataset) -> Found:
    """The change of distance by a lighter LMRP is largest at the LMRP, and mainly below mid-length.

    Value: ratio of the mean change in the lower half to the mean change in the upper half.
    """
    change = _change_by_lighter_lmrp(runs)
    lower, upper = halves(change)
    ratio = lower / upper
    at_lmrp = change.isel(s=0, drop=True)
    margin = least(
        above(at_lmrp, NEARLY * change.max("s")),
        above(at_lmrp, 0.0, over=abs(change).max("s")),
        above(ratio, 1.0),
    )
    return judged(ratio, margin)


def _change_by_lighter_lmrp(runs: xr.Dataset) -> xr.DataArray:
    """Change of the distance along the riser, from an LMRP of 140 t to one of 120 t."""
    away = abs(displacement(runs)).sel(time=STATED, drop=True)
    return away.sel(lmrp_mass=120.0, drop=True) - away.sel(lmrp_mass=140.0, drop=True)


def change_arises_near_the_lmrp(runs: xr.Dataset, at_least: float) -> Found:
    """Most of the change by a lighter LMRP arises in the lowest quarter; value: share of this quarter."""
    change = _change_by_lighter_lmrp(runs)
    quarter = 0.25 * float(change["s"][-1])
    low = change.isel(s=0, drop=True)
    share = (low - change.interp(s=quarter).drop_vars("s")) / low
    return judged(share, above(share, at_least))


def all_rise_with_relative_speed(runs: xr.Dataset, change: Word) -> Found:
    """x, largest moment and largest rise are larger at 0 than at 90 deg; value: x at 0 / 90 deg."""
    return _larger_at_0_degrees(runs, largest_rise(runs), change)


def all_follow_relative_speed(runs: xr.Dataset, change: Word) -> Found:
    """x, largest moment and a are larger at 0 than at 90 deg; value: x at 0 / 90 deg."""
    return _larger_at_0_degrees(runs, lmrp_motion(runs)["amplitude"], change)


def _larger_at_0_degrees(runs: xr.Dataset, axial: xr.DataArray, change: Word) -> Found:
    """Comparison in the fastest current: in slower ones, the relative speed hardly differs from 90 deg."""
    by_angle = []
    for values in (distance(runs), runs["largest_bending_moment"], axial):
        at0, at90 = (at_angle(values, angle) for angle in (0, 90))
        by_angle.append((at0.isel(track_current=-1, drop=True), at90))
    x0, x90 = by_angle[0]
    return judged(x0 / x90, all_of(*(more(at0, at90, change) for at0, at90 in by_angle)))


def loads_small_at_the_lmrp(loads: xr.Dataset, smaller: Word) -> Found:
    """The load on the riser is smaller at the LMRP than at the joint; value: their ratio."""
    low, high = (abs(with_printed_lmrp(loads[f"load_at_{place}"])) for place in ("lmrp", "joint"))
    return judged(low / high, less(low, high, smaller))


def other_way_at_90_degrees(runs: xr.Dataset) -> Found:
    """At 90 deg the LMRP is on another side than at 0 and 45 deg; value: position at 90 / at 0 deg."""
    place = displacement(runs).sel(time=STATED, drop=True).isel(s=0, drop=True)
    at0, at45, at90 = (at_angle(place, angle) for angle in (0, 45, 90))
    same = above(at45 / at0, 0.0, over=1.0)
    return judged(at90 / at0, least(same, below(at90 / at0, 0.0, over=1.0)))


def falls_with_angle(runs: xr.Dataset, considerably: Word, declines: Word) -> Found:
    """Distance x decreases from 0 to 45 (considerably) and to 90 deg; value: x at 90 / at 0 deg."""
    x = distance(runs)
    at0, at45, at90 = (at_angle(x, angle) for angle in (0, 45, 90))
    both = all_of(more(at0, at45, considerably), more(at45, at90, declines))
    return judged(at90 / at0, both)


def grows_beyond_90_degrees(runs: xr.Dataset, increases: Word) -> Found:
    """Distance x increases from 90 to 135 and to 180 deg; value: x at 180 / at 90 deg."""
    x = distance(runs)
    at90, at135, at180 = (at_angle(x, angle) for angle in (90, 135, 180))
    both = all_of(more(at135, at90, increases), more(at180, at135, increases))
    return judged(at180 / at90, both)
