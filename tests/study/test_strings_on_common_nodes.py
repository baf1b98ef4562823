"""Envelopes at common nodes do not depend on the mesh, although the motion has a kink at the tension ring.

The telescopic joint strokes above the ring. A smooth curve through the nodes on both sides would overshoot.
"""

import numpy as np
import pytest
from random_rigs import rig, timed, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.refine import run
from riserstudy.study.collect import laid_on

AMPLITUDE = 3.0  # m
NEAR = 1e-4  # of the amplitude, between meshes of a riser that moves along its axis only
ASIDE = 5e-3  # the same with lateral motion, whose error on these meshes is larger


def heaving(seed, kind):
    """A rig below a platform that heaves, with axial motion only, or with all motions in a plane or in space.

    With axial motion only, its cylinders are inclined or upright.
    """
    tree = rig(seed, spatial=kind == "space", conductor=False)
    draw = np.random.default_rng(seed)
    period = float(draw.uniform(8.0, 14.0))
    heave = {"heave": {"amplitude": AMPLITUDE, "period": period, "ramp": period}}
    tree["platform"] |= heave
    if kind in ("inclined", "upright"):
        tree["platform"] = heave
        del tree["current"], tree["bottom"]["rotation"], tree["top"]["rotation"], tree["top"]["x"]
        for section in tree["riser"]:
            del section["drag"], section["added_mass"]
        if kind == "upright":
            del tree["top"]["tensioners"]["arrangement"]
    tree["analysis"] = timed(30.0, 0.1, 40, 0.5) | {"method": "ESDIRK4"}
    return tree


@pytest.mark.parametrize("kind", ["upright", "inclined", "plane", "space"])
@pytest.mark.parametrize("seed", range(6))
def test_envelopes_between_nodes_are_those_of_another_mesh(seed, kind):
    tree, draw = heaving(seed, kind), np.random.default_rng(100 + seed)
    few = int(draw.integers(20, 40)) * (4 if kind in ("plane", "space") else 1)
    runs = []
    for count in (few, few + int(draw.integers(1, 9))):
        tree["analysis"]["mesh"] = {"elements": count}
        runs.append(run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False))
    one, other = runs
    assert ("x" in one.arrays) == (kind in ("plane", "space"))
    assert np.ptp(one.arrays["stroke"]) > AMPLITUDE  # the joint strokes
    near = ASIDE if "x" in one.arrays else NEAR
    laid = laid_on(one, other.arrays["s_node"]).arrays
    for name in ("z_max", "z_min", "z_static"):
        assert np.abs(laid[name] - other.arrays[name]).max() < near * AMPLITUDE, name
    assert difference(one, other)["displacement"] < near
