"""Names in a deck are text: whatever characters they have, the scene written is the scene imported."""

import json
import random
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from riserstudy.importers.orcaflex import as_text, read_deck
from riserstudy.inputs.plain_yaml import plain_yaml

pytestmark = pytest.mark.filterwarnings("ignore::ruamel.yaml.error.MantissaNoDotYAML1_1Warning")

DECKS = Path(__file__).parent / "decks"
BREAKS = ("\n", "\r", "\r\n", "\x0b", "\x85", "\u2028", "\u2029")
ENTRIES = ("note: another #", "bottom: null", "limits: [] #", "wave: {height: 30 m, period: 9 s} #")


def changed(name, change):
    """The text of a deck after a change of its data."""
    data = YAML(typ="safe", pure=True).load((DECKS / name).read_text("utf-8-sig"))
    change(data)
    return json.dumps(data)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("name", ["drilling.yml", "riser.yml"])
def test_a_scene_file_has_only_what_was_imported(name, seed, tmp_path):
    draw = random.Random(seed)
    wild = f"A{draw.choice(BREAKS)}{draw.choice(ENTRIES)}{draw.choice(BREAKS)}#"

    def change(data):
        data["Shapes"] = [*(data.get("Shapes") or []), {"Name": wild, "Shape": "Block"}]
        data["General"][wild] = 1
        data["General"]["Comment"] = wild

    deck = tmp_path / f"a{draw.choice(('', ' b', chr(10) + 'note: c'))}.yml"
    deck.write_text(changed(name, change), "utf-8")
    found = read_deck(deck)
    assert plain_yaml(as_text(found, deck), "scene.yaml") == found.tree
    told = "\n".join(found.left_out)
    assert "Shapes[A" in told
    assert all(line.isprintable() for line in found.left_out)
