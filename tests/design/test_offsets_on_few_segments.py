"""On a user's mesh of few segments an offset is given where its limit is reached, or it is not evaluated."""

import copy
import math

import pytest
from random_rigs import rig, written

from riserstudy.dataset.limits import demand_of
from riserstudy.design.operability import AtRest, offsets
from riserstudy.scene.load import SceneFile

OUTPUTS = {"bending_moment": "N*m", "von_mises_stress": "Pa", "lfj_angle": "rad"}
REACH, FINE = 30.0, 400
OFF = 1.08  # demand at an offset over its allowable, at most: 5 % of error, and that of the estimate


def on(tree, elements, limits):
    tree = copy.deepcopy(tree)
    tree["analysis"] = {"mesh": {"elements": elements}}
    return SceneFile("rig.yaml", written(tree) | {"limits": limits}).resolved()


def limit(output, largest):
    return {"output": output, "largest": f"{largest!r} {OUTPUTS[output]}", "mode": "drilling"}


@pytest.mark.parametrize("seed", range(10))
def test_demands_at_the_offsets_are_those_of_a_fine_mesh(seed):
    tree = rig(seed, spatial=bool(seed % 2), conductor=False)
    open_ended = on(tree, FINE, [limit(name, 1e30) for name in OUTPUTS])
    fine = AtRest(open_ended, REACH)
    evaluated = [one for one in open_ended.limits if demand_of(open_ended, one, fine.extremes(0.0))]

    def demand(one, offset):
        return demand_of(open_ended, one, fine.extremes(offset))[0]

    limits = [limit(one.output, demand(one, 0.5 * REACH)) for one in evaluated]
    few = on(tree, 12, limits)
    for one, found in zip(few.limits, offsets(few, REACH, {}), strict=True):
        for end in (found.low, found.high):
            if math.isfinite(end) and abs(end) < REACH:
                assert demand(one, end) <= OFF * one.allowable, (one.output, end, found.missing)
