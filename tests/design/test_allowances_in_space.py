"""In space, the allowance of a sea covers the change of an output as a vector, not only of its magnitude."""

import copy
import itertools

import numpy as np
import pytest
from rigs_in_waves import in_waves, limited

from riserstudy.design.sea_allowances import allowances
from riserstudy.study.in_sea import Sea

SEA = Sea(4.0, 10.0)
UNITS = {"lfj_angle": "rad", "ufj_angle": "rad", "bending_moment": "N*m", "shear_force": "N"}


def tree_of(seed, elements):
    """A rig in waves, near the offset at which the lower flex joint is upright."""
    tree = in_waves(seed, False, 17, "4 m", 20, 40.0, [0.1], elements)
    share = float(np.random.default_rng((seed, 3)).uniform(-0.012, 0.004))
    tree["platform"]["position"]["surge"] = share * -float(tree["water"]["seabed"])
    return tree


def found_of(tree):
    file = limited(tree, dict.fromkeys(UNITS, 1e12), UNITS)
    return dict(zip(UNITS, allowances(file, SEA, 1), strict=True))


@pytest.mark.parametrize("seed", [2, 3, 4])
def test_a_rig_that_moves_in_a_plane_has_the_same_allowances_in_space(seed):
    """Where the riser is nearly upright at rest, its angles and moments swing through zero."""
    tree = tree_of(seed, [100])
    spatial = copy.deepcopy(tree)
    spatial["platform"]["position"]["sway"] = 1e-9
    plane, space = found_of(tree), found_of(spatial)
    for name, one in plane.items():
        if one.missing or space[name].missing:
            continue
        assert space[name].value == pytest.approx(one.value, rel=0.01), name
    assert not plane["lfj_angle"].missing


@pytest.mark.parametrize("seed", range(2, 7))
def test_shear_beside_its_jumps_has_the_same_allowance_in_a_plane_and_in_space(seed):
    """The side of a node with the larger shear need not be the one whose shear changes most."""
    tree = tree_of(seed, [100])
    spatial = copy.deepcopy(tree)
    spatial["platform"]["position"]["sway"] = 1e-9
    plane, space = (found_of(one)["shear_force"].by_place for one in (tree, spatial))
    assert plane == pytest.approx(space, rel=1e-6)
    assert plane


@pytest.mark.parametrize("seed", range(2))
def test_a_motion_across_the_offset_adds_as_much_as_one_along_it(seed):
    """The angle at rest has other directions at other offsets, so its direction makes no difference."""
    tree = tree_of(seed, [80])
    tree["current"]["profile"]["surface_speed"] = 0.0
    away = 0.02 * -float(tree["water"]["seabed"])
    values = []
    for surge, sway in itertools.product((0.0, away), repeat=2):
        tree["platform"]["position"] |= {"surge": surge, "sway": sway + 1e-9}
        values.append(found_of(tree)["lfj_angle"].value)
    # 8 and 2 % apart, since at an offset the riser is inclined and stretched; 6 and 10 times by the fault
    assert max(values) == pytest.approx(min(values), rel=0.1)
