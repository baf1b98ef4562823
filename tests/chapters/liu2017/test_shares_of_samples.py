"""What the figure of samples says of those that reach a limit, never do, or have no value."""

import numpy as np
import pytest
import xarray as xr

from chapters.liu2017.figures.checks import _share_reached


@pytest.mark.parametrize("seed", range(20))
def test_a_sample_without_a_value_is_counted_apart_from_one_that_never_reaches_the_limit(seed):
    draw = np.random.default_rng(seed)
    reached, never, unknown = (int(n) for n in draw.integers(0, 40, 3) + np.array([1, 0, 0]))
    times = np.concatenate(
        [draw.uniform(20.0, 90.0, reached), np.full(never, np.inf), np.full(unknown, np.nan)]
    )
    draw.shuffle(times)
    said = _share_reached(xr.DataArray(times, dims="sample"), "along")
    share = float(said.partition(" %")[0])
    assert share == pytest.approx(100.0 * reached / len(times), abs=0.5)
    assert (f"{unknown} without a value" in said) == (unknown > 0)
    assert "along" in said
