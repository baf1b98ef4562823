"""One riser written in two ways has one answer: levels, lines, rest positions, free ends."""

import copy

import numpy as np
import pytest

from riserstudy.errors import InputError
from riserstudy.scene.limit_inputs import times_of_mean
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

SEEDS = range(4)
VORTICES = {
    "model": "synchronisation", "diameter": "0.5334 m", "coefficient": 1.2, "frequencies": [0.11, 0.18, 0.26],
    "memory": 20.0, "seed": 1,
}  # fmt: skip


def pipe(length, name="pipe"):
    return {
        "name": name,
        "length": f"{length!r} m",
        "outer_diameter": "0.5334 m",
        "inner_diameter": "0.4826 m",
        "young_modulus": "207 GPa",
        "mass": "318 kg/m",
        "submerged_weight": "900 N/m",
        "drag": {"coefficient": 1.0, "diameter": "0.5334 m"},
        "added_mass": {"coefficient": 1.0, "diameter": "0.5334 m"},
    }


def riser(*sections, **top):
    """A riser of 510 m below a held top."""
    return {
        "title": "riser",
        "gravity": "9.81 m/s^2",
        "water": {"density": "1025 kg/m^3", "surface": "0 m", "seabed": "-500 m"},
        "riser": [*sections] or [pipe(510.0)],
        "bottom": {"hold": "wellhead", "elevation": "-490 m", "rotation": "free"},
        "top": {"x": "held", "z": "free", "tension": "1000 kN", "rotation": "free"} | top,
        "analysis": {"mesh": {"elements": 20}},
    }


def in_motion(tree):
    every = {"interval": "0.1 s"}
    tree["analysis"] = {"duration": "4 s", "step": "0.1 s", "mesh": {"elements": 6}, "output": every}
    return tree


def found(tree):
    return run(SceneFile("riser.yaml", tree).resolved(), estimated=False).arrays


