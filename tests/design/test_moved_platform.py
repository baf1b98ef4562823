"""Offsets and drift with real tensioners: the platform moves with all that is on it."""

import copy
import json
import math
from pathlib import Path

import numpy as np
import pytest
from random_rigs import at_mid_stroke, rig, timed, written

from riserstudy import load_scene, simulate
from riserstudy.design.operability import offsets
from riserstudy.errors import InputError
from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.equilibrium import settle
from riserstudy.solve.evaluate import forces_and_tangent, one_call

ROOT = Path(__file__).parents[2]
LIMITS = [
    {"output": "lfj_angle", "mean": "1 deg", "mode": "drilling"},
    {"output": "ufj_angle", "largest": "3 deg", "mode": "drilling"},
    {"output": "von_mises_stress", "largest": "300 MPa", "mode": "connected"},
    {"output": "joint_stroke", "largest": "3 m", "mode": "connected"},
    {"output": "tensioner_stroke", "smallest": "-4 m", "mode": "connected"},
    {"output": "effective_tension", "smallest": "300 kN", "mode": "connected"},
]
STILL = {"analysis.duration": None, "analysis.output": None, "analysis.step": None}
EXAMPLE = ROOT / "examples/drilling_riser/config/scenes/riser.yaml"


def file_of(tree, **limits):
    return SceneFile("rig.yaml", written(tree) | limits)


def example():
    """The worked example at rest, with its wave taken out."""
    return load_scene(EXAMPLE, **STILL, **{"platform.response": None})


def put(file, offset):
    """The scene as its user would write it with the platform at an offset (m)."""
    path = "platform.position.surge" if file.resolved().top.x == "platform" else "top.offset"
    return file.with_values({path: f"{offset!r} m", "analysis.accuracy": "0.2 %"}, "test")


def uses(file):
    """Use of each limit, by a run of the scene."""
    return [row["utilisation"] for row in json.loads(simulate(file, progress=False).attrs["limits"])]


FILES = [example, *(lambda seed=seed: file_of(rig(seed), limits=LIMITS) for seed in range(12))]


@pytest.mark.long
@pytest.mark.parametrize("made", FILES)
def test_at_each_end_of_an_interval_a_run_with_the_platform_there_uses_all_of_the_limit(made):
    file = made()
    scene = file.resolved()
    reach = 0.04 * sum(section.total_length for section in scene.riser)
    found = offsets(scene, reach, {})
    reached = 0
    for k, between in enumerate(found):
        for end in (between.low, between.high):
            if math.isfinite(end):
                assert uses(put(file, end))[k] == pytest.approx(1.0, abs=0.01)
                reached += 1
    assert reached, "no limit of this scene is reached: it tests nothing"


@pytest.mark.parametrize("seed", range(4))
def test_offsets_count_from_the_well_wherever_the_platform_stands_in_the_file(seed):
    tree = rig(seed)
    moved = copy.deepcopy(tree)
    moved["platform"]["position"]["surge"] = 17.0
    aside = copy.deepcopy(tree)
    aside["top"]["offset"] = -9.0
    one, other, third = (
        offsets(file_of(t, limits=LIMITS[:3]).resolved(), 80.0, {}) for t in (tree, moved, aside)
    )
    np.testing.assert_allclose([o[:2] for o in other], [o[:2] for o in one], atol=0.1)
    np.testing.assert_allclose([o[:2] for o in third], [o[:2] for o in one], atol=0.1)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("kind", ["harmonic", "sea"])
