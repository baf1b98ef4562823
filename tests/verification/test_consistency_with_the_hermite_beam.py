"""The engine against the independent Hermite beam: small surge, damping, taper, flex joints, point loads."""

from functools import cache

import numpy as np
import pytest
import reference as ref
from engine import SCENES, march, off, slopes
from reference_heave import ramped_sine

from riserstudy import load_scene
from riserstudy.errors import SimulationError
from riserstudy.model.mesh import even
from riserstudy.records.warning import sentences
from riserstudy.scene.models import Scene
from riserstudy.scene.resolve import resolve
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import single
from riserstudy.solve.hermite import dynamics, statics
from riserstudy.solve.hermite_beam import Beam, End, Stepping

RISER = ref.Riser()
#: a pipe that does not stretch, as the beam
STIFF = {"axial_stiffness": "1e13 N", "bending_stiffness": f"{ref.EI!r} N*m^2"}
TIMES = 0.1 * np.arange(601)
FEM_RISER = SCENES.parent / "fem_riser" / "base.yaml"


def riser(elements, top, bottom=End(), **changes):
    """S2 in small-angle form, tension of its straight equilibrium."""
    s = np.linspace(0.0, RISER.length, elements + 1)
    tension = RISER.top_force - RISER.weight * (RISER.length - s)
    values = {
        "s": s,
        "bending_stiffness": np.full((elements, 2), ref.EI),
        "tension": np.column_stack([tension[:-1], tension[1:]]),
        "mass": np.full(elements, RISER.mass),
        "added_mass": np.full(elements, RISER.added_mass),
        "drag": np.full(elements, RISER.drag),
        "load": np.zeros((elements, 2)),
        "top": top,
        "bottom": bottom,
    }
    return Beam(**(values | changes))


@pytest.mark.parametrize("amplitude", [0.02, 0.2])
def test_a_small_surge_agrees_with_the_hermite_beam(amplitude):
    moving = End(motion=lambda t: ramped_sine(t, amplitude, 15.0))
    beam = dynamics(riser(160, moving), TIMES, 0.0125)
    found = march(
        "s2",
        80,
        0.0125,
        platform__surge__amplitude=f"{amplitude} m",
        analysis__duration="60 s",
        analysis__output={"interval": "0.1 s"},
        **{f"riser[0].{name}": value for name, value in STIFF.items()},
        **{f"riser[0].{name}": None for name in ("young_modulus", "outer_diameter", "inner_diameter")},
    ).arrays
    # strain of 2.7e-4 and slopes of 3e-3, which the beam leaves out
    assert off(found["x"], beam.displacement[:, ::2]) < 1e-3
    assert off(found["bending_moment"], beam.moment[:, ::2]) < 2e-3


def test_structural_damping_agrees_with_damping_in_proportion_to_bending_stiffness():
    """A beam without tension, since Rayleigh's damping would damp the tension's stiffness as well."""
    length, amplitude, elements = 60.0, 0.05, 64
    ratio, period = 0.05, 2.0
    pipe = {
        "name": "beam",
        "length": f"{length} m",
        **STIFF,
        "mass": "1006 kg/m",
        "structural_damping": {"ratio": ratio, "at_period": f"{period} s"},
    }
    scene = resolve(
        Scene.model_validate(
            {
                "title": "damped beam",
                "riser": [pipe],
                "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "free"},
                "top": {"x": "platform", "z": "free", "rotation": "free"},
                "platform": {"surge": {"amplitude": f"{amplitude} m", "period": "1.5 s", "ramp": "3 s"}},
                "analysis": {
                    "duration": "12 s",
                    "output": {"interval": "0.1 s"},
                    "mesh": {"elements": elements},
                    "step": "5 ms",
                },
            }
        )
    )
    found = single(scene, even(scene, elements), 0.005).arrays

    def surge(t):
        grown, rate, bend = (
            np.where(t < 3.0, value, late)
            for value, late in (
                (0.5 * (1.0 - np.cos(np.pi * t / 3.0)), 1.0),
                (np.pi / 6.0 * np.sin(np.pi * t / 3.0), 0.0),
                (np.pi**2 / 18.0 * np.cos(np.pi * t / 3.0), 0.0),
            )
        )
        w = 2.0 * np.pi / 1.5
        sine, cosine = amplitude * np.sin(w * t), amplitude * np.cos(w * t)
        return (
            sine * grown,
            w * cosine * grown + sine * rate,
            -w * w * sine * grown + 2.0 * w * cosine * rate + sine * bend,
        )

    zero = np.zeros(elements)
    beam = riser(
        elements,
        End(motion=surge),
        s=np.linspace(0.0, length, elements + 1),
        tension=np.zeros((elements, 2)),
        added_mass=zero,
        drag=zero,
    )
    tau = ratio * period / np.pi
    exact = dynamics(beam, 0.1 * np.arange(121), 0.0025, Stepping(rayleigh=(0.0, tau)))
    assert off(found["x"], exact.displacement) < 1e-3
    assert off(found["bending_moment"], exact.moment) < 2e-3


