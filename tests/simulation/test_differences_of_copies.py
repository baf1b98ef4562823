"""Differences of a run and a copy with one changed value: its change over the largest value anywhere."""

import copy

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.advice.ablation import fixed
from riserstudy.dataset.result import Result
from riserstudy.scene.limits import ANGLES
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.remaining_error import estimate
from riserstudy.simulation.run import single

ENDS = ("_max", "_min", "_static", "")
#: outputs of each quantity, along the riser and of one place
ALONG = {"displacement": "xyz", "tension": ["effective_tension"], "moment": ["bending_moment"]}
AT_A_PLACE = {
    "ufj_angle": ["ufj_angle"],
    "lfj_angle": ["lfj_angle"],
    "stroke": ["stroke", "joint_stroke", "tensioner_stroke"],
    "tensioner_force": ["tensioner_force"],
}


@pytest.fixture(scope="module", params=[False, True])
def run(request):
    """A run with a few outputs on a few segments, in a plane and in space."""
    tree = written(moving(3, spatial=request.param))
    file, mesh = fixed(SceneFile("rig.yaml", tree).with_values({"analysis.mesh": {"elements": 12}}, ""), 3e3)
    scene = file.resolved()
    found = single(scene, mesh, scene.analysis.step)
    count = 12 * ((len(found.arrays["time"]) - 1) // 12) + 1  # so that every 2nd to 4th ends with the run
    whole = len(found.arrays["time"])
    cut = {k: v[:count] if v.ndim and len(v) == whole else v for k, v in found.arrays.items()}
    return Result(cut, found.facts)


def sizes(run, names):
    """Magnitudes of all values of some outputs, displacements from their reference positions."""
    arrays = run.arrays
    every = [np.abs(arrays[n + end] - arrays.get("zero_" + n, 0.0)) for n in names for end in ENDS
             if n + end in arrays]  # fmt: skip
    rows = [abs(row[side]) for row in run.facts["extremes"] for side in ("largest", "smallest")
            if row["output"] in names and names not in ALONG.values()]  # fmt: skip
    if "x" in names:
        for end in ("_static", ""):
            away = [arrays[n + end] - arrays["zero_" + n] for n in names if n + end in arrays]
            every.append(np.sqrt(sum(one**2 for one in away)))
    return max([*rows, *(float(one.max()) for one in every)])


def of_joints(run, quantity, change):
    """Relative differences of both flex joints: that of a joint is at least that of the other."""
    return {joint: change / sizes(run, [joint]) for joint in ANGLES if quantity in ANGLES}


def copied(run):
    """A run that can be changed without the other."""
    return Result({name: of.copy() for name, of in run.arrays.items()}, copy.deepcopy(run.facts))


@pytest.mark.parametrize("seed", range(60))
def test_one_changed_value_is_the_difference_of_its_quantity_alone(run, seed):
    draw = np.random.default_rng(seed)
    other, every = copied(run), ALONG | AT_A_PLACE
    quantity = list(every)[seed % len(every)]
    of = [name for n in every[quantity] for end in ENDS if (name := n + end) in run.arrays]
    name, scale = str(draw.choice(of)), sizes(run, every[quantity])
    values = other.arrays[name]
    at = tuple(draw.integers(0, size) for size in values.shape)
    change = draw.choice([-1.0, 1.0]) * draw.uniform(1e-3, 0.3) * scale
    other.arrays[name] = np.array(values)
    other.arrays[name][at] += change
    found = difference(other, run)
    expected = dict.fromkeys(found, 0.0) | {quantity: abs(change) / scale}
    expected |= of_joints(run, quantity, abs(change))
    if quantity == "moment":  # the slope of the moment is the shear
        assert found["shear"] >= found["moment"]
        expected["shear"] = found["shear"]
    assert found == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("seed", range(12))
def test_extremes_over_all_steps_count_at_places(run, seed):
    draw = np.random.default_rng(seed)
    quantity = list(AT_A_PLACE)[seed % 3]
    other, scale = copied(run), sizes(run, AT_A_PLACE[quantity])
    rows = [row for row in other.facts["extremes"] if row["output"] in AT_A_PLACE[quantity]]
    change = draw.uniform(-0.3, 0.3) * scale
    rows[draw.integers(len(rows))][str(draw.choice(["largest", "smallest"]))] += change
    found = difference(other, run)
    expected = dict.fromkeys(found, 0.0) | {quantity: abs(change) / scale}
    assert found == pytest.approx(expected | of_joints(run, quantity, abs(change)), abs=1e-9)


@pytest.mark.parametrize("seed", range(9))
def test_shear_at_one_node_is_the_difference_of_shear(run, seed):
    draw = np.random.default_rng(seed)
    other, end = copied(run), ("max", "min", "static")[seed % 3]
    ends = [run.arrays[f"shear_force_{one}"] for one in ("max", "min", "static")]
    scale = max(float(np.abs(of).max()) for of in ends)
    change = draw.choice([-1.0, 1.0]) * draw.uniform(0.01, 0.3) * scale
    other.arrays[f"shear_force_{end}"][draw.integers(len(ends[0]))] += change
    found = difference(other, run)
    assert found == pytest.approx(dict.fromkeys(found, 0.0) | {"shear": abs(change) / scale}, abs=1e-9)


@pytest.mark.parametrize("every", [2, 3, 4])
@pytest.mark.parametrize("turned", [False, True])
def test_of_runs_with_other_outputs_the_common_ones_are_compared(run, every, turned):
    few = copied(run)
    count = len(run.arrays["time"])
    for name, of in run.arrays.items():
        if of.ndim and len(of) == count:
            few.arrays[name] = of[::every]
    assert set(difference(*((run, few) if turned else (few, run))).values()) == {0.0}
    few.arrays["ufj_angle"] = few.arrays["ufj_angle"] + 0.5 * np.eye(len(few.arrays["time"]))[2]
    found = difference(*((run, few) if turned else (few, run)))
    expected = of_joints(few if turned else run, "ufj_angle", 0.5)
    assert found == pytest.approx(dict.fromkeys(found, 0.0) | expected)


@pytest.mark.parametrize("seed", range(24))
def test_lift_and_overpull_after_a_disconnect_are_compared(run, seed):
    """A clearance of one run alone differs by the largest lift."""
    draw = np.random.default_rng(seed)
    two = [copied(run), copied(run)]
    lift, facts = draw.uniform(0.0, 9.0, len(run.arrays["time"])), {}
    facts = {"overpull": draw.uniform(1e5, 1e6), "lift_max": 9.5, "clearance_min": draw.uniform(0.1, 2.0)}
    for one in two:
        one.arrays["lift"] = lift.copy()
        one.facts |= facts
    off, scale = draw.uniform(0.1, 3.0), 9.5
    expected = {"lift": off / scale, "overpull": 0.0}
    match seed % 4:
        case 0:
            two[0].arrays["lift"][draw.integers(len(lift))] += off
        case 1:
            two[0].facts[str(draw.choice(["lift_max", "clearance_min"]))] -= off
        case 2:
            del two[int(draw.integers(2))].facts["clearance_min"]
            expected["lift"] = lift.max() / scale
        case 3:
            two[0].facts["overpull"] += 1e4
            expected = {"lift": 0.0, "overpull": 1e4 / facts["overpull"]}
    found = difference(*two)
    assert found == pytest.approx(dict.fromkeys(found, 0.0) | expected, abs=1e-12)


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
@pytest.mark.parametrize("seed", range(5))
def test_the_error_of_a_power_of_the_length_is_estimated_exactly(order, seed):
    """Up to second order, except of shear, which is trusted to first order only; above it is too large."""
    size = np.random.default_rng(seed).uniform(1e-3, 1e-1)
    errors = [size * 0.5 ** (order * k) for k in range(3)]
    now, before = errors[1] - errors[2], errors[0] - errors[1]
    found = estimate(*(dict.fromkeys(("moment", "shear"), value) for value in (now, before)))
    assert found["moment"] == pytest.approx(errors[2])
    assert found["shear"] == pytest.approx(errors[2] if order == 1.0 else now)
    fourth = estimate({"moment": 15.0 * size}, {"moment": 240.0 * size})
    assert fourth["moment"] == pytest.approx(5.0 * size)
    for last in (None, {"moment": 1.2 * now}, {"moment": 30.0 * now}):
        assert estimate({"moment": now}, last)["moment"] == pytest.approx(2.0 * now)
    assert estimate({"moment": 0.0}, {"moment": 1.0}) == {"moment": 0.0}
