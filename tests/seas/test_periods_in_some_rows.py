"""A record with heights in every row, and periods in some: each row with both stands for its own interval."""

import numpy as np
import pytest
from platform_in_a_sea import RISER, in_a_sea

from riserstudy import load_scene
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.synthetic import synthetic

LIMITS = [
    {"output": "ufj_angle", "largest": "0.6 deg", "mode": "drilling"},
    {"output": "effective_tension", "smallest": "2250.5 kN", "mode": "connected"},
]


@pytest.mark.parametrize("every, seed", [(2, 0), (3, 1), (6, 2)])
def test_rows_without_a_period_change_neither_demands_nor_hours(every, seed):
    """Against the record without these rows, whose interval, and extremes, are larger."""
    record = synthetic(1, seed + 4).isel(time=slice(1000, 1000 + 12 * every))
    few = record.isel(time=slice(None, None, every)).assign_attrs(interval_hours=float(every))
    period = record["peak_period"].where(np.arange(record.sizes["time"]) % every == 0)
    file = load_scene(RISER).with_values(in_a_sea(LIMITS, (1, 6, 12, 60), 20, "60 s"), "test")
    one, other = (
        riser_downtime(file, each, error=0.5, cores=1) for each in (record.assign(peak_period=period), few)
    )
    for name in ("demand_of_limit", "standard_error"):
        np.testing.assert_array_equal(one.responses[name], other.responses[name])
    assert one.responses.attrs["interval_hours"] == every == one.demands.interval == other.demands.interval
    for mode, same in zip(one.hours.modes, other.hours.modes, strict=True):
        assert (mode.hours.share, mode.low, mode.high) == (same.hours.share, same.low, same.high)
        assert mode.hours.interval == same.hours.interval
