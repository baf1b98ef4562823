"""Vortex-induced vibration of risers: what one run says, another says too."""

import copy
from math import cos, pi, radians, sin

import numpy as np
import pytest
from random_rigs import rig, timed, written

from riserstudy.errors import InputError
from riserstudy.model.vortices import shedding_period, slowest, synchronised
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.simulation.vortex_vibration import enter
from riserstudy.simulation.vortex_vibration_statistics import frequency, vibration

PIPE = {
    "length": "13 m",
    "axial_stiffness": "5.9 MN",
    "bending_stiffness": "30 N*m^2",
    "mass": "1.85 kg/m",
    "submerged_weight": "12 N/m",
    "drag": {"coefficient": 1.1, "diameter": "28 mm"},
    "added_mass": {"coefficient": 1.0, "diameter": "28 mm"},
    "viv": {"model": "synchronisation", "diameter": "28 mm", "coefficient": 1.2}
    | {"frequencies": [0.11, 0.18, 0.26], "memory": 20.0, "seed": 1},
    "structural_damping": {"ratio": 0.003, "at_period": "0.3 s"},
}
SCENE = {
    "title": "a model riser",
    "gravity": "9.81 m/s^2",
    "water": {"density": "1000 kg/m^3", "seabed": "-1 m", "surface": "20 m"},
    "riser": [{"name": "pipe"} | PIPE],
    "bottom": {"hold": "wellhead", "elevation": "0 m"},
    "top": {"x": "held", "z": "free", "tension": "1.2 kN"},
    "current": {
        "profile": [{"elevation": "0 m", "speed": "0.1 m/s"}, {"elevation": "13 m", "speed": "0.5 m/s"}],
        "beyond": "hold",
    },
    "analysis": {
        "duration": "12 s",
        "output": {"interval": "50 ms"},
        "mesh": {"elements": 26},
        "step": "8 ms",
    },
}


def scene(**changes):
    """The scene with values at paths."""
    return SceneFile("test", copy.deepcopy(SCENE), {}).with_values(
        {path.replace("__", "."): value for path, value in changes.items()}, "test"
    )


def simulated(file, estimated=False):
    return run(file.resolved(), estimated=estimated)


@pytest.fixture(scope="module")
def plain():
    return simulated(scene())


def test_it_vibrates_across_the_flow_and_is_bent_along_it(plain):
    late = plain.arrays["time"] > plain.facts["vibration_since"]
    x, y = plain.arrays["x"][late], plain.arrays["y"][late]
    assert y.std(axis=0).max() > 4.0 * x.std(axis=0).max()
    assert 0.2 * 0.028 < plain.facts["vibration_rms"] < 1.0 * 0.028
    # no faster than the highest frequency of vortices, no slower than the lowest, in the fastest water
    assert 0.11 * 0.1 / 0.028 < plain.facts["vibration_frequency"] < 0.26 * 0.5 / 0.028


def test_the_energy_of_a_run_is_accounted_for(plain):
    assert plain.facts["audit"]["unexplained_share"] < 2e-3


def test_drag_is_raised_by_the_vibration(plain):
    still = simulated(scene(**{"riser[0].viv": None}))
    mean = plain.arrays["x"][-100:].mean(axis=0).max()
    assert 1.2 < mean / still.arrays["x"][-1].max() < 3.0


def test_without_it_nothing_moves_across_and_the_plane_is_enough():
    still = simulated(scene(**{"riser[0].viv": None}))
    assert "y" not in still.arrays


@pytest.mark.parametrize("angle", [30.0, 90.0, 217.0])
def test_a_current_from_elsewhere_turns_everything(plain, angle):
    found = simulated(scene(current__heading=f"{angle} deg"))
    turned = found.arrays
    of_plain = plain.facts["vibration_frequency"]
    assert found.facts["vibration_frequency"] == pytest.approx(of_plain, rel=1e-6)
    c, s = cos(radians(angle)), sin(radians(angle))
    x, y = plain.arrays["x"], plain.arrays["y"]
    scale = abs(x).max()
    assert abs(turned["x"] - (c * x - s * y)).max() < 1e-6 * scale
    assert abs(turned["y"] - (s * x + c * y)).max() < 1e-6 * scale


@pytest.mark.parametrize("seed", [2, 5, 9])
def test_the_frequency_of_a_rig_does_not_depend_on_its_axes(seed):
    """Rigs on tensioners that vibrate across the flow and along it, turned by a third and by half a turn."""
    tree = rig(seed, spatial=True, conductor=False)
    tree["current"]["profile"]["surface_speed"] = 0.8
    tree["platform"]["position"]["sway"] = 0.0
    for section in tree["riser"]:
        section["viv"] = {**PIPE["viv"], "diameter": section["drag"]["diameter"], "ramp": 20.0}
        section["viv"]["in_line"] = {"coefficient": 0.5, "frequencies": [0.22, 0.36, 0.52]}
    tree["analysis"] = timed(120.0, 0.2, 30, 0.2) | {"newton_tolerance": 1e-14}
    found = []
    for angle in (0.0, 2.0 * pi / 3.0, pi):
        turned = copy.deepcopy(tree)
        turned["current"]["heading"] = angle
        turned["top"]["tensioners"]["arrangement"]["first_bearing"] += angle
        whole = SceneFile("rig", written(turned, unit_of={"heading": "rad"}), {})
        found.append(simulated(whole).facts["vibration_frequency"])
    assert found[0] > 0.0
    assert found[1:] == pytest.approx([found[0]] * 2, rel=1e-6)


