"""Velocities of a wave above the mean level, in the words of OrcaFlex, which has no wave without them."""

import numpy as np
import pytest
from drawn_decks import file_of, loaded
from ruamel.yaml import YAML

from riserstudy.errors import InputError
from riserstudy.export.orcaflex import write_deck
from riserstudy.importers.orcaflex import read_deck

#: all methods that OrcaFlex has (Waves: Kinematic stretching), and what they are in a scene
METHODS = {
    "Vertical stretching": "constant",
    "Wheeler stretching": "stretched",
    "Extrapolation stretching": None,
}


def waving(seed):
    """A scene with a wave."""
    tree = loaded(seed)
    if "wave" not in tree:
        tree["wave"] = {"height": "3 m", "period": "11 s", "ramp": "20 s"}
    return tree


@pytest.mark.parametrize("seed", range(15))
def test_a_deck_has_a_method_of_orcaflex_and_names_what_it_adds(seed):
    tree = waving(seed)
    above = ("none", "constant", "stretched")[seed % 3]
    tree["wave"]["above_mean_level"] = above
    made = write_deck(file_of(tree))
    method = YAML(typ="safe", pure=True).load(made.text)["Environment"]["KinematicStretchingMethod"]
    assert method in METHODS
    named = [line for line in made.left_out if line.startswith("wave.above_mean_level: ")]
    assert (METHODS[method] == above) == (not named)


@pytest.mark.parametrize("seed", range(6))
def test_a_method_is_read_or_refused(seed, tmp_path):
    tree = waving(seed)
    tree["wave"]["above_mean_level"] = "constant"
    deck = YAML(typ="safe", pure=True).load(write_deck(file_of(tree)).text)
    method = str(np.random.default_rng(seed).choice(list(METHODS)))
    deck["Environment"]["KinematicStretchingMethod"] = method
    path = tmp_path / "deck.yml"
    with path.open("w") as file:
        YAML(typ="safe", pure=True).dump(deck, file)
    if METHODS[method]:
        assert read_deck(path).tree["wave"]["above_mean_level"] == METHODS[method]
    else:
        with pytest.raises(InputError, match=r"KinematicStretchingMethod: .*Extrapolation"):
            read_deck(path)
