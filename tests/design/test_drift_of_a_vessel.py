"""The engine's vessel, adrift below a thread that pulls nothing, follows the closed form of drift."""

import pytest
from adrift import HULL, adrift

from riserstudy import simulate
from riserstudy.design.drift import drift
from riserstudy.scene.load import SceneFile

FORCE, TIME = 1e6, 400.0


@pytest.mark.parametrize("current", [0.0, 0.8])
def test_the_engines_vessel_drifts_as_the_closed_form(current):
    run = simulate(SceneFile("adrift.yaml", adrift(FORCE, current)), progress=False)
    expected = drift(HULL, FORCE, current, TIME)
    # the thread pulls back with 0.1 N, steps of 0.25 s err by 1e-5
    assert float(run["platform_surge"][-1]) == pytest.approx(float(expected.way), rel=1e-4)
    assert float(run["platform_speed_x"][-1]) == pytest.approx(float(expected.speed), rel=1e-4)
