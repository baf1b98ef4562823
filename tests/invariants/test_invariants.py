"""Results do not depend on how a scene is written: seeded rigs in motion, each written in one other way."""

from __future__ import annotations

import os

import numpy as np
import pytest
from changes import ALONG, EXTREMES, OVER_TIME, WAYS, rotated, swayed_by_nothing
from random_rigs import moving, written

from riserstudy.errors import SimulationError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

COUNT = int(os.environ.get("RISERSTUDY_INVARIANTS", "200"))
FIRST = int(os.environ.get("RISERSTUDY_INVARIANTS_FIRST", "0"))
IN_A_TEST = 10  # scenes
INTO_SPACE = (rotated, swayed_by_nothing)
#: an angle between steps is within the peaks of the steps: of its sign in a plane, of its size in space
SIGNED_OR_SIZE = 5e-3
SMALL = 1e-3  # rad: smaller angles are compared as this one


def outputs_of(tree):
    """Outputs of a run by its own mesh and step, without an estimate of its error."""
    arrays = run(SceneFile("rig.yaml", tree).resolved(), estimated=False).arrays
    return {name: arrays[name] for name in (*ALONG, *OVER_TIME, *EXTREMES) if name in arrays}


def faults_of(seed):
    """How far a rig and the same rig written otherwise are apart, a line an output; none where they agree."""
    draw = np.random.default_rng((seed, 7))
    tree, way = moving(seed), WAYS[seed % len(WAYS)]
    try:
        plain = outputs_of(written(tree))
    except SimulationError:
        return  # that it fails does not depend on the way either, but its message does
    other = way(tree, draw)
    found = other.back(outputs_of(other.tree))
    if "y" in found and "y" not in plain:  # brought into space
        plain |= {"y": np.zeros_like(plain["x"])}
        for name in ("bending_moment", "ufj_angle", "lfj_angle"):
            plain[name] = abs(plain[name])
    for name, values in found.items():
        if name in plain:
            expected = plain[name]
            if len(values) != len(expected):
                expected = expected[::2] if len(values) == len(expected[::2]) else expected
            size = float(np.nanmax(abs(expected))) or 1.0
            if name in ("x", "y", "z"):
                size = max(size, 1.0)
            elif name.endswith("_angle"):
                size = max(size, SMALL)
            off = float(np.nanmax(abs(values - expected)))
            within = max(other.within, 1e-13)
            if name.endswith("_angle") and way in INTO_SPACE:
                within = SIGNED_OR_SIZE
            if off > within * size:
                yield f"seed {seed}, {way.__name__}: {name} by {off / size:.2g} of {size:.3g}"


@pytest.mark.parametrize("first", range(FIRST, FIRST + COUNT, IN_A_TEST))
def test_a_scene_written_otherwise_has_the_same_results(first):
    faults = [fault for seed in range(first, first + IN_A_TEST) for fault in faults_of(seed)]
    assert not faults, "\n".join(faults)
