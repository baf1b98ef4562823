"""Stations count from the riser's lower end, also above a body that turns with this end."""

import copy

import numpy as np
import pytest

from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def hung(seed, spatial):
    """A riser that hangs with its LMRP from a moving platform, its lengths and the arm (m)."""
    draw = np.random.default_rng(seed)
    lengths = draw.uniform(40.0, 300.0, 2)
    mass, arm, inertia = draw.uniform(5e4, 2e5), draw.uniform(1.0, 8.0), draw.uniform(1e5, 4e6)
    pipe = {
        "outer_diameter": "0.5334 m",
        "inner_diameter": "0.4826 m",
        "young_modulus": "207 GPa",
        "mass": "400 kg/m",
        "submerged_weight": "2 kN/m",
        "drag": {"coefficient": 1.0, "diameter": "0.7 m"},
        "added_mass": {"coefficient": 1.0, "diameter": "0.7 m"},
    }
    names = ("surge", "sway") if spatial else ("surge",)
    sway = {"amplitude": f"{draw.uniform(1.0, 4.0)} m", "period": "11 s", "ramp": "11 s"}
    tree = {
        "title": "hung off",
        "gravity": "9.81 m/s^2",
        "water": {"density": "1025 kg/m^3", "surface": "0 m", "seabed": "-900 m"},
        "riser": [
            pipe | {"name": f"section {k}", "length": f"{length!r} m"}
            for k, length in enumerate(lengths.tolist())
        ],
        "bottom": {
            "hold": "free",
            "body": {"name": "LMRP", "mass": f"{mass} kg", "submerged_weight": f"{8.0 * mass} N"}
            | {"centre_below": f"{arm} m", "rotary_inertia": f"{inertia} kg*m^2"},
        },
        "top": {"x": "platform", "z": "platform", "elevation": "-15 m", "rotation": "free"},
        "platform": dict.fromkeys(names, sway),
        "analysis": {
            "duration": "22 s",
            "step": "0.25 s",
            "mesh": {"elements": int(draw.integers(20, 60))},
            "output": {"interval": "1 s"},
        },
    }
    return tree, lengths, arm + inertia / (mass * arm)


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_stations_at_the_ends_of_sections_have_the_histories_of_the_nodes_there(seed, spatial):
    tree, lengths, reach = hung(seed, spatial)
    whole = run(SceneFile("hung.yaml", copy.deepcopy(tree)).resolved(), estimated=False)
    places = [0.0, float(lengths[0]), float(lengths.sum())]
    tree["analysis"]["output"]["stations"] = [f"{place!r} m" for place in places]
    found = run(SceneFile("hung.yaml", tree).resolved(), estimated=False)
    ends = [1, int(np.abs(whole.arrays["s_node"] - reach - lengths[0]).argmin()), -1]
    for name in ("x", "y", "z") if spatial else ("x", "z"):
        there = whole.arrays[name][:, ends]
        np.testing.assert_allclose(found.arrays[name], there, rtol=0.0, atol=1e-9)
    assert found.arrays["z"][0, 0] == pytest.approx(-15.0 - lengths.sum(), abs=1.0)
    assert found.arrays["s"] == pytest.approx(whole.arrays["s_node"][ends])
    assert any(f"{reach:.4g} m below" in warning for warning in sentences(found.facts["warnings"]))
    assert not any("below the riser's lower end" in warning for warning in sentences(whole.facts["warnings"]))
