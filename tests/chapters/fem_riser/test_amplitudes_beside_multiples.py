"""The amplitude at the wave's period of a riser that also moves at multiples of its frequency, and drifts."""

import numpy as np
import pytest
import xarray as xr

from chapters.fem_riser.along import amplitude_at, drift_rate

PERIOD = 8.0  # s


def moving(time, draw, multiples):
    """A motion with a drift and some multiples: over time, with its amplitude (m) and drift (m/s)."""
    size, rate = draw.uniform(0.05, 0.3), draw.uniform(-0.02, 0.02)
    x = draw.uniform(-20.0, 20.0) + rate * time
    for multiple, share in {1: 1.0, **multiples}.items():
        x = x + share * size * np.cos(2.0 * np.pi * multiple * time / PERIOD - draw.uniform(0.0, 6.0))
    return xr.DataArray(x, {"time": time}), size, rate


@pytest.mark.parametrize("interval", [0.5, 1.0, 3.0])
@pytest.mark.parametrize("seed", range(4))
def test_multiples_of_the_frequency_do_not_change_the_amplitude_at_it(seed, interval):
    """From 261 to 300 s, as in the studies; 3 s apart, multiples look like other periods."""
    draw = np.random.default_rng(seed)
    time = np.arange(261.0, 300.0 + 1e-9, interval)
    shares = {2: draw.uniform(-0.3, 0.3), 3: draw.uniform(-0.2, 0.2)}
    x, size, rate = moving(time, draw, shares)
    assert float(amplitude_at(x, PERIOD)) == pytest.approx(size, rel=1e-9)
    assert float(drift_rate(x, PERIOD)) == pytest.approx(rate, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("interval", [2.0, 8.0 / 3.0])
@pytest.mark.parametrize("seed", range(3))
def test_outputs_that_cannot_tell_multiples_still_give_the_amplitude_of_a_sine(seed, interval):
    """With four outputs in a period, three times the frequency looks like it; with three, twice does."""
    draw = np.random.default_rng(seed)
    x, size, rate = moving(np.arange(260.0, 300.0 + 1e-9, interval), draw, {})
    assert float(amplitude_at(x, PERIOD)) == pytest.approx(size, rel=1e-9)
    assert float(drift_rate(x, PERIOD)) == pytest.approx(rate, rel=1e-6)
