"""Liu et al. 2017: what its numbers, claims and errata are checked against."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.published.grading import Found
from riserstudy.quantities.crossing import first_crossing

# the one computed number


def time_of_ufj_limit(runs: xr.Dataset, degrees: float) -> Found:
    """Time (s) at which the upper flex joint reaches an angle; infinite where it never does."""
    return Found(first_crossing(abs(runs["ufj_angle"]), np.deg2rad(degrees)))
