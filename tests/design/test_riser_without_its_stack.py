"""Riser, stack and conductor apart: what is signed for the riser is that of the riser alone."""

import copy
import json
import math

import pytest
from random_rigs import FOOT, rig, timed, written

from riserstudy import simulate
from riserstudy.design import engine_tension, tension
from riserstudy.design.tension_table import TensionRequest, tension_table
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile

TOLERANCES = tension.Tolerances(1.05, 0.96)


def constant(tree, pull=5e6):
    """The rig upright on constant tension, with all that the formula needs."""
    tree = copy.deepcopy(tree)
    del tree["top"]["tensioners"], tree["current"]
    tree["top"]["telescopic_joint"]["tension"] = pull
    for section in tree["riser"]:
        section["buoyancy_lift"] = "0 N/m"
    return tree


def alone(tree):
    """The riser above its flex joint, held there by what a wellhead is."""
    tree = copy.deepcopy(tree)
    joint = tree["riser"][2].pop("flex_joint_below")
    high = sum(section["length"] for section in tree["riser"][:2])
    tree["bottom"] = {"hold": "wellhead", "elevation": tree["bottom"]["elevation"] + high, "rotation": joint}
    tree["riser"] = tree["riser"][2:]
    del tree["soil"]
    return tree


def scene(tree, **more):
    return SceneFile("rig.yaml", written(tree) | more).resolved()


@pytest.mark.parametrize("seed", range(6))
def test_minimum_tension_is_that_of_the_riser_without_stack_and_conductor(seed):
    whole = constant(rig(seed, spatial=False, conductor=True))
    cut = alone(whole)
    for way in (tension.governing, engine_tension.needed):
        one, other = way(scene(whole), TOLERANCES), way(scene(cut), TOLERANCES)
        assert one.tension == pytest.approx(other.tension, rel=1e-6)
    assert tension.needed(scene(whole), TOLERANCES).max() > one.tension  # what it must not say


@pytest.mark.parametrize("seed", range(6))
def test_a_stack_and_a_conductor_may_lack_inputs_of_the_minimum_tension(seed):
    """They are not counted; a BOP has neither contents nor a lift of modules."""
    whole = constant(rig(seed, spatial=False, conductor=True))
    cut = scene(alone(whole))
    del whole["riser"][1]["contents"], whole["riser"][seed % 2]["buoyancy_lift"]
    assert tension.lacks(scene(whole)) == []
    for way in (tension.governing, engine_tension.needed):
        one, other = way(scene(whole), TOLERANCES), way(cut, TOLERANCES)
        assert one.tension == pytest.approx(other.tension, rel=1e-6)
    rows = tension_table(scene(whole), TensionRequest(TOLERANCES, tension.Rig(6, 1, 0.95, 0.0)))
    least = tension.needed(cut, TOLERANCES)
    assert [row.tension for row in rows.ends] == pytest.approx(least.tolist(), rel=1e-6)
    assert not rows.missing


@pytest.mark.parametrize("seed", range(4))
def test_a_limit_without_a_place_is_that_of_all_sections_of_the_riser_and_names_them(seed):
    tree = rig(seed, conductor=True)
    names = [section["name"] for section in tree["riser"]]
    for output, side in (("effective_tension", "smallest"), ("von_mises_stress", "largest")):
        limit = {"output": output, side: "1 MN" if side == "smallest" else "400 MPa"}
        limits = [{**limit, "mode": "drilling"}]
        limits += [{**limit, "at": name, "mode": "drilling"} for name in names[2:]]
        run = simulate(SceneFile("rig.yaml", written(tree) | {"limits": limits}), progress=False)
        without, *each = json.loads(run.attrs["limits"])
        assert without["utilisation"] == max(one["utilisation"] for one in each)
        assert "without stack and conductor" in without["takes"]
        assert without["s"] >= FOOT


