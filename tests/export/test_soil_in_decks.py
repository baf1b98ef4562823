"""Soil in a deck is around all lines that reach below the seabed, however many form the conductor."""

import copy

import numpy as np
import pytest
import yaml
from drawn_decks import file_of, there_and_back
from random_rigs import rig, written

from riserstudy.errors import InputError
from riserstudy.export.orcaflex import write_deck
from riserstudy.importers.orcaflex import read_deck

CLAY = {
    "strength_at_mudline": "10 kPa",
    "strength_gradient": "0 N/m^3",
    "submerged_unit_weight": "7 kN/m^3",
    "strain_at_half_strength": 0.01,
    "depth_factor": 0.5,
    "straight_up_to": 0.1,
}
KINDS = "LineType, Length, TargetSegmentLength"


@pytest.fixture(params=range(8))
def in_clay(request):
    """A riser on a conductor of one to three sections in clay, whose contents differ or are absent."""
    chance = np.random.default_rng(request.param)
    tree = rig(request.param, conductor=True)
    conductor, *above = tree["riser"]
    parts = []
    for k in range(1 + request.param % 3):
        part = copy.deepcopy(conductor) | {"name": f"conductor {k}"}
        if chance.random() < 0.5:
            part["contents"]["density"] = 1000.0 + 100.0 * k
        elif k:
            del part["contents"]
        parts.append(part)
    for part in parts:
        part["length"] = conductor["length"] / len(parts)
    tree["riser"] = [*parts, *above]
    tree["soil"] = {"mudline": tree["soil"]["mudline"], "resistance": CLAY}
    return file_of(written(tree))


def test_all_lines_below_the_seabed_are_in_soil(in_clay, tmp_path):
    scene = in_clay.resolved()
    deck = yaml.safe_load(write_deck(in_clay).text.lstrip("\ufeff"))
    level, soft = scene.bottom.elevation, 0
    for line in reversed([line for line in deck["Lines"] if line["Name"] != "Telescopic joint"]):
        assert (line.get("PyModel") == "Clay") == (level < scene.soil.mudline - 1e-6), line["Name"]
        soft += line.get("PyModel") == "Clay"
        level += sum(length for _, length, _ in line[KINDS])
    assert soft
    back = there_and_back(in_clay, tmp_path)[0].resolved()
    assert back.soil.mudline == pytest.approx(scene.soil.mudline)
    for name, value in scene.soil.resistance.model_dump().items():
        assert getattr(back.soil.resistance, name) == pytest.approx(value), name
    assert (back.bottom.hold, back.bottom.elevation) == ("foot", pytest.approx(scene.bottom.elevation))


@pytest.mark.parametrize("seed", range(4))
def test_a_strength_that_changes_with_depth_is_refused_in_true_words(in_clay, seed):
    """The curve of a deck has one strength, so the refusal must not recommend one that increases."""
    clay = CLAY | {"strength_gradient": f"{np.random.default_rng(seed).uniform(0.1, 3.0)} kPa/m"}
    changed = in_clay.with_values({"soil.resistance": clay}, "soil")
    with pytest.raises(InputError, match="with the same strength at all depths"):
        write_deck(changed)


def test_a_line_without_the_soil_of_the_others_is_refused(in_clay, tmp_path):
    deck = yaml.safe_load(write_deck(in_clay).text.lstrip("\ufeff"))
    soft = [line for line in deck["Lines"] if line.get("PyModel")]
    path = tmp_path / "deck.yml"
    for line in soft:
        spoilt = copy.deepcopy(deck)
        next(one for one in spoilt["Lines"] if one["Name"] == line["Name"])["PyModel"] = "(none)"
        path.write_text(yaml.safe_dump(spoilt))
        with pytest.raises(InputError, match=r"water\.seabed|PyModel: the model is (none|Clay), but"):
            read_deck(path)
