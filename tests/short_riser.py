"""A riser of 100 m in a uniform current that locks in to its first mode, with a weld."""

import copy

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

SCENE = {
    "title": "a short riser",
    "gravity": "9.81 m/s^2",
    "water": {"density": "1025 kg/m^3", "seabed": "-1 m", "surface": "110 m"},
    "riser": [
        {
            "name": "pipe",
            "length": "100 m",
            "outer_diameter": "0.5334 m",
            "inner_diameter": "0.4826 m",
            "young_modulus": "210 GPa",
            "mass": "700 kg/m",
            "submerged_weight": "0.5 kN/m",
            "contents": {"density": "1025 kg/m^3"},
            "drag": {"coefficient": 1.1, "diameter": "0.5334 m"},
            "added_mass": {"coefficient": 1.0, "diameter": "0.5334 m"},
            "viv": {"model": "synchronisation", "diameter": "0.5334 m", "coefficient": 1.2}
            | {"frequencies": [0.11, 0.18, 0.26], "memory": 20.0, "seed": 1, "ramp": "40 s"},
        }
    ],
    "bottom": {"hold": "wellhead", "elevation": "0 m"},
    "top": {"x": "held", "z": "free", "tension": "1 MN"},
    "analysis": {
        "duration": "400 s",
        "output": {"interval": "0.25 s"},
        "mesh": {"elements": 40},
        "step": "0.05 s",
    },
}


def riser(speed, curve):
    """The riser in a uniform current (m/s), with a weld of an S-N curve on its outside."""
    weld = {"name": "weld", "face": "outside", "curve": curve, "stress_concentration": 1.0}
    tree = copy.deepcopy(SCENE)
    tree["current"] = {"profile": {"shape": "uniform", "surface_speed": f"{speed} m/s"}}
    tree["fatigue"] = {"angles": 16, "details": [weld | {"safety_factor": 10.0}]}
    return SceneFile("short riser", tree, {})


def simulated(file, estimated=False):
    return run(file.resolved(), estimated=estimated)
