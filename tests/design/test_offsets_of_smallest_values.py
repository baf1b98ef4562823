"""Smallest tensions and strokes are least near the well: limits on them can be met on both sides of it alone.

A scan of offsets, finer than the first offsets of the search, shows what is met where.
"""

import math

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.dataset.limits import demand_of
from riserstudy.design.envelope import envelope
from riserstudy.design.operability import AtRest, offsets
from riserstudy.scene.load import SceneFile

OUTPUTS = {"tensioner_stroke": "m", "effective_tension": "N"}
SCANNED = 33  # offsets
BETWEEN = 0.1  # m, tolerance of an end


def in_a_current(seed):
    """A rig in a current that bends it, and the reach of a search (m)."""
    tree = rig(seed, spatial=bool(seed % 2), conductor=False)
    tree["current"]["profile"]["surface_speed"] = 1.2
    tree["analysis"] = {"mesh": {"elements": 32}}
    return tree, -0.08 * tree["water"]["seabed"]


def file_of(tree, output, smallest):
    limit = {"output": output, "smallest": f"{smallest!r} {OUTPUTS[output]}", "mode": "connected"}
    return SceneFile("rig.yaml", written(tree) | {"limits": [limit]})


def scan(tree, output, reach):
    """Offsets (m), and the smallest value of an output at each."""
    scene = file_of(tree, output, -1e12).resolved()
    at, places = AtRest(scene, reach), np.linspace(-reach, reach, SCANNED)
    return places, np.array([demand_of(scene, scene.limits[0], at.extremes(x))[0] for x in places.tolist()])


@pytest.mark.parametrize("output", OUTPUTS)
@pytest.mark.parametrize("seed", range(4))
def test_within_its_offsets_a_smallest_value_meets_its_limit(seed, output):
    """Also where the least value is between two of the first offsets of the search."""
    tree, reach = in_a_current(seed)
    places, values = scan(tree, output, reach)
    smallest = float(values.min() + 0.05 * (np.sort(values)[4] - values.min()))
    (found,) = offsets(file_of(tree, output, smallest).resolved(), reach, {})
    within = (places > found.low + BETWEEN) & (places < found.high - BETWEEN)
    assert found.missing == ""
    assert within.any()
    assert (values[within] >= smallest).all(), found


@pytest.mark.parametrize("output", OUTPUTS)
@pytest.mark.parametrize("seed", range(4))
def test_offsets_on_the_other_side_of_the_well_are_not_left_out_in_silence(seed, output):
    tree, reach = in_a_current(seed)
    places, values = scan(tree, output, reach)
    smallest = float(np.median(values))
    file = file_of(tree, output, smallest)
    (found,) = offsets(file.resolved(), reach, {})
    outside = (places < found.low - BETWEEN) | (places > found.high + BETWEEN)
    assert (values[outside] >= smallest).any()
    assert np.interp(found.also, places, values) >= smallest - 1e-6 * abs(smallest)
    assert not found.low <= found.also <= found.high
    (row,) = envelope(file, reach, [1.2], [], 5).table.rows
    assert f"smallest {output} is met at other offsets, too" in row[-1]
    assert math.isinf(found.low) != math.isinf(found.high)


@pytest.mark.parametrize("seed", range(12))
def test_the_worst_of_several_values_below_an_allowable_of_zero_governs(seed):
    """All have an infinite utilisation; value and place are those of the largest compression."""
    draw = np.random.default_rng(seed)
    scene = file_of(in_a_current(seed)[0], "effective_tension", 0.0).resolved()
    names = [section.name for section in scene.riser]
    values = draw.uniform(-5e5, 1e5 if seed % 3 == 0 else -1e3, len(names))
    rows = [
        {"output": "effective_tension", "where": name, "smallest": float(value), "smallest_s": float(k)}
        for k, (name, value) in enumerate(zip(names, values, strict=True))
    ]
    value, place, _ = demand_of(scene, scene.limits[0], rows)
    assert (value, place) == (values.min(), int(values.argmin()))
