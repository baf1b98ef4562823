"""What numbers and claims are checked by: a function each, named in config/published/example.yaml."""

import xarray as xr

from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import above


def grows_faster_than(swings: xr.Dataset) -> Found:
    """Whether the swing grows faster than heave; value: its growth over that of heave."""
    swing = swings["tension_swing"]
    amplitude = swing["heave_amplitude"]
    growth = (swing[-1] / swing[0]) / (amplitude[-1] / amplitude[0])
    growth = growth.reset_coords(drop=True)
    return judged(growth, above(growth, 1.0))
