"""Amplitudes of Liu et al. 2020 whose peaks lie between the outputs, compared with known oscillations."""

import numpy as np
import pytest
import xarray as xr

from chapters.liu2020.claims.errata import heave_compared, left_out
from chapters.liu2020.periods import half_swing, settling

# 60 outputs in a period of 15 s: a peak lies at most a 32nd of an interval beside a value of the spline
BESIDE = 1.0 - np.cos(2.0 * np.pi / 60.0 / 32.0)  # 5e-6; an output itself misses 1.4e-3


def oscillation(draw, time, period):
    """A steady motion with a second harmonic (values, half of its exact range)."""
    late, size = draw.uniform(0.0, 2.0 * np.pi, 2), draw.uniform(0.0, 0.4)

    def at(t):
        turn = 2.0 * np.pi * t / period
        return np.cos(turn - late[0]) + size * np.cos(2.0 * turn - late[1])

    dense = at(np.linspace(0.0, period, 200001))
    return 7.0 + at(time), 0.5 * np.ptp(dense)


@pytest.mark.parametrize("seed", range(12))
def test_an_amplitude_is_that_of_the_motion_not_of_its_outputs(seed):
    """With 14 to 30 outputs in a period, which they need not divide, a spline misses less than 0.2 %."""
    draw = np.random.default_rng(seed)
    periods = np.sort(draw.uniform(5.0, 12.0, 3))
    time = np.arange(0.0, 40.0, periods[0] / draw.uniform(14.0, 30.0))
    rows, exact = zip(*(oscillation(draw, time, period) for period in periods), strict=True)
    gap = np.full_like(rows[0], np.nan)  # a node above the riser's top
    history = xr.DataArray(
        np.stack([np.stack([row, 3.0 * row, gap]) for row in rows]),
        {"wave_period": periods, "s": [0.0, 1.0, 2.0], "time": time},
    )
    found = half_swing(history, "wave_period")
    assert found.dims == ("wave_period", "s")
    np.testing.assert_allclose(found.isel(s=0), exact, rtol=2e-3)
    np.testing.assert_allclose(found.isel(s=1), 3.0 * np.array(exact), rtol=2e-3)
    assert np.isnan(found.isel(s=2)).all()
    assert float(settling(history, "wave_period").max()) < 2e-3  # steady


def test_a_change_of_phase_is_no_change_of_amplitude():
    """Outputs at a peak of one motion miss the peak of the next by 0.1 %, as much as losses change it."""
    time = np.arange(135.0, 150.01, 0.25)
    for late in np.linspace(0.0, 0.1, 9):
        history = xr.DataArray(np.cos(2.0 * np.pi * time / 15.0 - late), {"time": time})
        assert float(half_swing(history, 15.0)) == pytest.approx(1.0, abs=1.01 * BESIDE)


@pytest.mark.parametrize("seed", range(8))
def test_losses_change_the_tension_by_their_own_share(seed):
    """Each loss multiplies the amplitude by a known factor, and delays the motion, as damping does."""
    draw = np.random.default_rng(seed)
    time = np.arange(135.0, 150.01, 0.25)
    late = draw.uniform(0.0, 2.0 * np.pi) + np.array([0.0, *np.sort(draw.uniform(0.0, 0.3, 2))])
    gain = 1.0 + np.array([0.0, *np.sort(draw.uniform(-0.002, 0.03, 2))])
    turn = 2.0 * np.pi * time / 15.0
    tension = [2e6 + 2.3e5 * g * np.cos(turn - lag) for g, lag in zip(gain, late, strict=True)]
    names = ["none", "967 N s/m a cylinder", "10 kN s/m a cylinder"]
    runs = xr.DataArray(np.array(tension)[..., None], {"losses": names, "time": time, "s": [0.0]})
    variants = ["as it is", "damping ratio 1", "damping by Eq. 16", "damping by Eq. 16 with a ratio of 1",
                "pistons on the ring", "533 m to the upper flex joint"]  # fmt: skip
    roll = xr.DataArray(np.ones((len(variants), 2)), {"variant": variants, "roll_period": [5.0, 10.0]})
    roll = roll.to_dataset(name="largest_bending_moment")
    found = left_out(roll, runs.to_dataset(name="effective_tension"))
    assert (found["small"], found["large"]) == pytest.approx(tuple(gain[1:] - 1.0), abs=2.1 * BESIDE)


def test_upright_cylinders_are_compared_by_the_amplitude_of_the_motion():
    time = np.arange(105.0, 150.01, 0.25)
    tension = 2e6 + 2e5 * np.cos(2.0 * np.pi * (time - 0.125) / 15.0)  # each peak between two outputs
    upright = xr.DataArray(tension[None, :, None], {"tensioner_model": ["gas law"], "time": time, "s": [0.0]})
    heave = xr.DataArray([[1e5]], {"heave_amplitude": [2.0], "heave_period": [15.0]})
    found = heave_compared(
        heave.to_dataset(name="axial_force_amplitude"), upright.to_dataset(name="effective_tension")
    )
    assert found["space"] == pytest.approx(100.0)
    assert found["upright"] == pytest.approx(200.0, rel=BESIDE)
