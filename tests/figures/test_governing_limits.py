"""The map of the limit that is exceeded most, over wave height and period."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_hex

from riserstudy.figures.governing import governing


@pytest.mark.parametrize("seed", range(6))
def test_each_limit_that_governs_has_a_colour_of_its_own(seed):
    """Two of many limits are exceeded: one in high waves, one in long waves."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(9, 20))
    high, long = draw.choice(count, 2, replace=False)
    if seed % 2:  # as many apart as there are colours
        high, long = sorted([0, 7])
    height, period = (
        axis.ravel() for axis in np.meshgrid(np.linspace(1.0, 9.0, 6), np.linspace(6.0, 16.0, 6))
    )
    demand = np.full((len(height), count), 0.1)
    demand[:, high], demand[:, long] = height / 6.0, period / 12.0
    responses = xr.Dataset(
        {
            "significant_wave_height": ("sea_state", height),
            "peak_period": ("sea_state", period),
            "held_out": ("sea_state", np.zeros(len(height), int)),
            "heading": ("sea_state", np.full(len(height), np.nan)),
            "demand_of_limit": (("sea_state", "limit"), demand),
            "allowed": ("limit", np.ones(count)),
            "side": ("limit", ["largest"] * count),
        },
        {"limit": [f"drilling: limit {k}" for k in range(count)]},
    )
    figure = governing(responses, "drilling", 0.5)
    (legend,) = figure.legends
    entries = zip(legend.get_texts(), legend.legend_handles, strict=True)
    named = {
        text.get_text(): to_hex(patch.get_facecolor())
        for text, patch in entries
        if hasattr(patch, "get_facecolor")
    }
    assert {f"drilling: limit {high}", f"drilling: limit {long}", "all limits met"} == set(named)
    assert len(set(named.values())) == 3
    (ax,) = figure.axes
    (shown,) = ax.collections
    painted = {to_hex(one) for one in shown.cmap(shown.norm(np.ma.filled(shown.get_array(), 0.0).ravel()))}
    assert painted == set(named.values())
