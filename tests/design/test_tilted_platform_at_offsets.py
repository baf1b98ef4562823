"""A platform with a list keeps the height of its deck above the riser at every offset."""

from __future__ import annotations

import copy

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.design.operability import AtRest
from riserstudy.scene.load import SceneFile

OUTPUTS = ("tensioner_stroke", "tensioner_force", "joint_stroke")


def tilted(seed: int, spatial: bool) -> dict:
    """A rig whose platform has a list about a point beside the upper end of the riser, at its height.

    The list therefore does not move the upper end horizontally.
    """
    tree = rig(seed, spatial=spatial, conductor=False)
    draw = np.random.default_rng((seed, 5))
    position = {"pitch": f"{float(draw.uniform(1.0, 3.0))!r} deg"}
    if spatial:
        position["roll"] = f"{float(draw.uniform(-2.0, 2.0))!r} deg"
    aside = float(draw.uniform(-15.0, 15.0))
    centre = {"x": f"{aside!r} m", "elevation": tree["top"]["elevation"]}
    tree["platform"] = {"position": position, "centre_of_rotation": centre}
    tree["top"] |= {"z": "platform", "rotation": "free"}
    tree["analysis"] = {"mesh": {"elements": 30}}
    return tree


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_a_held_top_and_a_platform_are_at_the_same_offset_with_the_same_list(seed: int, spatial: bool):
    """The platform moves with the top, whether the top is held or follows it."""
    follows = tilted(seed, spatial)
    held = copy.deepcopy(follows)
    held["top"]["x"] = "held"
    offset = 0.03 * -follows["water"]["seabed"]
    one, other = (AtRest(SceneFile("rig.yaml", written(tree)).resolved(), offset) for tree in (follows, held))
    for at in (0.0, offset):
        rows = ({r["output"]: r for r in scene.extremes(at) if r["where"] == ""} for scene in (one, other))
        there, here = rows
        for name in OUTPUTS:
            for side in ("largest", "smallest"):
                size = max(abs(there[name][side]), 1.0)
                assert here[name][side] == pytest.approx(there[name][side], abs=1e-3 * size), (at, name)
