"""Contents are one column: below a section without contents, pressure and wall stress are not known."""

import copy
import math

import numpy as np
import pytest
from random_rigs import FOOT, rig, written

from riserstudy.dataset.limits import checked
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def with_its_contents_in_the_weight(tree, name):
    """The same riser, where a section has the weight of its contents in its submerged weight."""
    tree = copy.deepcopy(tree)
    for section in tree["riser"]:
        if section["name"] == name:
            density = section.pop("contents")["density"]
            bore = 0.25 * math.pi * section["inner_diameter"] ** 2
            section["submerged_weight"] += density * tree["gravity"] * bore
    return tree


@pytest.mark.parametrize("seed", range(4))
def test_no_stress_below_a_gap_in_the_contents(seed):
    """Before, the column lost the height of the gap, and the wall below it the pressure of that height."""
    tree = rig(seed, spatial=bool(seed % 2), conductor=True)
    tree["analysis"] = {"mesh": {"elements": 60}}
    tree["limits"] = [
        {"output": "von_mises_stress", "largest": "400 MPa", "mode": "drilling", "at": name}
        for name in ("conductor", tree["riser"][-1]["name"])
    ]
    scenes = [
        SceneFile("rig.yaml", written(one)) for one in (tree, with_its_contents_in_the_weight(tree, "stack"))
    ]
    whole, parted = (run(scene.resolved(), estimated=False) for scene in scenes)
    foot = FOOT + tree["riser"][1]["length"]
    above = whole.arrays["s_node"] > foot + 1e-6
    stresses = [one.arrays["von_mises_stress_static"] for one in (whole, parted)]
    np.testing.assert_allclose(stresses[1][above], stresses[0][above], rtol=1e-6)
    below = whole.arrays["s_node"] < foot - 1e-6
    assert np.isfinite(stresses[0][below]).all()
    assert np.isnan(stresses[1][below]).all()
    checks = checked(scenes[1], scenes[1].resolved(), parted.facts)
    assert [one.verdict for one in checks] == ["not evaluated", "within"]