STIFFNESS, LOAD = 30e6, 10.0


def jointed(analysis):
    """A flex joint below, a clamp above, under a uniform lateral load."""
    pipe = {
        "name": "riser",
        "length": "533 m",
        **STIFF,
        "submerged_weight": "141.264 N/m",
        "lateral_load": f"{LOAD} N/m",
    }
    joint = {"stiffness": f"{STIFFNESS} N*m/rad"}
    return resolve(
        Scene.model_validate(
            {
                "title": "joints",
                "riser": [pipe],
                "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": joint},
                "top": {"x": "held", "z": "free", "tension": "2275 kN", "rotation": "fixed"},
                "analysis": analysis,
            }
        )
    )


@cache
def jointed_beam(elements):
    """Fourth order: 1e-6 of the moment at 640 elements."""
    bottom, top = End(rotation_stiffness=STIFFNESS), End(rotation_stiffness=np.inf)
    load = np.full((elements, 2), LOAD)
    return statics(riser(elements, top, bottom, load=load))


def test_flex_joint_and_clamp_agree_with_the_hermite_beam_s_rotational_springs():
    elements = np.array([200, 400, 800, 1600])
    x, moment = [], []
    for n in elements:
        scene = jointed({"mesh": {"elements": int(n)}})
        found = single(scene, even(scene, int(n)), None).arrays
        every = 3200 // int(n)
        x.append(off(found["x_static"], jointed_beam(3200).displacement[::every]))
        moment.append(off(found["bending_moment_static"], jointed_beam(3200).moment[::every]))
    # where an end is held in direction; the layer of 11 m is 8 to 33 segments long, and with 2 to 7
    # of them orders are 1.7 to 1.9
    for found in (moment, x):
        assert slopes(1.0 / elements, found).min() > 1.75
        assert slopes(1.0 / elements[1:], found[1:]).min() > 1.9
    assert x[-1] < 1e-5
    assert moment[-1] < 1e-4


def test_the_default_accuracy_grades_the_mesh_towards_held_ends():
    found = run(jointed({})).arrays
    exact = jointed_beam(640)
    s = np.linspace(0.0, RISER.length, 641)
    moment = np.interp(found["s_node"], s, exact.moment)
    assert off(found["bending_moment_static"], moment) < 0.01
    x = np.interp(found["s_node"], s, exact.displacement)
    assert off(found["x_static"], x) < 0.002
    assert len(found["l0"]) < 400
    assert found["l0"][-1] < 0.2 * found["l0"].max()


@pytest.mark.parametrize("amplitude, told", [(0.2, False), (1.5, True)])
def test_tension_that_a_held_top_would_add_is_told_and_is_what_lumped_masses_have(amplitude, told):
    changes = {"platform__surge__amplitude": f"{amplitude} m", "analysis__duration": "30 s"}
    beam = march(
        "s2c", 80, 0.05, analysis__solver="hermite", analysis__method={"beta": 0.25, "gamma": 0.5}, **changes
    )
    lumped = march("s2c", 80, 0.05, **changes).arrays
    warnings = [w for w in sentences(beam.facts["warnings"]) if w.startswith("top.z is held")]
    assert bool(warnings) is told
    if told:
        top = lumped["effective_tension"][:, -1]
        at_rest = lumped["effective_tension_static"][-1]
        share = float(warnings[0].split("about ")[1].split(" %")[0])
        assert share == pytest.approx(100 * np.abs(top - at_rest).max() / at_rest, rel=0.2)


