"""When the upper flex joint reaches its limit over phases of the wave, and times that no gain gives."""

import json

import numpy as np
import pytest
import xarray as xr

from chapters.liu2017.claims import limit_over_phases

TIME = np.arange(0.0, 60.1, 0.1)
GAINS = np.array([64.0, 62.0, 65.0, 65.9, 67.0])  # in no order
SMOOTH = 50.0 * (65.9 / GAINS) ** 0.5


def runs(*limit_times):
    """A joint whose angle grows in proportion to time, up to 12 degrees at given times."""
    angles = np.deg2rad(12.0) * TIME / np.array(limit_times)[..., np.newaxis]
    scene = {"vessel": {"thrusters": {"gain": "65.9 kN/m"}}}
    return xr.Dataset(
        {"ufj_angle": (("wave_phase", "gain", "time"), -angles)},
        {"wave_phase": np.arange(len(limit_times)), "gain": GAINS, "time": TIME},
        {"scene": json.dumps(scene)},
    )


def test_a_time_that_falls_smoothly_with_the_gain_is_passed_by_at_no_phase():
    found = limit_over_phases(runs(SMOOTH, SMOOTH + 1.0, SMOOTH - 1.0), 12.0, 50.0, 1.0)
    assert (found["skipped"], found["count"]) == (0, 3)
    assert found["first"] == pytest.approx(49.0)
    assert found["last"] == pytest.approx(51.0)


@pytest.mark.parametrize(
    "before, after, skipped", [(53.0, 46.0, 1), (50.4, 46.0, 0), (53.0, 49.6, 0), (np.inf, 48.0, 1)]
)
def test_a_time_that_jumps_past_the_printed_one_is_given_by_no_gain(before, after, skipped):
    """A time that is 50 s when rounded to the second counts as given."""
    jumping = np.where(GAINS < 65.0, before, after)
    found = limit_over_phases(runs(SMOOTH, jumping), 12.0, 50.0, 1.0)
    assert found["skipped"] == skipped
    if skipped:
        assert found["least"] == pytest.approx(before - after)
