"""A riser's top beside the centre about which its platform turns has a warning, unless the place is given."""

import copy

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.model.warnings_of_scene import warnings_of
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile

PATH = "platform.centre_of_rotation.x: "


def turning(seed, turn):
    """A rig in motion at an offset from the well, below a platform with one turn, and the offset (m)."""
    tree = moving(seed, spatial=True, conductor=False)
    draw = np.random.default_rng((seed, 5))
    period = tree["platform"]["surge"]["period"]
    for name in ("roll", "pitch", "yaw"):
        tree["platform"].pop(name, None)
    tree["platform"][turn] = {"amplitude": 0.02, "period": period, "ramp": period}
    offset = float(draw.uniform(0.01, 0.03) * draw.choice([-1.0, 1.0])) * -tree["water"]["seabed"]
    tree["platform"]["position"]["surge"] = 0.0
    tree["top"]["offset"] = offset
    return tree, offset


def said(tree, **about):
    tree = copy.deepcopy(tree)
    made = written(tree)
    made["platform"]["centre_of_rotation"] |= about
    found = sentences(warnings_of(SceneFile("rig.yaml", made).resolved()))
    return [line for line in found if line.startswith(PATH)]


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("turn", ["pitch", "yaw"])
def test_a_turn_about_the_well_is_said_until_its_place_is_given(seed, turn):
    tree, offset = turning(seed, turn)
    (line,) = said(tree)
    assert f"each degree of {turn} moves" in line
    assert f"give {offset:g} m;" in line
    assert said(tree, x=f"{offset!r} m") == said(tree, x="0 m") == []


@pytest.mark.parametrize("seed", range(8))
def test_other_rigs_have_no_such_warning(seed):
    tree, offset = turning(seed, "pitch")
    rolls, _ = turning(seed, "roll")  # about the axis through the centre and the top
    above, moved = copy.deepcopy(tree), copy.deepcopy(tree)
    above["top"]["offset"] = 1e-4 * offset
    moved["top"]["offset"], moved["platform"]["position"]["surge"] = 0.0, offset
    assert [said(one) for one in (rolls, above, moved)] == [[], [], []]
