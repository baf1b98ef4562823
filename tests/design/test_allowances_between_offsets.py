"""Allowances between offsets, and ends at which no run in the sea can be completed."""

import math

import numpy as np
import pytest

from riserstudy.design.allowances_by_offset import ByOffset, ends_of, with_ends
from riserstudy.design.operability import Offsets
from riserstudy.design.sea_allowances import Allowance
from riserstudy.errors import SimulationError
from riserstudy.scene.limits import Limit


def limits_of(modes):
    return [Limit(output="lfj_angle", largest="4 deg", mode=mode) for mode in modes]


@pytest.mark.parametrize("seed", range(20))
def test_an_allowance_is_its_own_at_its_offsets_and_between_its_neighbours_elsewhere(seed):
    draw = np.random.default_rng(seed)
    offsets = np.sort(draw.uniform(-200.0, 200.0, int(draw.integers(1, 4)))).tolist()
    places = ("", "lower joints", "upper joints")
    values = {name: draw.uniform(0.1, 2.0, len(offsets)).tolist() for name in places}
    each = [Allowance(0.0, "", {name: values[name][k] for name in places}) for k in range(len(offsets))]
    made = ByOffset(offsets, each)
    for k, offset in enumerate(offsets):
        assert made.at(offset) == pytest.approx({name: values[name][k] for name in places})
    for offset in draw.uniform(-300.0, 300.0, 50).tolist():
        for name, found in made.at(offset).items():
            k = int(np.searchsorted(offsets, offset))
            near = values[name][max(k - 1, 0) : k + 1]
            assert min(near) - 1e-12 <= found <= max(near) + 1e-12


@pytest.mark.parametrize("seed", range(20))
def test_no_limit_is_met_by_allowances_that_are_not_known(seed):
    """Ends that nearly are an offset with known allowances are not simulated."""
    draw = np.random.default_rng(seed)
    limits = limits_of(draw.choice(["drilling", "connected"], 4).tolist())
    own = (float(draw.uniform(-50.0, 50.0)), [Allowance(1.0)] * 4)
    tried = []

    def fails(offset):
        tried.append(offset)
        raise SimulationError("a step fails")

    ends = [own[0] - 60.0, own[0] + 0.5]
    found = with_ends(limits, own, ends, 200.0, fails)
    assert tried == ends[:1]
    assert all("a step fails" in one.missing for one in found)
    assert not any(one.missing for one in with_ends(limits, own, [], 200.0, fails))


def test_ends_are_those_of_all_modes_and_limits_without_a_range_do_not_count():
    limits = limits_of(["drilling", "drilling", "connected", "connected"])
    gone = Offsets(math.nan, math.nan, "a tension")
    found = [Offsets(-40.0, 70.0), Offsets(-60.0, 50.0), Offsets(-90.0, math.inf), gone]
    assert ends_of(limits, found, 200.0) == [-90.0, 200.0]
    assert ends_of(limits[:2], found[:2], 200.0) == [-40.0, 50.0]
    assert ends_of(limits[:1], [gone], 200.0) == []
    # limits that are met at different offsets: both ends of the gap
    assert ends_of(limits[:2], [Offsets(-40.0, -10.0), Offsets(20.0, 50.0)], 200.0) == [-10.0, 20.0]
