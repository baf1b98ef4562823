"""Extremes are those of the run: they hold every output, and do not depend on how often there is one."""

import copy
import json

import numpy as np
import pytest
from random_rigs import moving, rig, written

from riserstudy.dataset.label import to_dataset
from riserstudy.scene.limits import SIGNED
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

ALONG = ("x", "y", "z", "effective_tension", "bending_moment")
LIMITS = [
    {"output": name, "largest": size, "mode": "connected"}
    for name, size in {
        "von_mises_stress": "400 MPa",
        "shear_force": "1 MN",
        "bending_moment": "1 MN*m",
        "effective_tension": "9 MN",
        "ufj_angle": "4 deg",
        "lfj_angle": "4 deg",
        "joint_stroke": "9 m",
        "lower_end_tension": "9 MN",
    }.items()
]


def run_of(tree, **more):
    """A run without an estimate of its error: on a mesh as coarse as these it might be refused."""
    file = SceneFile("rig.yaml", written(tree) | {"limits": LIMITS} | more)
    return to_dataset(run(file.resolved(), estimated=False), file, {})


@pytest.mark.parametrize("seed", range(16))
def test_extremes_do_not_depend_on_the_output_interval_and_hold_every_output(seed):
    tree = moving(seed)
    coarse = copy.deepcopy(tree)
    coarse["analysis"]["output"]["interval"] *= 2.0
    runs = run_of(tree), run_of(coarse)
    for name in runs[0].data_vars:
        if str(name).endswith(("_max", "_min", "_absmax")):
            np.testing.assert_array_equal(runs[0][name], runs[1][name], err_msg=str(name))
    demands = [[row["demand"] for row in json.loads(one.attrs["limits"])] for one in runs]
    assert demands[0] == demands[1]
    for one in runs:
        for name in ALONG:
            if name in one:
                assert (one[name].values <= one[f"{name}_max"].values).all(), name
                assert (one[name].values >= one[f"{name}_min"].values).all(), name
        for row in json.loads(one.attrs["limits"]):
            if row["output"] in one:
                values = one[row["output"]]
                if "s" in values.dims:
                    values = values.isel(s=slice(-1))  # the joint's upper end is none of the riser
                values = abs(values) if row["output"] in SIGNED else values
                assert float(values.max()) <= row["demand"]


@pytest.mark.parametrize("seed", range(8))
def test_a_riser_that_stays_at_rest_has_the_extremes_of_its_state_at_rest(seed):
    tree = rig(seed)
    tree["analysis"] = {"duration": 2.0, "step": 0.5, "mesh": {"elements": 30}, "output": {"interval": 0.3}}
    still = run_of(tree)
    for name in (*ALONG, "shear_force", "von_mises_stress"):
        if f"{name}_max" not in still:
            continue
        rest = still[f"{name}_static"].values
        size = np.nanmax(abs(rest)) + 1e-6
        if name == "shear_force":  # extremes are those of both sides of a node, at rest of one
            most = still["shear_force_absmax"]
            np.testing.assert_allclose(most, abs(rest), atol=2e-7 * size, err_msg=name)
            assert (still["shear_force_max"] >= rest - 2e-7 * size).all()
            assert (still["shear_force_min"] <= rest + 2e-7 * size).all()
            continue
        for side in ("_max", "_min"):
            np.testing.assert_allclose(still[name + side], rest, atol=2e-7 * size, err_msg=name + side)


@pytest.mark.parametrize("seed", range(6))
def test_outputs_between_long_steps_are_near_those_of_a_run_that_steps_there(seed):
    """Tension between steps is that of neither a cubic motion nor its axial waves: a few per mille."""
    tree = moving(seed)
    step = tree["analysis"]["step"]
    tree["analysis"]["output"]["interval"] = 0.5 * step
    fine = copy.deepcopy(tree)
    fine["analysis"]["step"] = 0.5 * step
    one, other = run_of(tree), run_of(fine)
    for name in ("effective_tension", "bending_moment"):
        size = float((other[f"{name}_max"] - other[f"{name}_min"]).max())
        between = abs(one[name] - other[name])[1::2]
        at_steps = abs(one[name] - other[name])[::2]
        # between steps no more than what the step itself is wrong, and a parabola's third-order error
        assert float(between.max()) < 2.0 * float(at_steps.max()) + 0.01 * size, name


@pytest.mark.parametrize("seed", range(5))
def test_times_of_extremes_along_the_riser_are_those_of_fine_outputs_or_absent(seed):
    """In a beat of two motions the largest of sparse outputs may be far from the largest value."""
    tree = moving(seed)
    heave = tree["platform"]["heave"]
    tree["analysis"]["duration"] *= 3.0
    tree["platform"]["surge"]["period"] = 1.31 * heave["period"]
    tree["analysis"]["output"]["interval"] = tree["analysis"]["step"]
    fine = run_of(tree)
    rows = json.loads(fine.attrs["extremes"])
    told = [row for row in rows if row["output"] in ALONG and "largest_time" in row]
    assert told
    for every in (7, 23, 41):
        tree["analysis"]["output"]["interval"] = every * tree["analysis"]["step"]
        for row, sparse in zip(rows, json.loads(run_of(tree).attrs["extremes"]), strict=True):
            for side in ("largest", "smallest"):
                assert row[side] == sparse[side]
                time = sparse.get(f"{side}_time")
                if row["output"] not in ALONG or time is None:
                    continue
                history = fine[row["output"]].sel(s=row[f"{side}_s"], method="nearest")
                then = float(np.interp(time, history["time"], history))
                size = float(history.max() - history.min())
                assert abs(then - row[side]) <= 0.021 * size + 1e-6 * abs(row[side])
