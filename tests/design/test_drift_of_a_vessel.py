"""The engine's vessel, adrift below a thread that pulls nothing, follows the closed form of drift."""

import pytest

from riserstudy import simulate
from riserstudy.design.drift import Hull, drift
from riserstudy.scene.load import SceneFile

FORCE, TIME = 1e6, 300.0
HULL = Hull(9e7, 599625.0)


def adrift(current):
    """A vessel of 90 000 t with its added mass, and 1 MN on it."""
    tree = {
        "title": "adrift",
        "water": {"density": "1025 kg/m^3", "surface": "1000 m", "seabed": "0 m"},
        "riser": [
            {
                "name": "thread",
                "length": "1000 m",
                "axial_stiffness": "100 N",
                "mass": "0.001 kg/m",
                "submerged_weight": "0 N/m",
            }
        ],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "vessel", "z": "held", "elevation": "1001 m"},
        "vessel": {
            "mass": "6e7 kg",
            "added_mass": "3e7 kg",
            "hull_drag": "599625 N*s^2/m^2",
            "wave_drift": {"force": "1 MN", "heading": "0 deg"},
        },
        "analysis": {
            "duration": "300 s",
            "mesh": {"elements": 10},
            "step": "0.25 s",
            "output": {"interval": "10 s"},
        },
    }
    if current:
        tree["current"] = {"profile": {"shape": "uniform", "surface_speed": f"{current} m/s"}}
    return SceneFile("adrift.yaml", tree)


@pytest.mark.parametrize("current", [0.0, 0.8])
def test_the_engines_vessel_drifts_as_the_closed_form(current):
    run = simulate(adrift(current), progress=False)
    expected = drift(HULL, FORCE, current, TIME)
    # the thread pulls back with 0.1 N, steps of 0.25 s err by 1e-5
    assert float(run["platform_surge"][-1]) == pytest.approx(float(expected.way), rel=1e-4)
    assert float(run["platform_speed_x"][-1]) == pytest.approx(float(expected.speed), rel=1e-4)
