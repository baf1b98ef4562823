"""Upright cylinders follow the deck, which moves up and down by heave and by tilts about a centre aside."""

import numpy as np
import pytest
from random_rigs import on_cylinders, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def tilting(seed, spatial):
    """A rig in motion on upright cylinders, below a platform that tilts about a centre aside."""
    draw = np.random.default_rng((seed, 11))
    tree = on_cylinders(seed, "count", spatial=spatial, conductor=False)
    tree["top"]["tensioners"].pop("arrangement", None)
    size, period = float(draw.uniform(0.01, 0.05)), float(draw.uniform(8.0, 14.0))
    tilts = ("pitch", "roll") if spatial else ("pitch",)
    for name in tilts:
        tree["platform"][name] = {"amplitude": size, "period": period, "ramp": period}
        tree["platform"]["position"][name] = f"{float(draw.uniform(-0.02, 0.02))!r} rad"
    reaches = {"x": 30.0, "elevation": 10.0} | ({"y": 20.0} if spatial else {})
    tree["platform"]["centre_of_rotation"] = {
        name: f"{float(draw.uniform(-most, most))!r} m" for name, most in reaches.items()
    }
    return tree


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("spatial", [False, True])
def test_upright_cylinders_are_as_long_as_the_ring_is_below_the_deck(seed, spatial):
    """The upper end of the joint is a point of the deck; the audit sees the power that the deck supplies."""
    tree = tilting(seed, spatial)
    tree["analysis"]["output"]["interval"] = tree["analysis"]["step"]  # nothing is interpolated
    tree["analysis"]["mesh"]["elements"] *= 4  # on few segments, energy is lost in bending
    found = run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False)
    z, stroke = found.arrays["z"], found.arrays["tensioner_stroke"]
    assert np.ptp(z[:, -1] - z[:, -2] - stroke[:, 0]) <= 1e-9 * np.ptp(stroke)
    assert np.ptp(stroke, axis=1).max() == 0.0
    assert abs(found.facts["audit"]["unexplained_share"]) <= 0.01
