"""Directions of RAOs in a deck: a full turn changes none; what differs is refused by its name in the deck."""

import copy

import numpy as np
import pytest
from changed_decks import DECK

from riserstudy.errors import InputError
from riserstudy.importers.orcaflex import read_deck
from riserstudy.inputs.plain_yaml import read_yaml

#: 250e3, as decks have it
pytestmark = pytest.mark.filterwarnings("ignore::ruamel.yaml.error.MantissaNoDotYAML1_1Warning")


@pytest.fixture
def imported(monkeypatch):
    def done(deck):
        monkeypatch.setattr("riserstudy.importers.orcaflex.read.read_yaml", lambda path: copy.deepcopy(deck))
        return read_deck(DECK)

    return done


def drawn(draw):
    """A deck with RAOs of some directions, its list of them, and the name of their table."""
    deck = read_yaml(DECK)
    kind = deck["VesselTypes"][0]
    kind["Symmetry"] = "None"
    raos = kind["Draughts"][0]["DisplacementRAOs"]
    (key,) = (name for name in raos["RAOs"][0] if name.startswith("RAOPeriod"))
    ways = [0.0, *np.sort(draw.uniform(1.0, 359.0, 3)).round(2).tolist()]
    raos["RAOs"] = [{"RAODirection": way, key: draw.uniform(0.1, 1.0, (3, 13)).tolist()} for way in ways]
    for one in raos["RAOs"]:
        for row, wave in zip(one[key], (0.3, 0.5, 1.0), strict=True):
            row[0] = wave
        one[key].append([float(draw.choice([0.0, np.inf])), *[0.0] * 12])  # no wave, as OrcaFlex writes it
    return deck, raos["RAOs"], key


@pytest.mark.parametrize("seed", range(9))
def test_a_direction_that_is_given_again_after_a_full_turn_changes_nothing(imported, seed):
    draw = np.random.default_rng(seed)
    deck, raos, _ = drawn(draw)
    plain = imported(deck)
    at = int(draw.integers(4))
    raos.append(copy.deepcopy(raos[at]))
    raos[-1]["RAODirection"] += float(draw.choice([-360.0, 360.0]))
    found = imported(deck)
    assert found.tree == plain.tree
    assert any("RAOs[4]: left out whole: its direction is" in line for line in found.left_out)


@pytest.mark.parametrize("seed", range(24))
def test_what_a_scene_cannot_have_is_refused_by_its_name_in_the_deck(imported, seed):
    draw = np.random.default_rng(seed)
    deck, raos, key = drawn(draw)
    at, row, column = (int(draw.integers(*of)) for of in ((1, 4), (0, 3), (0, 6)))
    match seed % 4:
        case 0:
            raos.append(copy.deepcopy(raos[at]))
            raos[-1]["RAODirection"] += 360.0
            raos[-1][key][row][1 + 2 * column] += 0.1
            name = "RAOs[4].RAODirection: its direction is"
        case 1:
            raos[at][key][row][0] *= 1.01
            name = f"RAOs[{at}].RAOPeriodOrFrequency: the waves are"
        case 2:
            raos[at][key].append(raos[at][key][row])
            name = f"RAOs[{at}].RAOPeriodOrFrequency: a wave occurs twice"
        case _:
            raos[at][key][row][1 + 2 * column] *= -1.0
            motion = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")[column]
            name = f"RAOs[{at}].RAO{motion}Amp: the amplitude is -"
    with pytest.raises(InputError) as refused:
        imported(deck)
    assert f"DisplacementRAOs.{name}" in str(refused.value)
