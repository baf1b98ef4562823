"""Lines along a riser accelerate the water, and are accelerated by it, as each would alone."""

import copy
import math

import numpy as np
import pytest
from changed_decks import DECK

from riserstudy.importers.orcaflex import read_deck
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.scene.load import SceneFile
from riserstudy.scene.origin import unwrap

#: 207e6, as decks have it
pytestmark = pytest.mark.filterwarnings("ignore::ruamel.yaml.error.MantissaNoDotYAML1_1Warning")
RIG = DECK.with_name("drilling.yml")


@pytest.mark.parametrize("seed", range(18))
def test_added_mass_and_wave_force_are_the_sums_of_pipe_and_lines(seed, monkeypatch):
    """By OrcaFlex, Ca and Cm times the water that OD displaces; Cm is 1 + Ca where it is not given.

    Of some rigs the pipe has no added mass, but its lines have.
    """
    draw = np.random.default_rng(seed)
    deck = read_yaml(RIG)
    pipe, service = deck["LineTypes"][0], deck["LineTypes"][2]
    added = {
        "pipe": 0.0 if seed % 3 == 0 else float(draw.uniform(0.3, 1.5)),
        "line": float(draw.uniform(0, 2)),
    }
    inertia = {name: 1.0 + value for name, value in added.items()}
    if seed % 2:
        inertia = {name: value + float(draw.uniform(0.3, 2.0)) for name, value in added.items()}
    for name, kind in (("pipe", pipe), ("line", service)):
        kind["Can"] = added[name]
        kind |= {"Cmn": inertia[name]} if seed % 2 else {}
    monkeypatch.setattr("riserstudy.importers.orcaflex.read.read_yaml", lambda path: copy.deepcopy(deck))
    scene = SceneFile("deck.yml", unwrap(read_deck(RIG).tree)[0]).resolved()
    dressed = next(section for section in scene.riser if section.lines)
    squares = {"pipe": pipe["OD"] ** 2, "line": 2.0 * service["OD"] ** 2}  # choke and kill
    water = dressed.added_mass
    for factor, expected in ((water.coefficient, added), (1.0 + water.coefficient, inertia)):
        sums = math.fsum(expected[name] * squares[name] for name in squares)
        assert factor * water.diameter**2 == pytest.approx(sums, rel=1e-8)