def test_a_section_cut_in_two_is_the_same_riser(plain):
    halves = [{"name": name} | PIPE | {"length": "6.5 m"} for name in ("below", "above")]
    tree = copy.deepcopy(SCENE) | {"riser": halves}
    cut = simulated(SceneFile("test", tree, {}))
    for name in ("x", "y", "bending_moment"):
        assert abs(cut.arrays[name] - plain.arrays[name]).max() < 1e-9 * abs(plain.arrays[name]).max()


def test_outputs_do_not_change_the_run(plain):
    often = simulated(scene(analysis__output__interval="10 ms"))
    assert often.facts["vibration_rms"] == pytest.approx(plain.facts["vibration_rms"], rel=0.02)
    np.testing.assert_allclose(often.arrays["y"][-1], plain.arrays["y"][-1], atol=1e-12)


@pytest.mark.parametrize("method", ["TR-BDF2", "ESDIRK4", {"rho_inf": 0.8}])
def test_all_implicit_methods_agree(plain, method):
    other = simulated(scene(analysis__method=method, analysis__step="4 ms"))
    for name in ("vibration_rms", "vibration_frequency"):
        assert other.facts[name] == pytest.approx(plain.facts[name], rel=0.02)


@pytest.mark.long
def test_a_request_holds_for_the_statistics():
    """The error of rms and frequency, against a run on a far finer mesh and step, is within the request."""
    shape = {"shape": "uniform", "surface_speed": "0.15 m/s"}  # which calls for one mode alone
    flow = {"current.profile": shape, "analysis.duration": "30 s"}
    own = {"analysis.accuracy": "5 %", "analysis.mesh": None, "analysis.step": None}
    found = run(scene(**flow, **own).resolved())
    elements, step = found.facts["elements"], found.facts["step"]
    finer = {"analysis.mesh.elements": 3 * elements, "analysis.step": f"{step / 3.0} s"}
    fine = simulated(scene(**flow, **finer))
    for name in ("vibration_rms", "vibration_frequency"):
        assert found.facts[name] == pytest.approx(fine.facts[name], rel=0.05)
    assert max(found.facts["error_estimate"].values()) <= 0.05


def test_steps_and_outputs_too_long_for_the_vortices_are_told():
    run_of = simulated(scene(analysis__step="40 ms", analysis__output__interval="80 ms"))
    told = [line for line in sentences(run_of.facts["warnings"]) if line.startswith("riser.viv")]
    assert any("the time step is too long" in line for line in told)
    assert any("so no frequency is computed" in line for line in told)
    assert "vibration_frequency" not in run_of.facts


def test_a_run_with_few_outputs_after_its_ramps_is_not_judged():
    short = simulated(scene(analysis__output__interval="0.5 s"))
    assert any("too few for statistics" in line for line in sentences(short.facts["warnings"]))
    assert "vibration_rms" not in short.facts


@pytest.mark.parametrize("seed", range(12))
def test_few_outputs_in_a_period_give_the_same_statistics_or_none(seed):
    """A vibration of known size, at any frequency of lock-in: its size is found, or said to be unknown."""
    draw = np.random.default_rng(seed)
    flow = {"current.profile": {"shape": "uniform", "surface_speed": "0.3 m/s"}}
    rig_of = scene(**flow, analysis__duration="200 s").resolved()
    hertz = draw.uniform(0.11, 0.26) * 0.3 / 0.028
    time = np.arange(0.0, 200.0, draw.uniform(0.1, 2.0) * 0.028 / (0.26 * 0.3))
    s, start = np.linspace(0.0, 13.0, 27), draw.uniform(0.0, 2.0 * pi)
    wave = np.multiply.outer(np.sin(2.0 * pi * hertz * time + start), np.sin(pi * s / 13.0))
    facts = {"warnings": []}
    enter(rig_of, 0.001, {"time": time, "s": s, "x": 0.0 * wave, "y": 0.01 * wave}, facts)
    if "vibration_rms" not in facts:
        assert "statistics of the vibration are not computed" in sentences(facts["warnings"])[0]
    else:
        assert facts["vibration_rms_max"] == pytest.approx(0.01 / np.sqrt(2.0), rel=0.03)


