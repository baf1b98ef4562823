"""Marks of assumed values stand at their own sections, however many parts a scene is divided into."""

import random
from pathlib import Path

import pytest
from drawn_words import labels
from random_rigs import rig, written

from riserstudy.scene.limits import ABOVE
from riserstudy.scene.load import SceneFile, load_scene
from riserstudy.schematic import schematic

TOWED = Path(__file__).parents[2] / "config/scenes/mao_hangoff/steady.yaml"


def divided(seed):
    """A rig whose riser has two to four sections, of which the water surface divides one."""
    draw = random.Random(seed)
    tree = written(rig(seed))
    tree["water"]["surface"] = f"{-draw.uniform(20.0, 60.0)} m"
    riser = tree["riser"]
    whole = riser.pop()
    del whole["submerged_weight"]  # only a section whose weight is computed is divided
    length = float(whole["length"].split()[0])
    shares = [draw.uniform(0.2, 1.0) for _ in range(draw.randint(2, 4))]
    lower = [{"name": f"part {k}", "length": f"{length * s / sum(shares)} m"} for k, s in enumerate(shares)]
    joint = {"flex_joint_below": whole.pop("flex_joint_below")} if "flex_joint_below" in whole else {}
    riser += [whole | part | (joint if k == 0 else {}) for k, part in enumerate(lower)]
    return SceneFile("rig.yaml", tree).resolved()


def labels_of_sections(scene, assumed):
    """Texts of the labels of sections, by name of the section."""
    drawn = labels(schematic(scene, assumed=frozenset(assumed)))
    texts = [label.get_text().replace("\u00a0", " ") for label in drawn]
    return {
        section.name: text
        for section in scene.riser
        for text in (" ".join(of.split()) for of in texts)
        if text.startswith(f"{section.name}: ")
    }


@pytest.mark.parametrize("seed", range(12))
def test_only_the_parts_of_a_section_whose_values_are_assumed_are_marked(seed):
    scene = divided(seed)
    names = [section.name for section in scene.riser]
    assert any(name.endswith(ABOVE) for name in names)
    for k in range(len({section.line for section in scene.riser})):
        found = labels_of_sections(scene, {f"riser[{k}].outer_diameter", f"riser[{k}].submerged_weight"})
        own = {section.name for section in scene.riser if section.line == f"riser[{k}]"}
        assert len(found) >= 2
        for name, text in found.items():
            assert text.count("*") == (2 if name in own else 0), text


@pytest.mark.parametrize("seed", range(12))
def test_a_part_above_the_water_is_weighed_in_air(seed):
    scene = divided(seed)
    foot, lengths = scene.bottom.elevation, [section.total_length for section in scene.riser]
    foots = {section.name: foot + sum(lengths[:k]) for k, section in enumerate(scene.riser)}
    for name, text in labels_of_sections(scene, ()).items():
        dry = foots[name] > scene.water.surface - 1e-6
        assert ("in air" in text) == dry, text
        assert ("in water" in text) == (not dry), text


@pytest.mark.parametrize("below", ["2 m", "5 m", "9 m"])
def test_a_body_that_turns_with_the_lower_end_moves_no_mark(below):
    assumed = {"riser[0].inner_diameter", "riser[0].submerged_weight"}
    (name,) = labels_of_sections(load_scene(TOWED).resolved(), assumed)
    alone = labels_of_sections(load_scene(TOWED).resolved(), assumed)[name]
    turning = labels_of_sections(
        load_scene(TOWED, **{"bottom.body.centre_below": below}).resolved(), assumed
    )[name]
    assert alone.count("*") == 2
    assert turning == alone