@pytest.mark.parametrize("seed", range(4))
def test_a_limit_on_moment_or_shear_without_a_place_also_covers_the_conductor(seed):
    """The soil holds the conductor, so that its moment is often the largest of all."""
    tree = rig(seed, conductor=True)
    places = [{}, *({"at": section["name"]} for section in tree["riser"])]
    of = {"bending_moment": "500 kN*m", "shear_force": "500 kN", "x": "500 m"}
    limits = [
        {"output": output, "largest": most, "mode": "drilling"} | place
        for output, most in of.items()
        for place in places
    ]
    run = simulate(SceneFile("rig.yaml", written(tree) | {"limits": limits}), progress=False)
    found, below = json.loads(run.attrs["limits"]), 0
    for k in range(len(of)):
        without, *each = found[k * len(places) : (k + 1) * len(places)]
        assert without["demand"] == max(one["demand"] for one in each)
        assert "without stack and conductor" not in without["takes"]
        below += without["s"] < FOOT
    assert below > 0


def test_a_joint_has_one_zero_in_limits_statistics_and_series():
    tree = rig(3, spatial=False, conductor=False)
    tree["platform"]["heave"] = {"amplitude": 2.0, "period": 12.0, "ramp": 12.0}
    tree["analysis"] = timed(60.0, 0.2, 30, 0.2)
    limits = [{"output": "joint_stroke", "largest": "5 m", "mode": "connected"}]
    run = simulate(SceneFile("rig.yaml", written(tree) | {"limits": limits}), progress=False)
    (checked,) = json.loads(run.attrs["limits"])
    largest = float(run["joint_stroke"].max())  # of outputs; limits take all steps
    assert largest <= checked["demand"] < largest + 0.01
    away = run["joint_stroke"] - run["stroke"]  # the joint at rest, from its length
    assert float(away.std()) == pytest.approx(0.0, abs=1e-12)
    assert float(away[0]) == pytest.approx(float(run["joint_stroke_static"]), abs=1e-12)
    assert abs(float(away[0])) > 0.01  # m: the two zeros are apart here


def test_a_limit_on_the_stroke_of_a_joint_names_the_output_with_the_right_zero():
    limits = [{"output": "stroke", "largest": "5 m", "mode": "connected"}]
    with pytest.raises(InputError, match="joint_stroke"):
        scene(rig(0), limits=limits)


@pytest.mark.parametrize("seed", range(5))
def test_a_tilt_moves_the_top_alike_below_constant_tension_and_cylinders_without_stiffness(seed):
    """The arm is to the top at rest, whatever pulls there and wherever mid-stroke is."""
    tree = constant(rig(seed, spatial=False, conductor=False))
    pull = 1.4 * tension.governing(scene(tree), tension.Tolerances(1.0, 1.0)).tension
    length = sum(section["length"] for section in tree["riser"])
    tree["water"]["surface"] = tree["bottom"]["elevation"] + length - 5.0
    tree["top"] = {"x": "platform", "z": "free", "rotation": "free"}
    high = tree["bottom"]["elevation"] + length
    tree["platform"] = {
        "centre_of_rotation": {"elevation": high - 20.0},
        "pitch": {"amplitude": "0.03 rad", "period": 20.0, "ramp": 20.0},
    }
    tree["analysis"] = timed(40.0, 0.25, 40, 0.5)
    cylinders = {"count": 3, "linear": {"tension": pull / 3.0, "stiffness": 0.0}}
    ways = [{"tension": pull}]
    for mid_stroke in ("riser unstretched", "riser in equilibrium"):
        ways.append({"tensioners": {**cylinders, "mid_stroke": mid_stroke}})
    runs = []
    for way in ways:
        one = copy.deepcopy(tree)
        one["top"] |= way
        runs.append(simulate(SceneFile("rig.yaml", written(one)), progress=False))
    arm = 20.0 + float(runs[0]["z_static"][-1]) - high  # with the stretch at rest
    assert float(runs[0]["x"][:, -1].max()) == pytest.approx(arm * math.sin(0.03), rel=1e-3)
    for other in runs[1:]:
        assert float(abs(other["x"] - runs[0]["x"]).max()) < 1e-8 * arm