@pytest.mark.parametrize("seed", SEEDS)
def test_a_hung_off_riser_below_a_joint_is_dry_above_the_water(seed):
    """Divided at the surface into a dry and a wet section, the same weight hangs on its joint."""
    draw = np.random.default_rng(seed)
    joint, above = float(draw.uniform(10.0, 25.0)), float(draw.uniform(40.0, 60.0))
    length = float(draw.uniform(80.0, 200.0))
    wet = length - (above - joint)

    def hung(*sections):
        tree = riser(*sections, z="held", elevation=f"{above!r} m")
        for section in tree["riser"]:
            del section["submerged_weight"]  # it follows from the mass, and from the water where there is any
            section["contents"] = {"density": "1025 kg/m^3"}
        del tree["top"]["tension"], tree["water"]["seabed"]
        tree["bottom"] = {"hold": "free"}
        tree["top"]["telescopic_joint"] = {
            "length": f"{joint!r} m", "bending_stiffness": "1e8 N*m^2", "tension": "900 kN"
        }  # fmt: skip
        return tree

    one, two = hung(pipe(length)), hung(pipe(wet, "wet"), pipe(above - joint, "dry"))
    weights = [SceneFile("riser.yaml", tree).resolved().hanging[0] for tree in (one, two)]
    bore, outside = (1025.0 * 9.81 * np.pi * 0.25 * of**2 for of in (0.4826, 0.5334))  # N/m
    assert weights == pytest.approx([length * (318.0 * 9.81 + bore) - wet * outside] * 2, rel=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_lines_that_share_tension_stiffen_a_string_as_they_stiffen_a_pipe(seed):
    draw = np.random.default_rng(seed)
    line = {
        "name": "kill", "count": int(draw.integers(1, 4)),
        "outer_diameter": "0.15 m", "inner_diameter": "0.1 m",
        "young_modulus": "207 GPa", "tension": "shared", "wall_density": "7850 kg/m^3",
    }  # fmt: skip
    answers = []
    for bending in ({}, {"bending_stiffness": "0.001 N*m^2"}):
        section = pipe(510.0)
        del section["young_modulus"]
        section |= {"axial_stiffness": "8 GN", "lines": [dict(line)], **bending}
        answers.append(found(riser(section, tension="6 MN"))["z_static"][-1] - (510.0 - 490.0))
    assert answers[0] == pytest.approx(answers[1], rel=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_stroke_counts_from_the_rest_position_of_the_platform(seed):
    draw = np.random.default_rng(seed)
    tree = in_motion(riser(x="platform"))
    heave = {"amplitude": f"{float(draw.uniform(0.2, 2.0))!r} m", "period": "8 s", "ramp": "8 s"}
    tree["platform"] = {"heave": heave}
    raised = copy.deepcopy(tree)
    raised["platform"]["position"] = {"heave": f"{float(draw.uniform(-3.0, 3.0))!r} m"}
    one, other = found(tree)["stroke"], found(raised)["stroke"]
    np.testing.assert_allclose(one, other, atol=1e-9)


@pytest.mark.parametrize("modulus", [20.0, 80.0])
def test_a_free_lower_end_turns_with_the_vessel(modulus):
    """So the shear modulus of the riser has no effect on the yaw of the vessel."""
    tree = in_motion(riser(pipe(400.0)))
    tree["bottom"] = {"hold": "free"}
    tree["top"] = {"x": "vessel", "z": "held", "elevation": "20 m"}
    yaw = {"gain": "100 kN*m/deg", "command": "10 deg"}
    tree["vessel"] = {"mass": "2000 t", "sway": {}, "yaw": {"inertia": "1000 t*m^2"}}
    tree["vessel"]["thrusters"] = {"gain": "100 kN/m", "command": "0 m", "yaw": yaw}
    stiff = copy.deepcopy(tree)
    stiff["riser"][0]["shear_modulus"] = f"{modulus} GPa"
    one, other = (found(of)["platform_yaw"] for of in (tree, stiff))
    assert np.abs(one).max() > 0.01
    np.testing.assert_allclose(one, other, rtol=1e-9)


@pytest.mark.parametrize("end", ["top", "bottom"])
def test_drag_of_a_body_needs_water(end):
    section = pipe(510.0)
    del section["drag"], section["added_mass"]
    tree = riser(section)
    tree["bottom"] = {"hold": "free"} if end == "bottom" else tree["bottom"]
    tree["top"] |= {"z": "held", "elevation": "20 m"} if end == "bottom" else {}
    if end == "bottom":
        del tree["top"]["tension"]
    tree[end]["body"] = {"name": "body", "mass": "10 t", "submerged_weight": "90 kN"}
    del tree["water"]
    SceneFile("riser.yaml", tree).resolved()
    tree[end]["body"]["drag_area"] = {"horizontal": "30 m^2"}
    with pytest.raises(InputError, match=rf"{end}.body.drag_area: requires water"):
        SceneFile("riser.yaml", tree).resolved()


def test_an_offset_of_a_free_top_is_refused():
    tree = riser(x="free")
    SceneFile("riser.yaml", tree).resolved()
    tree["top"]["offset"] = "20 m"
    with pytest.raises(InputError, match="offset does not apply to 'x: free'"):
        SceneFile("riser.yaml", tree).resolved()


@pytest.mark.parametrize("seed", SEEDS)
def test_means_begin_when_the_longest_ramp_ends_whatever_it_belongs_to(seed):
    """A ramp of the current, or of the lift of vortices in it, delays them alike."""
    ramp = f"{float(np.random.default_rng(seed).uniform(5.0, 60.0))!r} s"
    starts = []
    for of in ("current", "vortices"):
        tree = in_motion(riser())
        tree["analysis"]["duration"] = "100 s"
        tree["current"] = {"profile": {"shape": "uniform", "surface_speed": "1 m/s"}}
        tree["riser"][0]["viv"] = VORTICES | {"ramp": "1 s"}
        (tree["current"] if of == "current" else tree["riser"][0]["viv"])["ramp"] = ramp
        scene = SceneFile("riser.yaml", tree).resolved()
        starts.append(times_of_mean(scene, "ufj_angle").start)
    assert starts[0] == starts[1] == pytest.approx(float(ramp.split()[0]))


def test_a_current_with_a_ramp_is_refused_with_a_hull_on_which_it_acts_at_once():
    tree = in_motion(riser(pipe(400.0)))
    tree["bottom"] = {"hold": "free"}
    tree["top"] = {"x": "vessel", "z": "held", "elevation": "20 m"}
    tree["vessel"] = {"mass": "2000 t", "hull_drag": "5e5 N*s^2/m^2"}
    tree["current"] = {"profile": {"shape": "uniform", "surface_speed": "1 m/s"}}
    SceneFile("riser.yaml", tree).resolved()
    tree["current"]["ramp"] = "2 s"
    with pytest.raises(InputError, match=r"current.ramp: does not work with a vessel with hull drag or yaw"):
        SceneFile("riser.yaml", tree).resolved()
