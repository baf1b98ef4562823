"""A synthetic record of sea states with seasons, storms and directions, from a seed, for examples.

The record is not that of a real place. The logarithm of the significant wave height is a seasonal mean plus
two first-order autoregressive parts with correlation times of half a day and three days. The median height is
1.8 m, and 1.45 times this value in January. The standard deviation of the logarithm about the season is 0.39.
The peak period is a power of the height with correlated noise. Waves come from the west, with slow variations
of the direction.
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
MEDIAN = 1.8  # m, median of the significant wave height over all years
SEASON = math.log(1.45)  # seasonal amplitude of its logarithm, largest in mid January
# correlation times (h) and standard deviations of the logarithm
PARTS = ((12.0, 0.2), (72.0, 0.33))


def synthetic(years: int = 10, seed: int = 1) -> xr.Dataset:
    """An hourly record of whole years, in the form of `riserstudy.seas.record.read_record`."""
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
    values = {"significant_wave_height": height, "peak_period": period, "wave_from_direction": direction}
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
    """Hourly normal numbers of standard deviation 1, whose correlation decreases by e in ``hours``."""
    from scipy.signal import lfilter

    kept = math.exp(-1.0 / hours)
    noise = draw.standard_normal(n)
    noise[1:] *= math.sqrt(1.0 - kept**2)
    values: NDArray[np.float64] = lfilter([1.0], [1.0, -kept], noise)
    return values
