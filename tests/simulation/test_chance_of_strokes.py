"""Errors of all outputs of one place include the chance of a vibration of limited duration."""

import pytest
from random_rigs import rig, shed_vortices, written

from riserstudy.dataset.limits import checked
from riserstudy.records.facts import point_columns
from riserstudy.scene.limits import OF_ONE_PLACE, UNITS
from riserstudy.scene.load import SceneFile
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.simulation.refine import run


def vibrating(seed, seconds=60.0):
    tree = shed_vortices(rig(seed, spatial=True, conductor=False))
    tree["current"] = {"profile": {"shape": "uniform", "surface_speed": 0.4}}
    tree["analysis"] = {"duration": seconds, "step": 0.5, "mesh": {"elements": 30}}
    tree["analysis"]["output"] = {"interval": 0.25}
    return SceneFile("rig.yaml", written(tree))


@pytest.mark.parametrize("seed", range(4))
def test_errors_of_a_vibration_are_at_least_those_by_chance(seed):
    file = vibrating(seed)
    facts = run(file.resolved()).facts
    estimated, chance = facts["error_estimate"], facts["sampling_error"]
    for key in OF_ONE_PLACE:
        assert (key in chance) == (key in estimated), key
        assert estimated[key] >= chance[key] > 0.0
    columns = {c.about.part for c in point_columns() if c.fact == "sampling_error"}
    assert set(chance) <= columns
    demands = {row["output"]: row["largest"] for row in facts["extremes"] if row["where"] == ""}
    for output in ("tensioner_stroke", "joint_stroke", "tensioner_force"):
        (key,) = QUANTITIES[output].errors
        for more, verdict in ((0.1 * chance[key], "not evaluated"), (1e3, "within")):
            allowed = demands[output] + more * abs(demands[output])
            limit = {"output": output, "mode": "drilling", "largest": f"{allowed:.12g} {UNITS[output]}"}
            if allowed > 0.0 and abs(demands[output]) > 0.3 * largest(facts, key):
                limited = file.with_values({"limits": [limit]}, "test")
                (row,) = checked(limited, limited.resolved(), facts)
                assert row.verdict == verdict
                assert verdict == "within" or "run longer" in row.missing


def largest(facts, key):
    """Largest magnitude of the outputs that share an error."""
    rows = [row for row in facts["extremes"] if QUANTITIES[row["output"]].errors == (key,)]
    return max(abs(row[side]) for row in rows for side in ("largest", "smallest"))


@pytest.mark.parametrize("key", OF_ONE_PLACE)
def test_chance_decreases_with_the_length_of_the_run(key):
    """On average over rigs, four times as long a run has about half of the error, and less than the whole."""
    short, long = (
        [run(vibrating(seed, seconds).resolved(), estimated=False).facts["sampling_error"][key]
         for seed in range(3)]
        for seconds in (60.0, 400.0)
    )  # fmt: skip
    assert sum(long) < sum(short)
