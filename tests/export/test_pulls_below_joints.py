"""Vertical pulls below a telescopic joint, which a deck has only along the joint, are refused by name."""

import numpy as np
import pytest
from drawn_decks import file_of
from random_rigs import at_mid_stroke, rig, written
from test_ends_in_decks import below_water, is_same

from riserstudy.errors import InputError
from riserstudy.export.orcaflex import write_deck


def pulled(seed, kind):
    """A rig below water in a current, which is pulled in one of several ways."""
    tree = below_water(seed)
    top = tree["top"]
    of = top["tensioners"]
    pull = of["count"] * at_mid_stroke(of)
    if kind == "upright":
        del of["arrangement"]
    elif kind != "inclined":
        del top["tensioners"]
    tree = written(tree)
    if kind == "vertical":
        tree["top"]["tension"] = f"{pull!r} N"
    elif kind == "along the joint":
        tree["top"]["telescopic_joint"]["tension"] = f"{pull!r} N"
    elif kind == "both":
        tree["top"]["tension"] = f"{0.4 * pull!r} N"
        tree["top"]["telescopic_joint"]["tension"] = f"{0.6 * pull!r} N"
    return file_of(tree)


@pytest.mark.parametrize("kind", ["inclined", "upright", "vertical", "along the joint", "both"])
@pytest.mark.parametrize("seed", range(6))
def test_a_pull_below_a_joint_is_as_in_the_scene_or_is_refused(tmp_path, seed, kind):
    file = pulled(seed, kind)
    named = {"upright": "top.tensioners.arrangement", "vertical": "top.tension", "both": "top.tension"}
    if kind in named:
        with pytest.raises(InputError) as refused:
            write_deck(file)
        assert named[kind] in str(refused.value)
    else:
        assert is_same(file, tmp_path)


@pytest.mark.parametrize("narrow", ["deck_radius", "ring_radius"])
@pytest.mark.parametrize("seed", range(6))
def test_cylinders_that_meet_in_one_point_come_back(tmp_path, seed, narrow):
    tree = below_water(seed)
    place = tree["top"]["tensioners"]["arrangement"]
    place[narrow] = 0.0
    place["first_bearing"] = float(np.random.default_rng(seed).choice([0.0, 1e-9, -1e-9, 1.0, 6.0]))
    assert is_same(file_of(written(tree)), tmp_path)


@pytest.mark.parametrize("seed", range(3))
def test_the_fixed_foot_of_a_deck_is_named(seed):
    tree = written(rig(seed, conductor=True))
    clay = {"strength_at_mudline": "40 kPa", "strength_gradient": "0 N/m^3", "depth_factor": 0.5}
    clay |= {"submerged_unit_weight": "8 kN/m^3", "strain_at_half_strength": 0.01, "straight_up_to": 0.1}
    tree["soil"] = {"mudline": tree["water"]["seabed"], "resistance": clay}
    assert any(line.startswith("bottom.hold:") for line in write_deck(file_of(tree)).left_out)
