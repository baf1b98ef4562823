"""Space-out of the telescopic joint: at mid-stroke with the riser in equilibrium, whatever pulls it."""

import numpy as np
import pytest

from riserstudy import simulate
from riserstudy.errors import InputError
from riserstudy.model.mesh import even
from riserstudy.model.space_out import joint_of
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
    joint = {
        "length": "16 m",
        "bending_stiffness": "5e8 N*m^2",
        "mid_stroke": "riser in equilibrium",
    }
    top = {"x": "platform", "z": "platform", "elevation": "21 m", "rotation": "free"}
    rig = {"count": 6, "mid_stroke": ("riser unstretched", "riser in equilibrium")[seed % 2]}
    each = pull / 6.0
    table = [{"reach": f"{r} m", "force": f"{each * (1.0 + 0.02 * r)} N"} for r in (-9, -3, 2, 9)]
    gas = {
        "area": "0.1 m^2",
        "pressure": f"{each / 0.1} Pa absolute",
        "volume": "3 m^3",
        "exponent": 1.1,
    }
    place = {
        "ring_radius": "1 m",
        "deck_radius": "6 m",
        "deck_elevation": "25 m",
        "first_bearing": "0 deg",
    }
    body = {"name": "ring", "mass": "20 t", "density": "7850 kg/m^3"}
    ways = [
        {"telescopic_joint": joint | {"tension": f"{pull} N"}},
        {"telescopic_joint": joint, "tension": f"{pull} N", "body": body},
        {
            "tensioners": rig
            | {"linear": {"tension": f"{each} N", "stiffness": f"{each / 40.0} N/m"}}
        },
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
    plain = simulate(
        file.with_values({"top.telescopic_joint.mid_stroke": None}, "test"), progress=False
    )
    assert abs(float(spaced["joint_stroke_static"])) < 1e-6
    assert abs(float(plain["joint_stroke_static"])) > 0.01  # what the riser stretches by
    tension = [run["effective_tension"].to_numpy()[:-1] for run in (spaced, plain)]
    assert tension[0] == pytest.approx(tension[1], rel=1e-9)  # a length of a joint pulls nothing


@pytest.mark.parametrize("seed", range(6))
def test_stops_count_from_mid_stroke(seed):
    """The platform a metre up: a stop nearer than that stroke is touched, one further is not."""
    file = drawn(seed, **{"platform.position.heave": "1 m"})
    stroke = float(simulate(file, progress=False)["joint_stroke_static"])
    assert stroke > 0.1
    for share, touched in ((0.9, True), (1.1, False)):
        stop = {"stroke": f"{share * stroke} m", "stiffness": "1e8 N/m"}
        scene = file.with_values({"top.telescopic_joint.stop": stop}, "test").resolved()
        warned = single(scene, even(scene, 60), None).facts["warnings"]
        assert (
            any("telescopic joint drawn out: touches its stop" in said for said in warned)
            == touched
        )


def test_without_it_the_length_is_the_one_that_is_given():
    scene = drawn(0, **{"top.telescopic_joint.mid_stroke": None}).resolved()
    assert joint_of(scene) is scene.top.telescopic_joint


def test_a_riser_that_hangs_has_no_space_out():
    change = {"bottom": {"hold": "free"}}
    with pytest.raises(InputError, match="needs a lower end that is held"):
        drawn(0, **change).resolved()
