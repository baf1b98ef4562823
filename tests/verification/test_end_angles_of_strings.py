"""A string's angles at its ends are those of the forces there: closed forms, and second order in the mesh."""

import numpy as np
import pytest

from riserstudy import simulate
from riserstudy.scene.load import SceneFile

LENGTH, TENSION, LOAD = 1000.0, 2e6, 60.0


def angles(elements, offset=30.0, load=LOAD):
    tree = {
        "title": "a string aside",
        "riser": [
            {
                "name": "string",
                "length": f"{LENGTH} m",
                "axial_stiffness": "1e11 N",
                "lateral_load": f"{load} N/m",
            }
        ],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "held", "z": "free", "tension": f"{TENSION} N", "offset": f"{offset} m"},
        "analysis": {"mesh": {"elements": elements}},
    }
    run = simulate(SceneFile("string.yaml", tree), progress=False)
    return np.array([float(run["lfj_angle"]), float(run["ufj_angle"])])


@pytest.mark.parametrize("elements", [4, 16, 64])
def test_end_angles_of_a_loaded_string_are_those_of_the_parabola_on_any_mesh(elements):
    """z'' = 0, T x'' = -w: slopes X / L +- w L / 2 T, for the vertical part of the tension."""
    half = 0.5 * LOAD * LENGTH / TENSION
    expected = np.arctan([0.03 + half, 0.03 - half])
    # slopes are small: the height of the string differs from its length by their square
    np.testing.assert_allclose(angles(elements), expected, rtol=2e-3)


def test_end_angles_converge_with_the_square_of_the_mesh():
    def hanging(elements):
        tree = {
            "title": "a heavy cable aside",
            "gravity": "10 m/s^2",
            "riser": [
                {
                    "name": "cable",
                    "length": "1000 m",
                    "axial_stiffness": "1e10 N",
                    "submerged_weight": "1000 N/m",
                }
            ],
            "bottom": {"hold": "wellhead", "elevation": "0 m"},
            "top": {"x": "held", "z": "held", "offset": "150 m", "elevation": "980 m"},
            "analysis": {"mesh": {"elements": elements}},
        }
        run = simulate(SceneFile("cable.yaml", tree), progress=False)
        return float(run["ufj_angle"]), float(run["lfj_angle"])

    coarse, middle, fine = (np.array(hanging(n)) for n in (20, 40, 80))
    fall = abs(middle - coarse) / abs(fine - middle)
    assert (fall > 3.5).all()
