"""A number of a deck that is not finite is a clamp, a wave of no frequency, or refused by its name."""

import copy
import math

import numpy as np
import pytest
from changed_decks import DECK

from riserstudy.errors import InputError
from riserstudy.importers.orcaflex import as_text, read_deck
from riserstudy.inputs.plain_yaml import read_yaml

#: 250e3, as decks have it
pytestmark = pytest.mark.filterwarnings("ignore::ruamel.yaml.error.MantissaNoDotYAML1_1Warning")


def numbers(data, path=()):
    """Paths of the numbers of a deck."""
    if isinstance(data, dict | list):
        parts = data.items() if isinstance(data, dict) else enumerate(data)
        return [found for key, part in parts for found in numbers(part, (*path, key))]
    return [path] if isinstance(data, int | float) and not isinstance(data, bool) else []


@pytest.mark.parametrize("name", ["riser.yml", "drilling.yml"])
@pytest.mark.parametrize("seed", range(12))
def test_no_endless_number_ends_the_import_without_its_name(name, seed, monkeypatch):
    deck = read_yaml(DECK.with_name(name))
    draw = np.random.default_rng(seed)
    paths = numbers(deck)
    for k in draw.choice(len(paths), 25, replace=False):
        changed = copy.deepcopy(deck)
        part = changed
        for key in paths[k][:-1]:
            part = part[key]
        part[paths[k][-1]] = [math.inf, -math.inf, "Infinity"][int(draw.integers(3))]
        monkeypatch.setattr("riserstudy.importers.orcaflex.read.read_yaml", lambda path, to=changed: to)
        try:
            scene = as_text(read_deck(DECK), DECK)
        except InputError:
            continue
        assert "inf" not in scene.replace("Infinity", "inf").split("title:")[1]


@pytest.mark.parametrize(
    "place",
    [
        ("Environment", "RefCurrentDirection"),
        ("Environment", "WaterDepth"),
        ("Environment", "CurrentDepth, CurrentFactor, CurrentRotation", 1, 2),
        ("VesselTypes", 0, "Draughts", 0, "DisplacementRAOs", "RAOs", 0, "RAODirection"),
        ("LineTypes", 0, "OD"),
    ],
)
def test_an_endless_number_is_refused_by_its_name(place, monkeypatch):
    deck = read_yaml(DECK)
    part = deck
    for key in place[:-1]:
        part = part[key]
    part[place[-1]] = math.inf
    monkeypatch.setattr("riserstudy.importers.orcaflex.read.read_yaml", lambda path: deck)
    name = str(place[-1]) if isinstance(place[-1], str) else "CurrentRotation"
    with pytest.raises(InputError, match=f"{name}.*: inf is not finite"):
        read_deck(DECK)
