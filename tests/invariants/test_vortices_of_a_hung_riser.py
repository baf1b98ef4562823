"""What vortices may do to a hung-off riser is known from its top: seeded rigs."""

import numpy as np
import pytest
from random_rigs import rig, timed, written

from riserstudy.model.vortices import slowest, synchronised
from riserstudy.scene.load import SceneFile

FREQUENCIES = (0.02, 0.05, 0.1, 0.2)  # Hz
VIV = {
    "model": "synchronisation",
    "coefficient": 1.2,
    "frequencies": [0.11, 0.18, 0.26],
    "memory": 20.0,
    "seed": 1,
}


def pair(seed, down=0.0):
    """One rig held at the well, and hung off at the same height; elevations are less by ``down`` (m)."""
    tree = rig(seed, spatial=True, conductor=False)
    tree["top"].pop("tensioners"), tree["top"].pop("telescopic_joint")
    for section in tree["riser"]:
        section["viv"] = VIV | {"diameter": section["outer_diameter"]}
    tree["analysis"] = timed(9e3, 0.2, 50, 0.5)
    foot = tree["bottom"]["elevation"] - down
    tree["top"]["elevation"] = foot + sum(section["length"] for section in tree["riser"])
    for name in ("surface", "seabed"):
        tree["water"][name] -= down
    tree["bottom"]["elevation"] = foot
    hung = tree | {"bottom": {"hold": "free"}}
    return [SceneFile("rig.yaml", written(one)).resolved() for one in (tree, hung)]


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("down", [0.0, 400.0, -700.0])
def test_frequencies_are_those_of_the_current_at_its_depth(seed, down):
    held, hung = pair(seed, down)
    (same, _) = pair(seed)
    assert slowest(hung) == pytest.approx(slowest(held), rel=1e-12)
    assert slowest(hung) == pytest.approx(slowest(same), rel=1e-9)
    for frequency in FREQUENCIES:
        share = synchronised(hung, frequency)
        np.testing.assert_allclose(share, synchronised(held, frequency), rtol=1e-12)
        np.testing.assert_allclose(share, synchronised(same, frequency), atol=0.006)
