"""Mao, Zeng, Liu: claims on speed, tension and the top end, in addition to the claims of Figs 9 to 14."""

from __future__ import annotations

import xarray as xr

from chapters.mao_hangoff.claims.towed import TIMES
from chapters.mao_hangoff.runs import halves, largest, moments_over_time, with_printed_lmrp
from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import above, everywhere
from riserstudy.grading.word_of_size import Word
from riserstudy.grading.yardstick import all_along, growing, more, more_on_the_whole

#: variants of the base case, and stiffness of the top end of each
TOP_ENDS = {"base": "as published", "joint clamped": "clamped"}
UNSTEADY = [time for time in TIMES if time >= 70.0]  # s, of Fig 9c, when the platform has its full speed


def speed_grows_with_mass(limits: xr.Dataset, larger: Word) -> Found:
    """A heavier LMRP allows a larger speed, in every case; value: least ratio of last to first."""
    speed = limits["speed_limit"]
    others = [str(dim) for dim in speed.dims if dim != "lmrp_mass"]
    ratio = speed.isel(lmrp_mass=-1, drop=True) / speed.isel(lmrp_mass=0, drop=True)
    return judged(ratio.min(), all_along(growing(speed, "lmrp_mass", larger), others))


def tension_range_grows_with_length(limits: xr.Dataset, larger: Word) -> Found:
    """A longer riser has a larger range of tension, in every heave; value: least last / first."""
    spread = limits["tension_range"]
    others = [str(dim) for dim in spread.dims if dim not in ("riser_length", "mode")]
    ratio = spread.isel(riser_length=-1, drop=True) / spread.isel(riser_length=0, drop=True)
    return judged(ratio.min(others), all_along(growing(spread, "riser_length", larger), others))


def upper_half_moves_faster(runs: xr.Dataset, faster: Word) -> Found:
    """The upper half moves faster than the lower between times of Fig 9c; value: ratio of distances moved."""
    x = with_printed_lmrp(runs["x"]).sel(time=TIMES)
    lower, upper = halves(abs(x.diff("time")))
    ratio = upper.sum("time") / lower.sum("time")
    return judged(ratio, more_on_the_whole(upper, lower, faster, "time"))


def top_end_decides(runs: xr.Dataset, larger: Word) -> Found:
    """A stiff top end, as published or clamped, increases M; value: M with it over M with a free one.

    The paper measures the deformation at a time by the bending moment (section 6.1).
    """
    moment = largest(runs)
    free = moment.sel(variant="joint free", drop=True)
    stiff = moment.sel(variant=list(TOP_ENDS)).assign_coords(variant=[*TOP_ENDS.values()])
    stiff = stiff.rename(variant="top_end")
    return judged(stiff / free, more(stiff, free, larger))


def moments_vary(runs: xr.Dataset, depths: list[float], evident: Word) -> Found:
    """Moments at all depths vary in time; value: least ratio of range to largest moment."""
    size = with_printed_lmrp(moments_over_time(runs)).sel(time=UNSTEADY)
    s = xr.DataArray([float(size["s"][-1]) - depth for depth in depths], dims="depth")
    there = size.sel(s=s, method="nearest")
    share = (there.max("time") - there.min("time")) / there.max("time")
    return judged(share.min("depth"), everywhere(above(share, evident.bound), "depth"))
