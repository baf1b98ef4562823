"""Space-out of the telescopic joint: at mid-stroke with the riser in equilibrium, whatever pulls it."""

import copy
import math

import numpy as np
import pytest
from random_rigs import LAWS, at_mid_stroke, rig, written

from riserstudy import simulate
from riserstudy.errors import InputError
from riserstudy.model.mesh import even
from riserstudy.model.space_out import joint_of
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.run import single


def drawn(seed, **more):
    """A deep riser under a telescopic joint, pulled in one of six ways."""
    chance = np.random.default_rng(seed)
    lengths = [float(x) for x in chance.integers(100, 1200, 3)]
    low = -sum(lengths) + 5.0
    bore, weight = 0.25 * np.pi * (19.5 * 0.0254) ** 2, 0.0
    sections = []
    for k, length in enumerate(lengths):
        wet, mud = float(chance.uniform(200, 1500)), int(chance.integers(1030, 1500))
        weight += length * (wet + 9.81 * mud * bore)
        sections.append(
            {
                "name": f"part {k}",
                "length": f"{length} m",
                "outer_diameter": "21 in",
                "inner_diameter": "19.5 in",
                "young_modulus": "207 GPa",
                "mass": "500 kg/m",
                "submerged_weight": f"{wet} N/m",
                "contents": {"density": f"{mud} kg/m^3"},
                "drag": {"coefficient": 1.0, "diameter": "1 m"},
            }
        )
    pull = 2.2 * weight
    joint = {"length": "16 m", "bending_stiffness": "5e8 N*m^2", "mid_stroke": "riser in equilibrium"}
    top = {"x": "platform", "z": "platform", "elevation": "21 m", "rotation": "free"}
    rig = {"count": 6, "mid_stroke": ("riser unstretched", "riser in equilibrium")[seed % 2]}
    each = pull / 6.0
    table = [{"reach": f"{r} m", "force": f"{each * (1.0 + 0.02 * r)} N"} for r in (-9, -3, 2, 9)]
    gas = {"area": "0.1 m^2", "pressure": f"{each / 0.1} Pa absolute", "volume": "3 m^3", "exponent": 1.1}
    place = {"ring_radius": "1 m", "deck_radius": "6 m", "deck_elevation": "25 m", "first_bearing": "0 deg"}
    body = {"name": "ring", "mass": "20 t", "density": "7850 kg/m^3"}
    ways = [
        {"telescopic_joint": joint | {"tension": f"{pull} N"}},
        {"telescopic_joint": joint, "tension": f"{pull} N", "body": body},
        {"tensioners": rig | {"linear": {"tension": f"{each} N", "stiffness": f"{each / 40.0} N/m"}}},
        {"tensioners": rig | {"table": table}, "body": body},
        {"tensioners": rig | {"gas": gas, "arrangement": place}},
        {
            "tensioners": rig
            | {"table": table, "interpolation": "linear", "arrangement": place, "failed": [0, 3]}
        },
    ]
    tree = {
        "title": "deep",
        "gravity": "9.81 m/s^2",
        "water": {"density": "1025 kg/m^3", "surface": "0 m", "seabed": f"{low - 10.0} m"},
        "riser": sections,
        "bottom": {"hold": "wellhead", "elevation": f"{low} m", "rotation": "free"},
        "top": top | {"telescopic_joint": joint} | ways[seed % 6],
        "platform": {"position": {"surge": "0 m"}},
        "analysis": {"mesh": {"elements": 60}},
    }
    return SceneFile("deep.yaml", tree).with_values(more, "test")


@pytest.mark.parametrize("seed", range(12))
def test_the_joint_rests_at_mid_stroke(seed):
    file = drawn(seed)
    spaced = simulate(file, progress=False)
    plain = simulate(file.with_values({"top.telescopic_joint.mid_stroke": None}, "test"), progress=False)
    assert abs(float(spaced["joint_stroke_static"])) < 1e-6
    assert abs(float(plain["joint_stroke_static"])) > 0.01  # what the riser stretches by
    tension = [run["effective_tension"].to_numpy()[:-1] for run in (spaced, plain)]
    assert tension[0] == pytest.approx(tension[1], rel=1e-9)  # a length of a joint pulls nothing


