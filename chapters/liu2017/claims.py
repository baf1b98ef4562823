"""Liu et al. 2017: checks of its published numbers and claims, and numbers for its errata.

Datasets contain both directions of drive-off: ``heading`` is "along" or "against" the environment.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr

from chapters.liu2017.limits import BOTTOM, LIMITS, reached, shares, starts
from riserstudy.dataset.crossing import at_time, first_crossing
from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import above, below, everywhere, least
from riserstudy.grading.word_of_size import Word
from riserstudy.grading.yardstick import Condition, all_of, less, more, more_on_the_whole
from riserstudy.scene.units import to_si

TARGET = 100.0  # m, the false position
TENSION, STRENGTH = 3.02e6, 386e6  # N, Pa, published; strength taken for the riser, too
SEEN = (50.0, 100.0)  # s, of Fig 4: target reached, largest surge not yet passed
MOVED = 1.0  # m, displacement at which a point of the riser counts as having begun to move
INERTIA = {"riser_inertia": "with", "riser_drag": "without"}
UFJ = "upper flex joint"
OTHERS = [name for name in LIMITS if name != UFJ]
DRAG = {"riser_inertia": "without", "riser_drag": "with"}


# published numbers


def time_of_ufj_limit(runs: xr.Dataset, degrees: float) -> Found:
    """Time (s) at which the upper flex joint reaches an angle (°); infinite if it never does."""
    return Found(first_crossing(abs(_along(runs)["ufj_angle"]), np.deg2rad(degrees)))


# Fig 4


def faster_along(runs: xr.Dataset, until: float, larger: Word) -> Found:
    """The speed along exceeds the speed against; value: smallest difference after the first second (m/s)."""
    speed = runs["platform_speed_x"].sel(time=slice(1.0, until))
    ahead = _along(speed) - _against(speed)
    faster = more_on_the_whole(_along(speed), _against(speed), larger, "time")
    return judged(ahead.min("time"), faster)


def arrives_earlier_along(runs: xr.Dataset, smaller: Word) -> Found:
    """The platform reaches the false position along, and later or never against; value: time along (s)."""
    time = _arrival(runs)
    earlier = less(_along(time), _against(time), smaller)
    # a platform that never arrives along does not arrive earlier, whatever happens against
    earlier = Condition(earlier.margin, earlier.same & np.isfinite(_along(time)))
    return judged(_finite(_along(time), runs), earlier)


def smaller_with_riser(runs: xr.Dataset, heading: str, smaller: Word) -> Found:
    """Surge is smaller with riser from 50 to 100 s; value: largest reduction, relative to surge without."""
    taken = _taken_off(runs.sel(heading=heading, drop=True))
    most, never_more = taken.max("time"), everywhere(taken, "time") + smaller.band
    compared = Condition(most - smaller.bound, abs(taken).max("time") < smaller.band)
    return judged(most, all_of(compared, never_more))


def _taken_off(runs: xr.Dataset) -> xr.DataArray:
    """Relative reduction of the platform's surge by the riser, over the later part of Fig 4."""
    run = runs.sel(time=slice(*SEEN))
    share: xr.DataArray = 1.0 - run["platform_surge"] / run["surge_alone"]
    return share


def riser_slows_the_platform(runs: xr.Dataset, obvious: Word) -> Found:
    """The riser changes the platform's surge, along or against; value: the larger relative change."""
    share = abs(_taken_off(runs)).max(("time", "heading"))
    return judged(share, above(share, obvious.bound))


# Fig 6


def drives_then_inhibits(runs: xr.Dataset, after: float) -> Found:
    """Along, the force first drives, and inhibits from ``after`` (s) to arrival; value: first force (kN)."""
    force = _along(runs["riser_force_x"])
    until = _by_arrival(runs, "along")
    first, size = force.isel(time=0, drop=True), abs(force).max("time")
    inhibits = below(force, 0.0, over=size).where((force["time"] > after) & until, 1.0)
    margin = least(above(first, 0.0, over=size), everywhere(inhibits, "time"))
    return judged(first / 1e3, margin)


def deflects_along_at_first(runs: xr.Dataset) -> Found:
    """Along, the riser is first bowed down the environment; value: difference of its end angles (deg)."""
    start = _along(runs).isel(time=0, drop=True)
    low, top = start["lfj_angle"], start["ufj_angle"]
    size = abs(low) + abs(top)
    margin = least(above(low, 0.0, over=size), below(top, 0.0, over=size))
    return judged(np.rad2deg(low - top), margin)


def always_inhibits(runs: xr.Dataset) -> Found:
    """Against, the force inhibits the platform until arrival; value: largest force (kN)."""
    force = _against(runs["riser_force_x"]).where(_by_arrival(runs, "against"))
    most = force.max("time")
    return judged(most / 1e3, below(most, 0.0, over=abs(force).max("time")))


