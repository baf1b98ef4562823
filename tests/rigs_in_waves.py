"""Seeded rigs below a platform that follows an irregular sea, and rigs with limits, for several tests."""

import copy

import numpy as np
from random_rigs import rig, written

from riserstudy.scene.load import SceneFile

ALONG = {"surge": "0.6 m/m", "surge_phase": "90 deg", "heave": "0.5 m/m", "heave_phase": "0 deg"}
FINER = 4


def in_waves(seed, spatial, stream, sea, components, duration, steps, elements):
    """A rig below a platform that follows an irregular sea, on few segments by long or short steps.

    Parameters
    ----------
    stream : number that makes the draws of a test its own.
    sea : significant height with its unit.
    steps, elements : steps (s) and numbers of segments, one of which is drawn.
    """
    tree = rig(seed, spatial=spatial, conductor=False)
    draw = np.random.default_rng((seed, spatial, stream))
    wave = {"significant_height": sea, "peak_period": "10 s", "peak_enhancement": 2.0}
    wave |= {"components": components, "seed": 1}
    operators = [{"period": f"{period} s", **ALONG} for period in (1, 6, 12, 60)]
    tree["platform"]["response"] = {"operators": operators, "phases": "lead", "wave": wave, "ramp": "5 s"}
    step, count = float(draw.choice(steps)), int(draw.choice(elements))
    tree["analysis"] = {"duration": duration, "step": step, "mesh": {"elements": count}}
    tree["analysis"]["output"] = {"interval": 1.0}
    return tree


def finer(tree):
    """The rig on a mesh four times as fine, by steps four times as short."""
    tree = copy.deepcopy(tree)
    tree["analysis"]["mesh"]["elements"] *= FINER
    tree["analysis"]["step"] /= FINER
    return tree


def limited(tree, largest, units, mode="drilling"):
    """The file of a rig with largest allowed values by output, in SI units."""
    limits = [
        {"output": name, "largest": f"{value!r} {units[name]}", "mode": mode}
        for name, value in largest.items()
    ]
    return SceneFile("rig.yaml", written(tree) | {"limits": limits})
