"""Labels of a schematic mark the values that the scene assumes, and no others."""

import random
from pathlib import Path

import pytest
from drawn_words import words

from riserstudy.jobs.figure import from_scene
from riserstudy.scene.load import load_scene
from riserstudy.schematic import schematic
from riserstudy.study.read import read_studies

CONFIG = Path(__file__).parents[2] / "config"
SYSTEM = CONFIG / "scenes/liu2020/system.yaml"
PROFILE = {"shape": "power", "power": 1, "surface_speed": "1 m/s"}
SPEED = "current.profile.surface_speed"
#: paths of values, and the words of their labels with the mark
MARKED = {
    "riser[0].length": "riser: 533 m*",
    "water.surface": "mean water level, 533.5 m*",
    "water.seabed": "seabed, 0 m*",
    SPEED: "up to 1 m/s*",
    "current.profile": "(profile assumed)",
    "top.offset": "5 m* from above the lower end",
    "top.telescopic_joint.length": "telescopic joint: 24 m*",
    "top.tensioners.count": "6 cylinders*",
    "top.tensioners.arrangement.ring_radius": "ring, radius 1 m*",
    "top.tensioners.arrangement.deck_radius": "deck points, radius 2.5 m*",
    "platform.centre_of_rotation.elevation": "centre of rotation, 533.5 m*",
    "riser[0].outer_diameter": "533.4 mm*",
    "riser[0].inner_diameter": "25.4 mm wall*",
    "riser[0].mass": "1.006 t/m*",
    "riser[0].submerged_weight": "141.6 N/m* in water",
    "riser[0].drag.diameter": "drag diameter 1.22 m*",
    "bottom.rotation.stiffness": "lower flex joint, 27 kN m/°*",
    "top.tensioners.two_chamber_gas.high.pressure": "388.9 kN* each at mid-stroke",
    "top.tensioners.two_chamber_gas.pistons.counted": "in all*",
    "top.tensioners.stroke.longest": "stops at ±7.5 m*",
    "platform.pitch.amplitude": "pitch ±4°*",
    "platform.pitch.period": "in 10 s*",
}


@pytest.mark.parametrize("seed", range(12))
def test_a_label_is_marked_where_its_value_is_assumed(seed):
    draw = random.Random(seed)
    assumed = frozenset(path for path in MARKED if draw.random() < 0.5)
    pitching = {"platform.pitch": {"amplitude": "4 deg", "period": "10 s"}}
    values = {"current.profile": PROFILE, "top.offset": "5 m", **pitching}
    scene = load_scene(SYSTEM, **values).resolved()
    said = words(schematic(scene, assumed=assumed))
    for path, text in MARKED.items():
        assert (text in said) == (path in assumed), path
        assert text.replace("*", "").replace("(profile assumed)", "") in said.replace("*", "")
    marks = len(assumed - {"current.profile"})
    assert said.count("*") == marks + (marks > 0)  # each, and the note below
    assert ("*: assumed" in said) == (marks > 0)


def test_a_drawing_of_a_study_marks_what_its_scene_and_what_is_set_assume():
    file = read_studies(CONFIG, "liu2020").schematics["fig01"].file(CONFIG)
    said = words(from_scene(CONFIG, "liu2020", "fig01"))
    found = {path for path, text in MARKED.items() if text in said}
    assert found == {path for path in MARKED if any(one.startswith(path) for one in file.assumed)}
    assert {"water.surface", "top.tensioners.two_chamber_gas.high.pressure"} <= found
    assert "riser[0].length" not in found


def test_a_calibrated_value_has_another_mark_than_an_assumed_one():
    scene = load_scene(CONFIG / "scenes/liu2017/ref_0.yaml").resolved()
    said = words(schematic(scene, calibrated=frozenset({"vessel.thrusters.gain"})))
    assert "thrusters 65.9 kN/m†, towards" in said
    assert said.count("†") == 2  # the mark, and its meaning
    assert "†: calibrated" in said
    assert "*" not in said
