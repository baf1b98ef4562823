"""The rotation of a current in a deck is continuous over depth, and comes back as the same velocity."""

import numpy as np
import pytest
import yaml
from drawn_decks import file_of, there_and_back
from random_rigs import rig, written

from riserstudy.export.orcaflex import write_deck
from riserstudy.model.sea import current_velocity

ROWS = "CurrentDepth, CurrentFactor, CurrentRotation"


@pytest.mark.parametrize("seed", range(8))
def test_a_current_that_turns_past_the_opposite_direction(seed, tmp_path):
    draw = np.random.default_rng(seed)
    tree = written(rig(seed, spatial=True, conductor=False))
    depth = -float(tree["water"]["seabed"].split()[0])
    turned = float(draw.uniform(100.0, 170.0)) + np.cumsum(draw.uniform(5.0, 40.0, 9))
    tree["current"] = {
        "headings": "towards",
        "profile": [
            {
                "depth": f"{at} m",
                "speed": f"{draw.uniform(0.2, 1.0)} m/s",
                "direction": f"{angle % 360.0} deg",
            }
            for at, angle in zip(np.linspace(0.0, depth, 9), turned, strict=True)
        ],
    }
    file = file_of(tree)
    deck = yaml.safe_load(write_deck(file).text.lstrip("\ufeff"))
    rotation = np.array([row[2] for row in deck["Environment"][ROWS]])
    assert abs(np.diff(rotation)).max() < 60.0
    scene, back = file.resolved(), there_and_back(file, tmp_path)[0].resolved()
    (z, one), (also, two) = (current_velocity(s.current, s.water) for s in (scene, back))
    for x, y in zip(one, two, strict=True):
        np.testing.assert_allclose(np.interp(z, also, y), x, atol=1e-6)
