"""Offsets at which limits are reached, for demands that are known functions of the offset: dense scans."""

import math
from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene
from riserstudy.design.operability import CLOSE, AtRest, offsets_at
from riserstudy.errors import SimulationError

SCENE = Path(__file__).parents[2] / "config/scenes/design/riser.yaml"
REACH = 100.0
FIRST = np.linspace(-REACH, REACH, 17)
ALLOWED = 0.5  # rad
LIMIT = {"output": "ufj_angle", "mode": "drilling"}


@pytest.fixture(scope="module")
def scene():
    """A riser with a limit on an extreme, and one on the mean."""
    limits = [LIMIT | {side: f"{ALLOWED} rad"} for side in ("largest", "mean")]
    return load_scene(SCENE).with_values({"limits": limits, "analysis.mesh": None}, "test").resolved()


class Known(AtRest):
    """At rest with a demand that is a function of the offset, and without equilibrium beyond one."""

    def __init__(self, scene, demand, before, beyond):
        self.scene, self.reach, self.rows, self.lost = scene, REACH, {}, {}
        self.demand, self.beyond = demand, beyond
        for offset in before:  # for other limits
            self.extremes(offset)

    def extremes(self, offset):
        """Rows of one output."""
        if offset > self.beyond:
            self.lost[offset] = "lost"
            raise SimulationError("lost")
        value = self.demand(offset)
        sides = {"largest": 0.3 * value, "smallest": -value, "mean": value}
        self.rows[offset] = [{"output": "ufj_angle", "where": "", **sides}]
        return self.rows[offset]


def drawn(draw):
    """A demand (rad), as a function of the offset: with one range below a value, or two."""
    middle, wide, less = draw.uniform(-50.0, 50.0), draw.uniform(1.0, 70.0), draw.uniform(0.05, 0.3)
    kind = draw.random()
    if kind < 0.2:  # exceeded about a maximum, of which the first offsets may show nothing
        wide = draw.uniform(9.0, 20.0)
        return lambda x: ALLOWED + less * (2.0 / (1.0 + ((x - middle) / wide) ** 2) - 1.0)
    if kind < 0.7:
        power = draw.uniform(1.0, 3.0)
        return lambda x: ALLOWED + less * (abs((x - middle) / wide) ** power - 1.0)
    gap = draw.uniform(20.0, 70.0)
    top = draw.uniform(0.5, 3.0) * less
    return lambda x: ALLOWED - less + top * (((x - middle) / gap) ** 2 - 1.0) ** 2


@pytest.mark.parametrize("beyond", [math.inf, 40.0])
@pytest.mark.parametrize("added", [0.0, 0.04])
@pytest.mark.parametrize("seed", range(40))
def test_offsets_are_those_of_a_dense_scan(scene, seed, added, beyond):
    draw = np.random.default_rng(seed)
    demand, which = drawn(draw), int(draw.integers(2))
    before = draw.uniform(-REACH, min(REACH, beyond), draw.integers(0, 4)).tolist()
    at = Known(scene, demand, before, beyond)
    (found,) = offsets_at(at, [scene.limits[which]], REACH, {"ufj_angle": added})
    allowance = 0.0 if which else added  # means have none
    scan = np.linspace(-REACH, REACH, 40001)
    excess = demand(scan) + allowance - ALLOWED
    ends = np.flatnonzero((excess[1:] > 0.0) != (excess[:-1] > 0.0))
    ends = np.r_[-math.inf, 0.5 * (scan[ends] + scan[ends + 1]), math.inf]
    tried = np.r_[[one for one in FIRST if one <= beyond], before]
    met = [one for one in FIRST if demand(one) + allowance <= ALLOWED and one <= beyond]
    best = min(met, key=lambda one: (abs(one), demand(one)), default=min(tried, key=demand))
    if demand(best) + allowance > ALLOWED:  # between those that are tried first
        best = scan[scan <= beyond][excess[scan <= beyond].argmin()]
        if demand(best) + allowance > ALLOWED:
            assert math.isnan(found.low)
            assert found.missing == ""
            return
    low, high = ends[ends < best].max(), ends[ends > best].min()
    if beyond < math.inf and not any(high < one for one in tried[tried > best]):
        assert "lost" in found.missing  # it may be reached where nothing is known
        return
    assert found.low == pytest.approx(low, abs=2.0 * CLOSE)
    assert found.high == pytest.approx(high, abs=2.0 * CLOSE)
    also = min((abs(one) for one in met if not low <= one <= high), default=math.nan)
    assert abs(found.also) == pytest.approx(also, nan_ok=True)


@pytest.mark.parametrize("seed", range(20))
def test_limits_that_are_all_met_at_the_well_have_an_envelope_that_contains_it(scene, seed):
    """Also if some of them are met elsewhere with a larger margin."""
    draw, found = np.random.default_rng(seed), []
    while len(found) < 5:
        demand = drawn(draw)
        if demand(0.0) > ALLOWED:
            continue
        found += offsets_at(Known(scene, demand, [], math.inf), [scene.limits[1]], REACH, {})
    assert max(one.low for one in found) <= 0.0 <= min(one.high for one in found)


@pytest.mark.parametrize("seed", range(30))
def test_a_limit_that_is_exceeded_between_two_offsets_and_met_again_ends_its_range(scene, seed):
    """As an angle that falls when cylinders reach their stops, and rises again further out."""
    draw = np.random.default_rng(seed)
    first = float(draw.uniform(15.0, 45.0))
    again = first + float(draw.uniform(8.0, 20.0))
    third = again + float(draw.uniform(15.0, 35.0))
    x = [0.0, first, again - 2.0, again, 0.5 * (again + third), third, 200.0]
    y = [-1.0, 0.0, 0.5, 0.0, -float(draw.uniform(0.3, 1.0)), 0.0, 3.0]
    side = float(draw.choice([-1.0, 1.0]))

    def demand(offset):
        return ALLOWED + 0.1 * np.interp(max(side * offset, 0.0), x, y)

    (found,) = offsets_at(Known(scene, demand, [], math.inf), [scene.limits[1]], REACH, {})
    ends = {-1.0: (found.low, found.high), 1.0: (found.high, found.low)}[side]
    assert ends == (pytest.approx(side * first, abs=2.0 * CLOSE), -side * math.inf)