def drifted(elements, **changes):
    """The start of the fem_riser scene by a step of 0.1 s."""
    settings = {
        "analysis.duration": "20 s",
        "analysis.output": {"interval": "1 s"},
        "analysis.mesh": {"elements": elements},
        "analysis.step": "0.1 s",
    }
    scene = load_scene(FEM_RISER, **(settings | changes)).resolved()
    return single(scene, even(scene, elements), 0.1).arrays


@pytest.mark.parametrize("seed", range(4))
def test_an_undeflected_beam_with_its_top_held_away_rests_in_still_water(seed):
    """Nothing moves it, wherever its top is held and however stiff its joints are."""
    rng = np.random.default_rng(seed)
    changes = {
        "top.offset": f"{rng.uniform(-40, 40)} m",
        "top.rotation.stiffness": f"{10 ** rng.uniform(4, 7)} N*m/rad",
        "analysis.solver": "hermite",
        "wave": None,
        "current": None,
    }
    x = drifted(40, **changes)["x"]
    assert np.abs(x - x[0]).max() < 1e-9
    assert abs(x[0, -1]) > 0.1


@pytest.mark.parametrize("offset", [-6.0, 3.0])
def test_both_solvers_start_a_drifted_riser_alike(offset):
    """Under a weak tide; slopes of 0.01 change lengths by a ten-thousandth, and stretch by as much again."""
    changes = {"top.offset": f"{offset} m", "current.profile.sum[0].surface_speed": "0.2 m/s"}
    beam = drifted(200, **changes, **{"analysis.solver": "hermite"})
    assert off(drifted(200, **changes)["x"], beam["x"]) < 0.01


def rested(seed: int) -> dict:
    """A riser below a platform at a random place and with a random hold of its top, for 10 s."""
    draw = np.random.default_rng(seed)
    pull = f"{draw.uniform(1.5, 3.0)} MN"
    hold = {"z": "platform", "held_at_tension": pull} if draw.integers(2) else {"z": "free", "tension": pull}
    starts = ["equilibrium", "undeflected", *(["unstretched"] if "tension" in hold else [])]
    pipe = {
        "name": "riser",
        "length": "300 m",
        **STIFF,
        "mass": "700 kg/m",
        "submerged_weight": f"{draw.uniform(500, 2500)} N/m",
    }
    position = {
        "surge": f"{draw.uniform(-3, 3)} m",
        "heave": f"{draw.choice([0.0, 2e-5])} m",  # 3 % of the tension of a pipe that hardly stretches
        "pitch": f"{draw.choice([0.0, 2.0])} deg",
    }
    return {
        "title": "rested",
        "gravity": "9.81 m/s^2",
        "riser": [pipe],
        "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": {"stiffness": "5 MN*m/rad"}},
        "top": {"x": "platform", "rotation": {"stiffness": "1 MN*m/rad"}, **hold},
        "platform": {"position": position, "centre_of_rotation": {"elevation": "270 m"}},
        "analysis": {
            "duration": "10 s",
            "output": {"interval": "0.5 s"},
            "mesh": {"elements": 100},
            "step": "0.1 s",
            "start": str(draw.choice(starts)),
        },
    }


@pytest.mark.parametrize("seed", range(12))
def test_the_beam_begins_where_lumped_masses_do_or_is_refused(seed):
    tree = rested(seed)
    tree["analysis"]["solver"] = "hermite"
    scene = resolve(Scene.model_validate(tree))
    try:
        beam = single(scene, even(scene, 100), 0.1).arrays
    except SimulationError as refusal:
        said = str(refusal)
    else:
        said = ""
    if said:
        assert "platform.position" in said or "analysis.start" in said
        return
    del tree["analysis"]["solver"]
    scene = resolve(Scene.model_validate(tree))
    lumped = single(scene, even(scene, 100), 0.1).arrays
    assert off(lumped["x"], beam["x"]) < 1e-3
    assert off(lumped["effective_tension"], beam["effective_tension"]) < 1e-3
