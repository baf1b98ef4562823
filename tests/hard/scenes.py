"""Small scenes that are meant to be hard, as plain data."""

import copy
from pathlib import Path

import numpy as np

from riserstudy.scene.load import SceneFile, read_scene

SCENES = Path(__file__).parents[2] / "config" / "scenes"
LENGTH = 100.0
BENDING = 206e9 * np.pi / 64.0 * (0.5334**4 - 0.4826**4)
EULER = np.pi**2 * BENDING / LENGTH**2  # N, pinned at both ends

COLUMN = {
    "title": "weightless column under a body",
    "riser": [
        {
            "name": "riser",
            "length": f"{LENGTH} m",
            "outer_diameter": "0.5334 m",
            "inner_diameter": "0.4826 m",
            "young_modulus": "206 GPa",
        }
    ],
    "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "free"},
    "top": {
        "x": "held",
        "z": "free",
        "rotation": "free",
        "body": {"name": "body", "mass": "1 t", "submerged_weight": f"{EULER} N"},
    },
    "analysis": {"mesh": {"elements": 20}},
}


def changed(tree, **values):
    """The scene with values by dotted path; dots are written as two underscores."""
    values = {key.replace("__", "."): value for key, value in values.items()}
    return SceneFile("test.yaml", copy.deepcopy(tree)).with_values(values, "test")


def from_file(name, **values):
    values = {key.replace("__", "."): value for key, value in values.items()}
    return read_scene(SCENES / f"{name}.yaml").with_values(values, "test")
