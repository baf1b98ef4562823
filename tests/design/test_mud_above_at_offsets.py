"""A limit on the smallest tension is met nowhere and never where mud above the ring takes its margin."""

import math

import pytest
from random_rigs import rig, timed, written

from riserstudy.dataset.limits import WITHIN, checked
from riserstudy.design.operability import AtRest, offsets
from riserstudy.scene.load import SceneFile
from riserstudy.scene.pressures import not_in_tension
from riserstudy.simulation.refine import run

REACH, HIGH = 40.0, 25.0  # m, and of the level above the ring


def below_the_level(seed, offset):
    """A rig whose mud reaches above its ring, and its smallest tension at an offset (N)."""
    tree = rig(seed, spatial=bool(seed % 2), conductor=False)
    for section in tree["riser"]:
        section["contents"]["level"] = tree["top"]["elevation"] + HIGH
    tree["analysis"] = {"mesh": {"elements": 60}}
    rows = AtRest(file_of(tree, []).resolved(), REACH).extremes(offset)
    tension = min(row["smallest"] for row in rows if row["output"] == "effective_tension")
    return tree, tension


def file_of(tree, limits):
    limits = [{"output": "effective_tension", "mode": "connected", **one} for one in limits]
    more = {"limits": limits} if limits else {}
    return SceneFile("rig.yaml", written(tree, unit_of={"level": "m"}) | more)


def at(tree, offset, limits):
    tree["platform"]["position"]["surge"] = offset
    file = file_of(tree, limits)
    return checked(file, file.resolved(), run(file.resolved()).facts)[0].verdict


@pytest.mark.parametrize("seed", range(8))
def test_offsets_are_those_at_which_a_check_finds_it_met(seed):
    tree, tension = below_the_level(seed, 0.5 * REACH)
    mud = not_in_tension(file_of(tree, []).resolved())
    limits = [{"smallest": f"{tension - mud!r} N"}]  # met from half the reach on, or up to there
    found = offsets(file_of(tree, limits).resolved(), REACH, {})[0]
    ends = [(end, side) for end, side in ((found.low, 1), (found.high, -1)) if math.isfinite(end)]
    assert any(abs(end - 0.5 * REACH) < 0.1 for end, _ in ends), found
    for end, side in ends:
        assert at(tree, end + side, limits) == WITHIN, found
        assert at(tree, end - side, limits) != WITHIN, found


@pytest.mark.parametrize("seed", range(4))
def test_a_margin_that_the_mud_takes_everywhere_is_not_evaluated(seed):
    tree, tension = below_the_level(seed, 0.0)
    mud = not_in_tension(file_of(tree, []).resolved())
    limits = [{"smallest": f"{tension - 0.5 * mud!r} N"}]
    found = offsets(file_of(tree, limits).resolved(), 0.1, {})[0]
    assert math.isnan(found.low)
    assert "contents above the riser's upper end" in found.missing


@pytest.mark.parametrize("seed", range(4))
def test_a_run_reaches_it_where_the_mud_takes_its_margin(seed):
    tree, _ = below_the_level(seed, 0.0)
    mud = not_in_tension(file_of(tree, []).resolved())
    tree["platform"]["heave"] = {"amplitude": 2.0, "period": 10.0, "ramp": 10.0}
    tree["analysis"] = timed(20.0, 0.25, 30, 0.5)
    plain = run(file_of(tree, [{"smallest": "0 N"}]).resolved())
    tension = plain.arrays["effective_tension"][:, :-1].min(axis=1)  # of the riser, below the joint
    allowable = 0.5 * float(tension.min() + tension[0]) - mud  # half way to the lowest
    found = run(file_of(tree, [{"smallest": f"{allowable!r} N"}]).resolved())
    times = found.arrays["time"]
    first = times[tension < allowable + mud][0]
    assert first - 0.5 <= found.facts["limits_reached"][0] <= first
