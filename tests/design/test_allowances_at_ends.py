"""At an end of an envelope, demand at rest and the allowance of a sea there together are the allowable."""

import copy

import numpy as np
import pytest
from rigs_in_waves import in_waves, limited

from riserstudy.dataset.limits import demand_of
from riserstudy.design.envelope import envelope
from riserstudy.design.operability import AtRest
from riserstudy.design.sea_allowances import allowances
from riserstudy.study.in_sea import Sea

SEA = Sea(5.0, 11.0)
UNITS = {"tensioner_force": "N", "ufj_angle": "rad", "lfj_angle": "rad"}
AWAY = 0.07  # of the water depth: the end with the allowance at the scene's own offset


def rig_at(tree, offset):
    """The rig with its platform at an offset (m)."""
    tree = copy.deepcopy(tree)
    tree["platform"]["position"]["surge"] = offset
    return tree


def demand(file, offset, reach):
    """Demand (SI) of the only limit of a file for the riser at rest at an offset (m)."""
    scene = file.resolved()
    return demand_of(scene, scene.limits[0], AtRest(scene, reach).extremes(offset))[0]


@pytest.mark.long
@pytest.mark.parametrize("output", UNITS)
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", [1, 3, 4])
def test_the_allowance_of_an_end_is_that_of_a_run_in_the_sea_there(seed, spatial, output):
    """Tensioners are stiffer further out, and a riser under more tension moves less."""
    tree = in_waves(seed, spatial, 31, "5 m", 20, 30.0, [0.1], [640])
    depth = -tree["water"]["seabed"]
    free = limited(tree, {output: 1e12}, UNITS)
    here = allowances(free, SEA, 1)[0]
    assert not here.missing
    at = demand(free, AWAY * depth, 0.12 * depth) + here.value
    file = limited(tree, {output: at}, UNITS)
    found = envelope(file, 0.12 * depth, [tree["current"]["profile"]["surface_speed"]], [SEA], 1)
    assert not found.missing
    (row,) = found.table.rows
    ends = [end for end in row[3:5] if end is not None]
    assert ends
    for end in ends:
        there = allowances(limited(rig_at(tree, end), {output: at}, UNITS), SEA, 1)[0]
        total = demand(file, end, 0.12 * depth) + there.value
        # the offset has an error of 5 cm, and the allowance is interpolated to it from a first end
        slope = abs(demand(file, end + 0.5, 0.12 * depth) - demand(file, end - 0.5, 0.12 * depth))
        assert total == pytest.approx(at, abs=0.03 * there.value + 0.05 * slope)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_an_envelope_does_not_depend_on_the_offset_of_the_scene(seed):
    """Except for the interpolation of allowances."""
    tree = in_waves(seed, False, 31, "5 m", 20, 30.0, [0.1], [160])
    depth = -tree["water"]["seabed"]
    speed = tree["current"]["profile"]["surface_speed"]
    found = []
    for own in (0.0, 0.04 * depth):
        file = limited(rig_at(tree, own), {"lfj_angle": 0.1}, UNITS)
        (row,) = envelope(file, 0.12 * depth, [speed], [SEA], 1).table.rows
        found.append([np.nan if end is None else end for end in row[3:5]])
    assert np.isfinite(found).any()
    np.testing.assert_allclose(*found, atol=0.001 * depth)