@pytest.mark.parametrize(
    "changes, says",
    [
        ({"riser[0].drag": None}, "requires drag across the pipe"),
        ({"current": None}, "water that flows past"),
        ({"analysis.method": "explicit"}, "does not include vortex-induced vibration"),
        ({"riser[0].viv.frequencies": [0.2, 0.1, 0.3]}, "do not increase"),
    ],
)
def test_what_it_cannot_do_is_refused(changes, says):
    with pytest.raises(InputError, match=says):
        scene(**changes).resolved()


@pytest.mark.parametrize("name, other", [("ramp", "9 s"), ("seed", 2)])
def test_sections_begin_together(name, other):
    halves = [{"name": part} | PIPE | {"length": "6.5 m"} for part in ("below", "above")]
    halves[1] = halves[1] | {"viv": PIPE["viv"] | {name: other}}
    with pytest.raises(InputError, match=f"viv.{name}: differs between sections"):
        SceneFile("test", copy.deepcopy(SCENE) | {"riser": halves}, {}).resolved()


@pytest.mark.parametrize("hertz", [0.7, 1.3])
def test_a_frequency_is_that_of_a_sine(hertz):
    time = np.arange(0.0, 60.0, 0.05)  # a line fitted to part of a period leans
    motion = 3.0 + 0.2 * np.sin(2.0 * np.pi * hertz * time + 0.4)
    assert frequency(time, vibration(motion[:, None], time, 0.0)[:, 0]) == pytest.approx(hertz, rel=1e-3)


@pytest.mark.parametrize(
    "kind, period, said",
    [("wave", 1.8, True), ("surge", 0.9, True), ("surge", 200.0, False), (None, 0.0, False)],
)
def test_a_run_says_where_its_vibration_includes_what_waves_and_platform_do(kind, period, said):
    """Without lift, what is left of the vibration is all theirs, and as fast as they are."""
    viv = PIPE["viv"] | {"coefficient": 1e-6, "ramp": "2 s"}
    changes = {"riser[0].viv": viv, "analysis__duration": "20 s", "analysis__output__interval": "16 ms"}
    if kind == "wave":
        changes["water.surface"] = "14 m"
        changes["wave"] = {"amplitude": "0.2 m", "period": f"{period} s", "above_mean_level": "none"}
    elif kind == "surge":
        changes["top__x"] = "platform"
        changes["platform"] = {"surge": {"amplitude": "0.05 m", "period": f"{period} s"}}
    facts = simulated(scene(**changes)).facts
    warned = any("include motion due to waves" in text for text in sentences(facts["warnings"]))
    assert warned == said
    if said:
        assert facts["vibration_frequency"] == pytest.approx(1.0 / period, rel=0.05)


def towed(water, cruise):
    """The small riser hung off in a uniform current, below a platform that cruises; velocities in m/s."""
    flow = {"shape": "uniform", "surface_speed": f"{np.hypot(*water)} m/s"}
    heading = f"{np.arctan2(*water[::-1])} rad"
    top = {"x": "platform", "z": "held", "elevation": "14 m"}
    ship = {"speed": f"{np.hypot(*cruise)} m/s", "heading": f"{np.arctan2(*cruise[::-1])} rad", "ramp": "5 s"}
    return SceneFile("test", copy.deepcopy(SCENE), {}).with_values(
        {
            "current": {"profile": flow, "heading": heading, "ramp": "5 s"},
            "bottom": {"hold": "free"},
            "top": top,
            "platform": {"cruise": ship},
            "riser[0].submerged_weight": "60 N/m",
            "riser[0].viv.ramp": "10 s",
            "analysis": {"duration": "60 s", "output": {"interval": "0.1 s"}, "step": "20 ms"}
            | {"mesh": {"elements": 16}},
        },
        "test",
    )


@pytest.mark.parametrize("seed", range(4))
def test_a_towed_riser_vibrates_as_in_the_current_that_it_meets(seed):
    """The same flow of 0.1 m/s past the riser, from the current alone and from a cruise in a current."""
    draw = np.random.default_rng(seed)
    angle, cruise = draw.uniform(-pi, pi), draw.uniform(-0.3, 0.3, 2)
    met = 0.1 * np.array([np.cos(angle), np.sin(angle)])
    alone, ship = (towed(met + own, own).resolved() for own in (np.array([1e-9, 0.0]), cruise))
    assert shedding_period(ship) == pytest.approx(shedding_period(alone), rel=1e-6)
    assert slowest(ship) == pytest.approx(slowest(alone), rel=1e-6)
    for hertz in (0.3, 0.5, 0.8, 1.1):
        assert synchronised(ship, hertz) == pytest.approx(synchronised(alone, hertz), abs=1e-6)
    if seed < 2:  # along the flow, so that its ramp does not turn it
        facts = [
            run(towed(met + own, own).resolved(), estimated=False).facts for own in (0.0 * met, 2.5 * met)
        ]
        for name in ("vibration_rms", "vibration_frequency"):
            assert facts[1][name] == pytest.approx(facts[0][name], rel=0.02)
