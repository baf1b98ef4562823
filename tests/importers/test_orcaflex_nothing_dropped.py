"""Entries of a deck that make another riser or another motion of it are in the scene, or refused by name."""

from copy import deepcopy
from pathlib import Path

import numpy as np
import pytest
from changed_decks import BENDING, DECK, ENDS, LINKED, at_rest, pulled, rig

from riserstudy.errors import InputError
from riserstudy.importers.orcaflex import read_deck
from riserstudy.inputs.plain_yaml import read_yaml

#: 250e3, as decks have it
pytestmark = pytest.mark.filterwarnings("ignore::ruamel.yaml.error.MantissaNoDotYAML1_1Warning")
HARMONICS = "HarmonicMotionPeriod, HarmonicMotionSurgeAmplitude"
ATTACHED = "AttachmentType, Attachmentx, Attachmenty, Attachmentz, AttachmentzRelativeTo"


@pytest.fixture
def imported(monkeypatch):
    """The import of the deck with changes, in order."""
    plain = read_yaml(DECK)

    def done(*changes):
        deck = deepcopy(plain)
        for change in changes:
            change(deck)
        monkeypatch.setattr("riserstudy.importers.orcaflex.read.read_yaml", lambda path: deck)
        return read_deck(Path("deck.yml"))

    return done


def hinged(line, end):
    """A rig whose ring has a hinge or a spring at one of its two lines."""

    def change(deck):
        rig(deck)
        deck["Lines"][line][BENDING][end] = [float(np.random.default_rng(line).choice([0.0, 40.0])), None]

    return change


def at_the_other_end(deck):
    """Four springs of which one holds the lower end of the line."""
    pulled(deck)
    deck["Links"][2][LINKED][1][4] = "End B"


CHANGES = {
    "Lines[Riser].ContentsMethod: the import cannot convert the setting Free flooding": lambda d: (
        d["Lines"][0].update(ContentsMethod="Free flooding"),
        d["Lines"][0].pop("ContentsDensity"),
    ),
    "Lines[Riser].AttachmentType: 2 attachments": lambda d: d["Lines"][0].update(
        {ATTACHED: [["Clump", 0, 0, 100, "End A"], ["Clump", 0, 0, 200, "End A"]]}
    ),
    "Lines[Riser].ConnectionxBendingStiffness": hinged(0, 0),
    "Lines[InnerBarrel].ConnectionxBendingStiffness": hinged(1, 1),
    "Links[T2].ConnectionzRelativeTo: the tensioner is connected at End B": at_the_other_end,
    "Vessels[Rig].SuperimposedMotion: the import cannot convert": lambda d: d["Vessels"][0].update(
        SuperimposedMotion="Time history"
    ),
    "Vessels[Rig].HarmonicMotionPeriod": lambda d: d["Vessels"][0].update(
        {"SuperimposedMotion": "RAOs + harmonics", HARMONICS: [[9, 2]]}
    ),
    "Environment.MultipleCurrentDataCanBeDefined: the import": lambda d: d["Environment"].update(
        MultipleCurrentDataCanBeDefined="Yes", Currents=[{"Name": "Current1", "RefCurrentSpeed": 1.0}]
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CHANGES)
def test_an_entry_that_makes_another_riser_is_refused_by_its_name(imported, name):
    with pytest.raises(InputError) as refused:
        imported(CHANGES[name])
    assert name in str(refused.value)


@pytest.mark.parametrize("waves", [True, False])
@pytest.mark.parametrize("seed", range(3))
def test_a_vessel_off_the_x_axis_is_refused_with_and_without_waves(imported, seed, waves):
    heading = float(np.random.default_rng(seed).uniform(5.0, 355.0))

    def turned(deck):
        deck["Vessels"][0]["InitialHeading"] = heading
        deck["Lines"][0][ENDS][0][1] = 6.0  # the riser's upper end, ahead of the vessel's origin

    with pytest.raises(InputError, match=r"Vessels\[Rig\]\.InitialHeading"):
        imported(*([turned] if waves else [at_rest, turned]))


@pytest.mark.parametrize("seed", range(6))
def test_the_wall_of_a_line_type_is_the_one_that_the_deck_gives(imported, seed):
    draw = np.random.default_rng(seed)
    outer, inner = float(draw.uniform(0.55, 0.7)), float(draw.uniform(0.3, 0.47))
    given = [(outer, None), (None, inner), (outer, inner)][seed % 3]
    filled = seed >= 3

    def change(deck):
        deck["LineTypes"][0].update(StressOD=given[0], StressID=given[1])
        deck["Lines"][0]["ContentsDensity"] = 1.2 if filled else 0.0

    found = imported(change)
    joint = next(section for section in found.tree["riser"] if section["name"] == "Joint")
    wall = [float(joint[f"{name}_diameter"].split()[0]) for name in ("outer", "inner")]
    expected = [given[0] or 0.8, given[1] or 0.48]
    if filled and given[1]:  # contents fill ID
        assert wall == [0.8, 0.48]
        named = next(line for line in found.left_out if line.startswith("LineTypes[Joint].StressID"))
        assert f"from {expected[1]:g} to {expected[0]:g} m" in named
    else:
        assert wall == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("seed", range(3))
def test_damping_of_an_end_is_named(imported, seed):
    damping = float(np.random.default_rng(seed).uniform(1.0, 9.0))

    def change(deck):
        line = deck["Lines"][0]
        line[f"{BENDING}, ConnectionDamping"] = [[*row, damping] for row in line.pop(BENDING)]

    left = imported(change).left_out
    assert any(line.startswith("Lines[Riser].ConnectionDamping") and str(damping) in line for line in left)