def test_a_motion_of_the_platform_does_not_move_the_offsets_of_a_riser_at_rest(seed, kind):
    """Without a ramp a run begins anywhere in the motion; offsets and allowances count from rest."""
    draw = np.random.default_rng(seed)
    tree = rig(seed, spatial=seed % 2 == 1)
    platform = copy.deepcopy(tree["platform"])
    centre = {"elevation": 0.0}
    if kind == "harmonic":
        heave, surge = draw.uniform(1.0, 4.0, 2).tolist()
        platform["heave"] = {"amplitude": heave, "period": 12.0, "phase": 1.5}
        platform["surge"] = {"amplitude": surge, "period": 12.0, "phase": 0.8}
    else:
        wave = {"significant_height": "8 m", "peak_period": "13 s", "peak_enhancement": 2}
        moves = {"surge": "0.5 m/m", "surge_phase": "1.5 rad"}
        moves |= {"heave": "0.6 m/m", "heave_phase": "0.2 rad"}
        platform["response"] = {
            "operators": [{"period": period, **moves} for period in (1.0, 40.0)],
            "phases": "lead",
            "wave": wave | {"components": 20, "seed": seed},
        }
    platform.setdefault("centre_of_rotation", centre)
    moving = tree | {"platform": platform}
    limits = [*LIMITS[:2], LIMITS[3] | {"largest": "1 m"}]
    still, found = (offsets(file_of(t, limits=limits).resolved(), 40.0, {}) for t in (tree, moving))
    assert any(math.isfinite(end) for one in still for end in one[:2])
    np.testing.assert_allclose([o[:2] for o in found], [o[:2] for o in still], atol=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_an_offset_of_the_top_and_a_surge_of_the_platform_are_the_same_move(seed):
    by_surge, by_offset = rig(seed), rig(seed)
    by_surge["platform"]["position"]["surge"] = 14.0
    by_offset["top"]["offset"] = 14.0
    for tree in (by_surge, by_offset):
        tree["platform"]["surge"] = {"amplitude": 2.0, "period": 12.0, "ramp": 12.0}
        tree["analysis"] = timed(24.0, 0.2, 40, 1.0)
    one, other = (simulate(file_of(tree), progress=False) for tree in (by_surge, by_offset))
    for name in ("x", "effective_tension", "tensioner_force", "ufj_angle"):
        size = float(abs(one[name]).max())
        np.testing.assert_allclose(other[name], one[name], atol=1e-7 * size)


def test_a_riser_that_nothing_holds_at_an_offset_is_refused():
    free = load_scene(
        ROOT / "config/scenes/design/riser.yaml",
        **{"top": {"x": "free", "z": "free", "tension": "5 MN", "rotation": "free"}},
        **{"limits": LIMITS[:1], "platform": None},
    )
    with pytest.raises(InputError, match=r"top\.x.*held"):
        offsets(free.resolved(), 50.0, {})


def test_a_solver_that_does_not_evaluate_limits_is_refused_at_every_offset():
    beam = {"analysis": {"solver": "hermite", "mesh": {"elements": 100}}, "limits": LIMITS[:1]}
    free = {"x": "held", "z": "free", "tension": "5 MN", "rotation": "free"}
    scene = load_scene(ROOT / "config/scenes/design/riser.yaml", **beam, **{"top": free, "platform": None})
    with pytest.raises(InputError, match=r"analysis\.solver.*does not evaluate limits"):
        offsets(scene.resolved(), 50.0, {})


def adrift(seed, constant=False):
    """A rig on a vessel that lost its thrust, driven by waves and current."""
    tree = rig(seed, spatial=False, conductor=False)
    tree["title"] += ", adrift"
    del tree["platform"]
    tree["top"]["x"], tree["top"]["z"] = "vessel", "held"
    if constant:
        rig_of = tree["top"].pop("tensioners")
        lean = rig_of["arrangement"]["deck_radius"] - rig_of["arrangement"]["ring_radius"]
        length = tree["top"]["telescopic_joint"]["length"]
        upright = length / math.hypot(length, lean)
        pull = rig_of["count"] * at_mid_stroke(rig_of) * upright
        tree["top"]["telescopic_joint"]["tension"] = pull
    tree["vessel"] = {
        "mass": "4.5e7 kg",
        "added_mass": "9e6 kg",
        "hull_drag": "400000 N*s^2/m^2",
        "wave_drift": {"force": "0.8 MN"},
    }
    tree["analysis"] = timed(60.0, 0.25, 60, 0.5)
    return file_of(tree)


@pytest.mark.parametrize("seed", range(5))
def test_a_drift_off_with_cylinders_is_that_with_constant_tension_but_for_their_stroke(seed):
    """Inclined cylinders straighten the joint, their pull changes by stiffness times stroke: per cents."""
    inclined, constant = (simulate(adrift(seed, constant), progress=False) for constant in (False, True))
    own, other = inclined["platform_surge"], constant["platform_surge"]
    assert float(own[-1]) > 10.0  # metres: it does drift
    assert float(abs(own / other - 1.0)[10:].max()) < 0.05
    lean, lean_of_other = inclined["lfj_angle"], constant["lfj_angle"]
    assert float(abs(lean - lean_of_other).max()) < 0.1 * float(abs(lean_of_other).max())


@pytest.mark.parametrize("seed", range(4))
def test_below_a_vessel_a_riser_moves_as_below_a_platform_that_is_led_the_same_way(seed):
    file = adrift(seed)
    free = simulate(file, progress=False)
    assert json.loads(free.attrs["audit"])["unexplained_share"] < 1e-4
    points = [
        {"time": f"{t!r} s", "value": f"{x!r} m"} for t, x in free["platform_surge"].to_series().items()
    ]
    led = simulate(
        file.with_values(
            {"vessel": None, "top.x": "platform", "platform": {"surge": {"points": points}}}, "test"
        ),
        progress=False,
    )
    for name in ("x", "tensioner_force", "tensioner_stroke", "lfj_angle", "effective_tension"):
        size = float(abs(free[name]).max())
        # a spline through outputs of half a second leads the platform, and starts it without a jolt
        np.testing.assert_allclose(led[name], free[name], atol=2e-3 * size)


@pytest.mark.parametrize("seed", range(4))
def test_the_vessel_feels_what_joint_and_cylinders_pull(seed):
    """(M + A) v' is the environment's force and the riser's reaction, by differences of the speed."""
    run = simulate(adrift(seed), progress=False)
    speed, time = run["platform_speed_x"].values, run["time"].values
    forces = (run["environment_force_x"] + run["riser_reaction_x"]).values
    impulse = np.concatenate([[0.0], np.cumsum(0.5 * (forces[1:] + forces[:-1]) * np.diff(time))])
    np.testing.assert_allclose(5.4e7 * speed, impulse, atol=2e-3 * float(abs(5.4e7 * speed).max()))
    assert float(abs(run["riser_reaction_x"]).max()) > 1e4  # N: the riser does pull


@pytest.mark.parametrize("seed", range(4))
def test_the_reaction_is_all_that_the_riser_does_to_the_vessel(seed):
    """With a wide ring at an offset, whose unequal cylinders bend the joint: all forces but the water's."""
    scene = (
        adrift(seed)
        .with_values(
            {
                "top.offset": "40 m",
                "top.tensioners.arrangement.ring_radius": "2.5 m",
                "top.tensioners.arrangement.deck_radius": "5 m",
            },
            "test",
        )
        .resolved()
    )
    model, _ = settle(scene, even(scene, 60))
    forces_and_tangent(model.programs, model.state)
    on_vessel = float(model.s.force[0, len(model.s.l0)])
    one_call(model.programs.value.probe, model.state)
    reaction, water = (
        float(model.s.probe[model.probes[f"{name}_x"]]) for name in ("riser_reaction", "environment_force")
    )
    assert abs(model.s.ring_moment[1]) > 1e3  # N m: it does turn the ring
    assert reaction == pytest.approx(on_vessel - water, rel=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_moving_sea_well_and_vessel_together_up_or_down_changes_nothing(seed):
    def lifted(tree, by):
        tree = copy.deepcopy(tree)
        for path in (("water", "surface"), ("water", "seabed"), ("bottom", "elevation")):
            tree[path[0]][path[1]] += by
        tree["top"]["elevation"] += by
        tree["top"]["tensioners"]["arrangement"]["deck_elevation"] += by
        return tree

    tree = rig(seed, spatial=False, conductor=False)
    found = []
    for by in (0.0, 1234.5):
        high = lifted(tree, by)
        high["platform"]["centre_of_rotation"]["elevation"] = by
        found.append(offsets(file_of(high, limits=LIMITS).resolved(), 60.0, {}))
    np.testing.assert_allclose([o[:2] for o in found[1]], [o[:2] for o in found[0]], atol=1e-4)


@pytest.mark.parametrize("name", ["yaw", "coupling"])
def test_what_cylinders_in_space_do_not_do_with_a_vessel_is_refused(name):
    asked = {
        "yaw": {"vessel.sway": {}, "vessel.yaw": {"inertia": "1e10 kg*m^2"}},
        "coupling": {"vessel.coupling": {"scheme": "staggered", "interval": "1 s"}},
    }
    with pytest.raises(InputError, match=f"vessel.{name}.*arrangement"):
        adrift(0).with_values(asked[name], "test").resolved()


@pytest.mark.parametrize("elements", [24, 40, 160])
@pytest.mark.parametrize("seed", range(4))
def test_offsets_of_an_angle_on_a_mesh_of_the_scene_are_true_or_not_told(seed, elements):
    """On equal segments longer than the bending layer an angle at a stiff joint comes out too small."""
    coarse = copy.deepcopy(rig(seed))
    coarse["analysis"]["mesh"] = {"elements": elements}
    found = offsets(file_of(coarse, limits=LIMITS[:2]).resolved(), 60.0, {})
    for k, one in enumerate(found):
        if one.missing:
            assert "flex joint angle" in one.missing
        for end in one[:2]:
            if math.isfinite(end):
                assert uses(put(file_of(rig(seed), limits=LIMITS[:2]), end))[k] < 1.06
