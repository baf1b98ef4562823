"""Operators that are zero in the waves of a scene are no motion: the riser moves as without them."""

import math
import random

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.scene.load import SceneFile
from riserstudy.scene.rao import TILTS
from riserstudy.simulation.refine import run

IN_PLANE, ASIDE = ("surge", "heave", "pitch"), ("sway", "roll", "yaw")


def operators(rng, symmetric, small):
    """Rows at headings from 0 to 180 deg; in head and following seas, motions aside have this small size."""
    rows = []
    for heading in (0.0, 45.0, 90.0, 180.0):
        for period in (5.0, 12.0, 25.0):
            row = {"heading": f"{heading} deg", "period": f"{period} s"}
            for name in (*IN_PLANE, *ASIDE):
                size = rng.uniform(0.2, 0.9) * (0.002 if name in TILTS else 1.0)
                along = name in ASIDE and math.isclose(math.sin(math.radians(heading)), 0.0, abs_tol=1e-9)
                row[name] = f"{small if along else size!r} {'rad/m' if name in TILTS else 'm/m'}"
                row[f"{name}_phase"] = f"{rng.uniform(0.0, 360.0)!r} deg"
            rows.append(row)
    return {"operators": rows, "phases": "lag", "headings": "towards"} | symmetric


def rig(seed, response, heading, **more):
    """A rig whose platform moves in a regular wave of its response only."""
    rng = random.Random(seed)
    tree = moving(seed, spatial=False, conductor=False)
    wave = {"amplitude": f"{rng.uniform(0.5, 2.0)!r} m", "period": f"{rng.uniform(6.0, 20.0)!r} s"}
    response |= {"wave": wave, "ramp": "5 s", "heading": f"{heading} deg"}
    tree["platform"] = {"centre_of_rotation": {"elevation": 0.0}, "response": response}
    return SceneFile("rig.yaml", written(tree | more)).resolved()


@pytest.mark.parametrize("heading", [0.0, 180.0])
@pytest.mark.parametrize("seed", range(4))
def test_a_table_of_six_motions_gives_in_head_seas_the_run_of_three(seed, heading):
    symmetric = {"symmetry": "sides"} if seed % 2 else {}
    tables = [operators(random.Random(seed), symmetric, small) for small in (0.0, 0.0, 1e-9)]
    tables[1]["motions"] = [*IN_PLANE]
    six, three, nearly = (rig(seed, table, heading) for table in tables)
    found, expected, in_space = (run(scene, estimated=False) for scene in (six, three, nearly))
    assert (found.facts["directions"], in_space.facts["directions"]) == (2, 3)
    assert found.arrays.keys() == expected.arrays.keys()
    for name, values in expected.arrays.items():
        np.testing.assert_array_equal(found.arrays[name], values, err_msg=name)
    for name in ("effective_tension_max", "x_max", "tensioner_force", "joint_stroke"):
        if name in expected.arrays:
            scale = float(np.abs(expected.arrays[name]).max())
            np.testing.assert_allclose(in_space.arrays[name], found.arrays[name], rtol=0.0, atol=1e-4 * scale)


@pytest.mark.parametrize("heading", [10.0, 90.0, -170.0])
def test_motions_aside_in_other_seas_leave_the_plane(heading):
    table = operators(random.Random(1), {"symmetry": "sides"}, 0.0)
    assert rig(1, table, heading).spatial == "platform.response"


@pytest.mark.parametrize("heading", [0.0, 180.0])
def test_a_limit_aside_is_evaluated_in_head_seas_as_in_others(heading):
    tables = [operators(random.Random(2), {"symmetry": "sides"}, 0.0) for _ in range(2)]
    limit = {"output": "y", "largest": "2 m", "mode": "drilling"}
    limited, ahead = rig(2, tables[0], heading, limits=[limit]), rig(2, tables[1], heading)
    found, expected = (run(scene, estimated=False) for scene in (limited, ahead))
    scale = float(np.abs(expected.arrays["x_max"]).max())
    assert np.abs(found.arrays["y_max"]).max() < 1e-9 * scale
    np.testing.assert_allclose(found.arrays["x_max"], expected.arrays["x_max"], rtol=0.0, atol=1e-6 * scale)
