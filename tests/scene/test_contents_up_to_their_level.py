"""Contents that do not fill their highest section are refused, wherever the scene gives the elevation."""

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile


def hung(seed, below_top):
    """A riser that hangs from the platform, full of fluid up to a level below its upper end (m)."""
    tree = written(rig(seed, spatial=False, conductor=False))
    above = float(tree["top"]["elevation"].split()[0])
    length = above - float(tree["bottom"]["elevation"].split()[0])
    for section in tree["riser"]:
        section["contents"]["level"] = f"{above - below_top} m"
    tree["top"] = {"x": "platform", "z": "platform", "elevation": f"{above} m", "rotation": "free"}
    tree["bottom"] = {"hold": "free"}
    return tree, length


@pytest.mark.parametrize("seed", range(12))
def test_a_level_below_the_upper_end_is_refused_if_the_riser_hangs(seed):
    """Its length has no rounded elevations, but levels may be as rounded as those of other risers."""
    draw = np.random.default_rng(seed)
    tree, length = hung(seed, 0.0)
    SceneFile("rig.yaml", tree).resolved()
    tree, _ = hung(seed, float(draw.uniform(1.0 + 0.004 * length, 0.1 * length)))
    with pytest.raises(InputError, match="below the upper end of the section"):
        SceneFile("rig.yaml", tree).resolved()