def larger_against(runs: xr.Dataset, larger: Word) -> Found:
    """Until arrival along, the force is larger against than along; value: smallest difference (kN)."""
    before = _by_arrival(runs, "along").isel(time=slice(1, None))  # mirror images at rest
    size = abs(runs["riser_force_x"]).isel(time=slice(1, None))
    ahead = (_against(size) - _along(size)).where(before).min("time")
    whole = more_on_the_whole(_against(size), _along(size), larger, "time", before)
    return judged(ahead / 1e3, whole)


def inhibits_overall(runs: xr.Dataset) -> Found:
    """Along, the impulse of the force until arrival opposes the drive-off; value: impulse (MN s)."""
    force = _along(runs["riser_force_x"]).where(_by_arrival(runs, "along"), 0.0)
    impulse = force.integrate("time") / 1e6
    size = abs(force).integrate("time") / 1e6
    return judged(impulse, below(impulse, 0.0, over=size))


# Fig 7


def ufj_first(runs: xr.Dataset) -> Found:
    """Of limits reached, the upper flex joint's is first; value: its share then over the largest other."""
    run = _along(runs)
    times = reached(run)
    ufj, others = times.sel(limit=UFJ, drop=True), times.sel(limit=OTHERS).min("limit")
    first = times.min("limit")
    ratio = _ufj_over_others(at_time(shares(run), first))
    return judged(ratio, below(ufj, others), first < np.inf)


def ufj_ahead(runs: xr.Dataset, time: float) -> Found:
    """At a time the upper flex joint has used most of its limit; value: ratio to the largest other share."""
    ratio = _ufj_over_others(shares(_along(runs)).interp(time=time, assume_sorted=True).drop_vars("time"))
    return judged(ratio, above(ratio, 1.0))


def _ufj_over_others(used: xr.DataArray) -> xr.DataArray:
    """Share of the upper flex joint's limit, divided by the largest share of the other limits."""
    ratio: xr.DataArray = used.sel(limit=UFJ, drop=True) / used.sel(limit=OTHERS).max("limit")
    return ratio


def slow_below(runs: xr.Dataset, later: float) -> Found:
    """All parts at the bottom begin to respond later than the upper flex joint; value: least delay (s)."""
    begins = starts(_along(runs))
    delay = begins.sel(limit=list(BOTTOM)).min("limit") - begins.sel(limit=UFJ, drop=True)
    return judged(_finite(delay, runs), above(delay, later))


def constant_at_first(runs: xr.Dataset, least: float) -> Found:
    """No part at the bottom responds for some time; value: time at which the first begins (s)."""
    begins = starts(_along(runs)).sel(limit=list(BOTTOM)).min("limit")
    return judged(_finite(begins, runs), above(begins, least))


def bottom_moves_later(runs: xr.Dataset, later: float) -> Found:
    """The riser, at a tenth of its length above its lower end, moves later than its top; value: delay (s)."""
    run = _along(runs)
    top, low = (first_crossing(abs(run[n]), MOVED) for n in ("platform_surge", "low_displacement"))
    return judged(_finite(low - top, runs), above(low - top, later))


def inertia_explains_the_lag(runs: xr.Dataset, larger: Word) -> Found:
    """The bottom lags more with riser inertia alone than with riser drag alone; value: ratio of the lags."""
    lag = runs["lag"]
    inertia, drag = (lag.sel(alone).reset_coords(drop=True) for alone in (INERTIA, DRAG))
    return judged(inertia / drag, more(inertia, drag, larger))


def stroke_responds_fast(runs: xr.Dataset, obvious: Word) -> Found:
    """At 50 s the stroke's share of its limit exceeds all at the bottom; value: ratio to the largest."""
    used = shares(_along(runs)).interp(time=50.0, assume_sorted=True).drop_vars("time")
    stroke, low = used.sel(limit="telescopic joint", drop=True), used.sel(limit=list(BOTTOM)).max("limit")
    return judged(stroke / low, more(stroke, low, obvious))


def stroke_begins_before_the_bottom(runs: xr.Dataset) -> Found:
    """The stroke begins to respond before all parts at the bottom; value: delay of the first of these (s)."""
    begins = starts(_along(runs))
    stroke = begins.sel(limit="telescopic joint", drop=True)
    low = begins.sel(limit=list(BOTTOM)).min("limit")
    return judged(_finite(low, runs) - _finite(stroke, runs), below(stroke, low))


# the environment


def environment_helps_or_opposes(runs: xr.Dataset) -> Found:
    """At first, thrust and environment agree along and oppose against; value: environment, against (MN)."""
    start = runs.isel(time=1, drop=True)
    thrust, force = start["thrust_x"], start["environment_force_x"]
    larger = abs(thrust).where(abs(thrust) > abs(force), abs(force))
    agree = above(thrust * force, 0.0, over=larger**2)
    return judged(_against(force) / 1e6, least(_along(agree), -_against(agree)))


def combined_force_larger_along(runs: xr.Dataset, larger: Word) -> Found:
    """At the start, the sum of thrust and environment is larger along than against; value: the ratio."""
    start = runs.isel(time=1, drop=True)
    force = abs(start["thrust_x"] + start["environment_force_x"])
    return judged(_along(force) / _against(force), more(_along(force), _against(force), larger))


