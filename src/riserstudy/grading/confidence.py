"""The share of samples that meet a number or claim, with its 95 % confidence interval.

The interval by which samples are simulated until a verdict is certain is in `sequential`.
"""

from __future__ import annotations

from dataclasses import replace

import xarray as xr
from scipy.stats import binomtest

from riserstudy.grading.found import NO_DIFFERENCE
from riserstudy.records.graded import Share

MANY = 100  # smallest number of samples for an interval of a share


def share_with_interval(found: xr.DataArray) -> Share:
    """Number of hits among the samples with a result, with the 95 % confidence interval for many samples.

    The interval is Wilson's, which is too wide for evenly spread samples. All cells of a sample count as one
    draw.
    """
    known = found.notnull()
    others = [dim for dim in found.dims if dim != "sample"]
    draws = int(known.any(others).sum()) if "sample" in found.dims else None
    same = int((found == NO_DIFFERENCE).sum())
    share = Share(int((found > 0.0).sum()), int(known.sum()), draws, same=same)
    if draws is None or draws < MANY:
        return share
    true = round(share.met / share.samples * draws)
    band = binomtest(true, draws).proportion_ci(method="wilson")
    return replace(share, low=float(band.low), high=float(band.high))
