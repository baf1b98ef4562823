"""Liu et al. 2020, section 4.2: motions of the platform with equal influence or without influence."""

from __future__ import annotations

import xarray as xr

from chapters.liu2020.below_ring import largest_moment
from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import below
from riserstudy.grading.word_of_size import Word
from riserstudy.grading.yardstick import alike


def same_influence(motions: xr.Dataset, one: str, other: str, same: Word) -> Found:
    """Two motions bend the riser equally; value: ratio of the first largest moment to the second."""
    moment = largest_moment(motions)
    first, second = (moment.sel(motion=name, drop=True) for name in (one, other))
    return judged(first / second, alike(first, second, same))


def no_influence(motions: xr.Dataset, none: str, compared: str, same: Word) -> Found:
    """A motion displaces the riser negligibly; value: ratio of its displacement to another motion's."""
    aside = [abs(motions[f"{axis}_{side}"]).max("s_node") for axis in "xy" for side in ("max", "min")]
    farthest = xr.concat(aside, "of").max("of")
    share = farthest.sel(motion=none, drop=True) / farthest.sel(motion=compared, drop=True)
    return judged(share, below(share, same.bound))