def _along(runs: Any) -> Any:
    return runs.sel(heading="along", drop=True) if "heading" in runs.dims else runs


def _against(runs: Any) -> Any:
    return runs.sel(heading="against", drop=True)


def _arrival(runs: xr.Dataset) -> xr.DataArray:
    """Time at which the platform reaches the false position (s), infinite if never."""
    return first_crossing(runs["platform_surge"], TARGET)


def _by_arrival(runs: xr.Dataset, heading: str) -> xr.DataArray:
    arrival = _arrival(runs.sel(heading=heading, drop=True))
    before: xr.DataArray = runs["time"] <= arrival
    return before


def _finite(value: xr.DataArray, runs: xr.Dataset) -> xr.DataArray:
    """Replace values that are not finite (events that never happen) with the record's end time (s)."""
    return value.where(np.isfinite(value), float(runs["time"][-1]))


# errata


def facts(base: xr.Dataset, losses: xr.Dataset) -> dict[str, Any]:
    """Compute the numbers that the errata quote."""
    times = reached(base)
    stroke = shares(_along(base)).sel(limit="telescopic joint") * LIMITS["telescopic joint"].most
    fifty = _along(base).interp(time=50.0)
    printed, exact = (float(fifty[f"riser_{name}_x"]) / 1e6 for name in ("force", "reaction"))
    chord = np.hypot(float(fifty["platform_surge"]), 1327.0) - 1327.0
    lost = losses.sel(loss="drift-off").dropna("time", how="all")
    drift = lost["limit_time"]
    return {
        "along": float(_along(times).min("limit")),
        "against": float(_against(times).min("limit")),
        "stroke": float(stroke.interp(time=50.0)),
        "chord": float(chord),
        "stroke_time": float(_along(times).sel(limit="telescopic joint")),
        "stroke_surge": float(
            at_time(_along(base)["platform_surge"], _along(times).sel(limit="telescopic joint"))
        ),
        "arrives_along": float(_along(_arrival(base))),
        "arrives_against": float(_against(_arrival(base))),
        "thrust": float(abs(base["thrust_x"]).max() / 1e6),
        "printed": printed,
        "exact": exact,
        "implied": float(-TENSION * np.sin(LIMITS[UFJ].most) / 1e6),
        "overshoot": float(_along(base)["platform_surge"].max()),
        "lower": float(shares(fifty).sel(limit=list(BOTTOM)).max()),
        "riser_stress": float(fifty["riser_stress"]) / 1e6,
        "drift_stroke": float(drift.sel(limit="telescopic joint")),
        "drift_conductor": float(drift.sel(limit="conductor")),
        "drift_riser": float(first_crossing(lost["riser_stress"], STRENGTH)),
        "drift_tension": float(lost["riser_tension"].max() / 1e6),
        "drift_lower": float(lost["limit_share"].sel(limit="lower flex joint").max()),
        "drift_upper": float(np.rad2deg(LIMITS[UFJ].most) * lost["limit_share"].sel(limit=UFJ).max()),
    }


def lags(runs: xr.Dataset, begun: float) -> dict[str, Any]:
    """Lag (s) of the bottom behind the upper flex joint: riser with inertia and drag, either, or neither."""
    lag = runs["lag"].sel(begun=begun)
    cases = {
        "both": dict.fromkeys(INERTIA, "with"),
        "inertia": INERTIA,
        "drag": DRAG,
        "neither": dict.fromkeys(INERTIA, "without"),
    }
    return {name: float(lag.sel(case)) for name, case in cases.items()}


def limit_over_phases(runs: xr.Dataset, degrees: float, deadline: float, rounding: float) -> dict[str, Any]:
    """Times at which the upper flex joint reaches an angle, over wave phases; phases that no gain fits.

    Parameters
    ----------
    degrees : angle of the joint (°).
    deadline, rounding : time (s) that a gain must give, and the interval (s) to which it is rounded. From
        one gain to the next, the computed time may jump past it.
    """
    times = first_crossing(abs(runs["ufj_angle"]), np.deg2rad(degrees)).sortby("gain")
    base = times.sel(gain=gain_of(runs))
    later, earlier = (times.isel(gain=part).drop_vars("gain") for part in (slice(None, -1), slice(1, None)))
    passed = (later > deadline + 0.5 * rounding) & (earlier < deadline - 0.5 * rounding)
    return {
        "first": float(base.min()),
        "last": float(base.max()),
        "skipped": int(passed.any("gain").sum()),
        "count": passed.sizes["wave_phase"],
        "least": float((later - earlier).where(passed).min()),
    }


def gain_of(runs: xr.Dataset) -> float:
    """Gain (kN/m) of the thrusters in the scene of the runs."""
    return to_si(json.loads(runs.attrs["scene"])["vessel"]["thrusters"]["gain"], "kN/m")
