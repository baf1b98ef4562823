"""A seeded record of sea states with seasons, storms that last, and directions: no place's, for examples.

The logarithm of the significant wave height is a mean with a season, and two first-order autoregressive parts
that forget within half a day and within three days. Its median is 1.8 m, 1.45 times that in January; the
deviation of the logarithm about the season is 0.39. The peak period follows the height by a power with noise
that lasts; waves come from the west, turning by storms.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from riserstudy.seas.columns import NAMES, labels_of

if TYPE_CHECKING:
    import xarray as xr

FIRST_YEAR = 2001
MEDIAN = 1.8  # m, of the significant wave height over all years
SEASON = math.log(1.45)  # of its logarithm, largest in mid January
PARTS = ((12.0, 0.2), (72.0, 0.33))  # h that they last, deviations of the logarithm


def synthetic(years: int = 10, seed: int = 1) -> xr.Dataset:
    """An hourly record of whole years, as `riserstudy.seas.record.read_record` returns one."""
    import xarray as xr

    draw = np.random.default_rng(seed)
    begin, end = (np.datetime64(f"{FIRST_YEAR + k}-01-01", "ns") for k in (0, years))
    time = np.arange(begin, end, np.timedelta64(1, "h"))
    n = len(time)
    day = (time - time.astype("datetime64[Y]")) / np.timedelta64(1, "D")
    season = SEASON * np.cos(2.0 * math.pi * (day - 15.0) / 365.25)
    slow, quick = (size * lasting(draw, n, hours) for hours, size in PARTS)
    height = MEDIAN * np.exp(season + slow + quick)
    period = 7.2 * height**0.32 * np.exp(0.12 * lasting(draw, n, 24.0))
    direction = (270.0 + 45.0 * lasting(draw, n, 96.0)) % 360.0
    values = {
        "significant_wave_height": height,
        "peak_period": period,
        "wave_from_direction": direction,
    }
    record = xr.Dataset(
        {name: ("time", values[name], labels_of(NAMES[name])) for name in values}, {"time": time}
    )
    record.attrs = {
        "Conventions": "CF-1.11",
        "title": f"synthetic sea states, seed {seed}",
        "interval_hours": 1.0,
        "conversions": "",
    }
    return record


def lasting(draw: np.random.Generator, n: int, hours: float) -> NDArray[np.float64]:
    """Normal numbers of deviation 1 over hours, whose correlation falls by e in so many hours."""
    from scipy.signal import lfilter

    kept = math.exp(-1.0 / hours)
    noise = draw.standard_normal(n)
    noise[1:] *= math.sqrt(1.0 - kept**2)
    values: NDArray[np.float64] = lfilter([1.0], [1.0, -kept], noise)
    return values
