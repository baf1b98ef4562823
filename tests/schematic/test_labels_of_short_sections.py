"""Every section of a riser has a label, however short and wherever it is; contents are told once."""

import random
import re

import pytest
from drawn_words import labels
from random_rigs import rig, written

from riserstudy.scene.load import SceneFile
from riserstudy.schematic import schematic


def with_short_sections(seed):
    """A rig with a long riser, of which some sections are short and far from both ends."""
    draw = random.Random(seed)
    tree = written(rig(seed))
    whole = tree["riser"].pop()
    length = float(whole["length"].split()[0])
    joint = {"flex_joint_below": whole.pop("flex_joint_below")} if "flex_joint_below" in whole else {}
    shares = [draw.uniform(1.0, 2.0) if k % 2 == 0 else draw.uniform(0.03, 0.2) for k in range(5)]
    whole["contents"] = {"density": "1300 kg/m^3"}
    for k, share in enumerate(shares):
        part = {"name": f"part {k}", "length": f"{length * share / sum(shares)} m"}
        tree["riser"].append(whole | part | (joint if k == 0 else {}))
    return SceneFile("rig.yaml", tree).resolved()


@pytest.mark.parametrize("seed", range(12))
def test_every_section_has_one_label_and_the_contents_are_told_once(seed):
    scene = with_short_sections(seed)
    texts = [" ".join(label.get_text().replace("\u00a0", " ").split()) for label in labels(schematic(scene))]
    for section in scene.riser:
        assert sum(text.startswith(f"{section.name}: ") for text in texts) == 1, section.name
    filled = [section for section in scene.riser if section.contents and section.contents.density == 1300.0]
    longest = max(filled, key=lambda section: section.total_length)
    (told,) = (text for text in texts if re.search(r"contents of 1300 kg/m³", text))
    assert told.startswith(f"{longest.name}: ")