@pytest.mark.parametrize("seed", range(8))
def test_the_joint_rests_at_mid_stroke_below_pistons_that_weigh(seed):
    """Two chambers of gas, whose law is also a straight line, along the joint or inclined."""
    file, draw = drawn(4), np.random.default_rng((seed, 7))
    by = (None, "tangent", "chord", "least squares")[seed // 2]
    gas = file.tree["top"]["tensioners"]["gas"]
    pressure = float(gas["pressure"].split()[0])
    low = {"area": "0.08 m^2", "pressure": f"{0.2 * pressure} Pa absolute", "volume": "2 m^3"}
    high = {"area": "0.1 m^2", "pressure": f"{1.5 * pressure} Pa absolute", "volume": "3 m^3"}
    pistons = {"mass": f"{draw.uniform(1.0, 20.0)} t", "counted": str(draw.choice(["once", "each"]))}
    law = {"high": high, "low": low, "exponent": 1.1, "pistons": pistons}
    ends = {"shortest": "-5 m", "longest": "6 m"}
    line = {"by": by} | ({"at": "1 m"} if by == "tangent" else ends)
    more = {"gas": None, "two_chamber_gas": law, "linearised": line if by else None}
    more["mid_stroke"] = ("riser unstretched", "riser in equilibrium")[seed % 2]
    if draw.random() < 0.5:
        more["arrangement"] = None
    file = file.with_values({f"top.tensioners.{name}": value for name, value in more.items()}, "test")
    heavy = simulate(file, progress=False)
    assert abs(float(heavy["joint_stroke_static"])) < 1e-6
    if more["mid_stroke"] == "riser in equilibrium" and by is None:
        each = float(pistons["mass"].split()[0]) * 9.81e3 / (6.0 if pistons["counted"] == "once" else 1.0)
        pull = pressure * (1.5 * 0.1 - 0.2 * 0.08)
        force = float(heavy["tensioner_force_static"][0])
        assert force == pytest.approx(pull - each, rel=1e-6)


@pytest.mark.parametrize("seed", range(6))
def test_stops_count_from_mid_stroke(seed):
    """The platform a metre up: a stop nearer than that stroke is touched, one further is not."""
    file = drawn(seed, **{"platform.position.heave": "1 m"})
    stroke = float(simulate(file, progress=False)["joint_stroke_static"])
    assert stroke > 0.1
    for share, touched in ((0.9, True), (1.1, False)):
        stop = {"stroke": f"{share * stroke} m", "stiffness": "1e8 N/m"}
        scene = file.with_values({"top.telescopic_joint.stop": stop}, "test").resolved()
        warned = sentences(single(scene, even(scene, 60), None).facts["warnings"])
        assert any("telescopic joint stroked out" in said for said in warned) == touched


def test_without_it_the_length_is_the_one_that_is_given():
    scene = drawn(0, **{"top.telescopic_joint.mid_stroke": None}).resolved()
    assert joint_of(scene) is scene.top.telescopic_joint


def test_a_riser_that_hangs_has_no_space_out():
    change = {"bottom": {"hold": "free"}}
    with pytest.raises(InputError, match="held at its lower end"):
        drawn(0, **change).resolved()


def test_a_riser_that_hangs_has_no_cylinders_at_mid_stroke_in_equilibrium():
    """Whatever hangs free of the well has one equilibrium for each pull: that of its weight."""
    change = {"bottom": {"hold": "free"}, "top.telescopic_joint.mid_stroke": None}
    with pytest.raises(InputError, match=r"top\.tensioners\.mid_stroke: .* requires a riser"):
        drawn(3, **change).resolved()


@pytest.mark.parametrize("seed", range(16))
def test_mid_stroke_is_that_of_a_plumb_riser_wherever_the_platform_is(seed):
    """As with mid-stroke at the unstretched riser, by a line whose tension counts for the stretch."""
    tree = rig(seed, spatial=seed % 4 == 0, conductor=False)
    draw = np.random.default_rng((seed, 3))
    depth = tree["water"]["surface"] - tree["water"]["seabed"]
    tree["platform"]["position"]["surge"] = float(draw.uniform(-0.06, 0.06)) * depth
    tree["analysis"] = {"mesh": {"elements": 60}}
    of = tree["top"]["tensioners"]
    pull = at_mid_stroke(of)
    for name in LAWS:
        of.pop(name, None)
    place = of["arrangement"] if seed % 2 else of.pop("arrangement")
    lean = place["deck_radius"] - place["ring_radius"]
    constant = copy.deepcopy(tree)
    del constant["top"]["tensioners"], constant["current"], constant["platform"]["position"]
    length = sum(section["length"] for section in tree["riser"])
    low = ring = tree["bottom"]["elevation"] + length
    for _ in range(4):  # the pull is the more upright, the lower the ring
        up = place["deck_elevation"] - ring
        share = up / math.hypot(lean, up) if "arrangement" in of else 1.0
        constant["top"]["tension"] = of["count"] * pull * share
        plumb = simulate(SceneFile("rig.yaml", written(constant)), progress=False)
        ring = float(np.interp(length, plumb["s"], plumb["z"]))
    lengths = [math.hypot(lean, place["deck_elevation"] - high) for high in (low, ring)]
    shift = lengths[1] - lengths[0] if "arrangement" in of else low - ring
    stiffness = 0.03 * pull
    runs = []
    for mid_stroke, tension in (
        ("riser in equilibrium", pull),
        ("riser unstretched", pull - stiffness * shift),
    ):
        of["mid_stroke"] = mid_stroke
        of["linear"] = {"tension": tension, "stiffness": stiffness}
        runs.append(simulate(SceneFile("rig.yaml", written(tree)), progress=False))
    one, other = runs
    assert abs(shift) > 1e-3
    for name in ("x_static", "effective_tension_static", "tensioner_force_static"):
        size = float(abs(one[name]).max())
        np.testing.assert_allclose(other[name], one[name], atol=1e-6 * size)
    strokes = other["tensioner_stroke_static"] - one["tensioner_stroke_static"]
    np.testing.assert_allclose(strokes, shift, atol=1e-5)


@pytest.mark.parametrize("seed", range(12))
def test_a_plumb_riser_in_still_water_has_its_cylinders_at_mid_stroke(seed):
    """Inclined ones, too, whose pulls are not vertical."""
    tree = rig(seed, spatial=seed % 2 == 0, conductor=False)
    tree["top"]["tensioners"]["mid_stroke"] = "riser in equilibrium"
    if seed % 3 == 0:
        del tree["top"]["tensioners"]["arrangement"]
    del tree["current"], tree["platform"]["position"]
    tree["analysis"] = {"mesh": {"elements": 20}}
    found = simulate(SceneFile("rig.yaml", written(tree)), progress=False)
    np.testing.assert_allclose(found["tensioner_stroke_static"], 0.0, atol=1e-6)
    pull = at_mid_stroke(tree["top"]["tensioners"])
    np.testing.assert_allclose(found["tensioner_force_static"], pull, rtol=1e-6)
