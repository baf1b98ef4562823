"""Liu et al. 2020, section 4.2: motions of the platform that have the same influence, or none."""

from __future__ import annotations

import xarray as xr

from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import below
from riserstudy.grading.word import Word
from riserstudy.grading.yardstick import alike


def same_influence(motions: xr.Dataset, one: str, other: str, same: Word) -> Found:
    """Two motions bend the riser alike; value: largest moment of the one over that of the other."""
    moment = motions["largest_bending_moment"]
    first, second = (moment.sel(motion=name, drop=True) for name in (one, other))
    return judged(first / second, alike(first, second, same))


def no_influence(motions: xr.Dataset, none: str, compared: str, same: Word) -> Found:
    """A motion moves the riser aside by no difference; value: how far, over how far another does."""
    aside = [
        abs(motions[f"{axis}_{side}"]).max("s_node") for axis in "xy" for side in ("max", "min")
    ]
    farthest = xr.concat(aside, "of").max("of")
    share = farthest.sel(motion=none, drop=True) / farthest.sel(motion=compared, drop=True)
    return judged(share, below(share, same.bound))
