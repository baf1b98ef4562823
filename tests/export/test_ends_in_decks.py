"""Ends that a deck can hold only otherwise are refused; all other decks read back are the same riser."""

import numpy as np
import pytest
from drawn_decks import file_of, there_and_back
from random_rigs import rig, written

from riserstudy import simulate
from riserstudy.errors import InputError

MESH = {"analysis": {"mesh": {"elements": 30}}}
PLACES = {"surge": 9.0, "sway": 6.0, "heave": 0.4}  # m
DIGIT = 1e-6  # last digit of a place in a deck (m)


def below_water(seed):
    """A rig whose riser is in the water up to its ring, and its platform at rest above the well."""
    tree = rig(seed, conductor=False)
    ring = tree["top"]["elevation"] - tree["top"]["telescopic_joint"]["length"]
    tree["water"]["surface"] = max(0.0, ring + 1.0)
    tree["top"]["tensioners"]["mid_stroke"] = "riser unstretched"
    tree["platform"]["position"] = {}
    return tree


def is_same(file, folder):
    """Whether a deck read back is the same riser at rest, apart from the last digits of a deck's numbers.

    A deck has places in micrometres: about as far apart may places be, and moments as the tension times that.
    """
    back, _ = there_and_back(file, folder)
    one, other = (simulate(f.with_values(MESH, "test"), progress=False) for f in (file, back))
    digits = dict.fromkeys("xyz", 5.0 * DIGIT)
    digits["bending_moment"] = DIGIT * float(np.abs(one["effective_tension"]).max())
    for name in ("effective_tension", "bending_moment", "x", "z", "y"):
        a, b = (run[name].to_numpy() if name in run else np.zeros(1) for run in (one, other))
        if np.abs(a - b).max() > 2e-3 * np.abs(a).max() + digits.get(name, DIGIT):
            return False
    return True


@pytest.mark.parametrize("hold", ["held x", "held z", "platform"])
@pytest.mark.parametrize("motion", [*PLACES, None])
@pytest.mark.parametrize("seed", range(3))
def test_a_joint_follows_the_platform_as_in_the_scene_or_is_refused(tmp_path, seed, hold, motion):
    tree = below_water(seed)
    if hold != "platform":
        tree["top"][hold[-1]] = "held"
    tree["platform"]["position"] = {motion: PLACES[motion]} if motion else {}
    file = file_of(written(tree, unit_of={"heave": "m"}))
    held_back = {"held x": ("surge", "sway"), "held z": ("heave",)}.get(hold, ())
    if motion in held_back:
        with pytest.raises(InputError, match=rf"top\.{hold[-1]}: held"):
            is_same(file, tmp_path)
    else:
        assert is_same(file, tmp_path)


@pytest.mark.parametrize("z", ["held", "platform"])
@pytest.mark.parametrize("x", ["held", "platform", "free"])
@pytest.mark.parametrize("seed", range(3))
def test_a_bare_end_is_held_as_in_the_scene_or_is_refused(tmp_path, seed, x, z):
    tree = below_water(seed)
    ring = tree["top"]["elevation"] - tree["top"]["telescopic_joint"]["length"]
    tree["top"] = {"x": x, "z": z, "elevation": ring + 0.3, "rotation": "free"}
    tree["platform"]["position"] = {"surge": 9.0} if x == "platform" else {}
    file = file_of(written(tree))
    if x == "free":
        with pytest.raises(InputError, match=r"top\.x: free"):
            is_same(file, tmp_path)
    else:
        assert is_same(file, tmp_path)


@pytest.mark.parametrize("names", [["Inner barrel"], ["inner BARREL", "Inner barrel of the joint"]])
@pytest.mark.parametrize("seed", range(4))
def test_names_of_sections_are_not_those_of_parts_of_the_deck(tmp_path, seed, names):
    tree = below_water(seed)
    for section, name in zip(tree["riser"], names, strict=False):
        section["name"] = name
    assert is_same(file_of(written(tree)), tmp_path)


def test_a_section_is_not_called_what_a_deck_reads_as_a_default(tmp_path):
    tree = below_water(1)
    tree["riser"][-1]["name"] = "~"
    with pytest.raises(InputError, match=rf"riser\[{len(tree['riser']) - 1}\]\.name: ~; .* Rename it"):
        is_same(file_of(written(tree)), tmp_path)


@pytest.mark.parametrize("share", [0.0, 0.6, 1.0, 1.0003, 1.1, 3.0])
@pytest.mark.parametrize("seed", range(3))
def test_a_ring_weighs_as_in_the_scene_or_is_refused(tmp_path, seed, share):
    tree = below_water(seed)
    mass = 2e4 * (1 + seed)
    weight = f"{share * mass * 9.80665!r} N"
    tree = written(tree)
    tree["top"]["body"] = {"name": "ring", "mass": f"{mass} kg", "submerged_weight": weight}
    file = file_of(tree)
    if share > 1.01:
        with pytest.raises(InputError, match=r"top\.body\.submerged_weight: .*more than"):
            is_same(file, tmp_path)
    else:
        assert is_same(file, tmp_path)
