"""Ends of lines that are one point in a scene are one point of the deck, or the deck is refused."""

from copy import deepcopy

import numpy as np
import pytest
from changed_decks import BENDING, CALM, DECK, ENDS, LINKED, WINCHED, flexing, rig

from riserstudy.errors import InputError
from riserstudy.importers.orcaflex import read_deck
from riserstudy.importers.orcaflex.deck import Part
from riserstudy.importers.orcaflex.top import ring_of
from riserstudy.inputs.plain_yaml import read_yaml

#: 250e3, as decks have it
pytestmark = pytest.mark.filterwarnings("ignore::ruamel.yaml.error.MantissaNoDotYAML1_1Warning")


@pytest.fixture
def imported(monkeypatch):
    """The scene of a deck."""

    def done(deck):
        monkeypatch.setattr("riserstudy.importers.orcaflex.read.read_yaml", lambda path: deck)
        return read_deck(DECK).tree

    return done


def drawn(seed):
    """A rig whose riser is two lines that meet at a buoy, with a hose along the upper one, under a joint.

    The joint slides in the ring, or is soft and clamped to it.
    """
    deck = read_yaml(DECK)
    rig(deck, links=seed % 2)
    draw = np.random.default_rng(seed)
    upper = deck["Lines"][0]
    lower = deepcopy(upper) | {"Name": "Lower"}
    upper[ENDS][1] = ["Between", 0, 0, 0, 0, 180, 0]
    upper[BENDING][1] = ["Infinity", None]
    lower[ENDS][0] = ["Between", 0, 0, 0, 0, 180, 0]
    lower[BENDING][0] = [float(draw.choice([50.0, 400.0])), None]
    sections = "LineType, Length, TargetSegmentLength"
    lower[sections] = [["Pipe", 59.4, 5]]
    upper[sections] = upper[sections][:2]
    hose = {"Name": "Hose", "TopEnd": "End A", BENDING: [[0, None], [0, None]]}
    hose |= {ENDS: [["Ring", 0.5, 0, 0, 0, 180, 0], ["Between", 0.5, 0, 0, 0, 180, 0]]}
    hose |= {sections: [["Pipe", 445.0, 5]]}
    deck["Lines"] += [lower, hose]
    point = {"Name": "Between", "BuoyType": "Lumped buoy", "Connection": "Free", "Mass": 1e-3, "Volume": 0}
    deck["6DBuoys"].append(point | {"InitialPosition": [0, 0, 0]})
    if seed % 3 == 0:
        deck["Lines"][1][ENDS][1][0] = "Ring"
        deck["LineTypes"][-1].update(EA=2.0)
        del deck["Constraints"]
    return deck


def places(deck, at):
    """Rows of the ends of lines and tensioners at an object, by what they are."""
    found = {line["Name"]: row for line in deck["Lines"] for row in line[ENDS] if row[0] == at}
    if at == "Ring":
        for link in deck["Links"]:
            key = next(key for key in (LINKED, WINCHED) if key in link)
            found[link["Name"]] = link[key][1]
    return found


@pytest.mark.parametrize("seed", range(12))
def test_the_place_in_an_object_where_all_ends_meet_is_free(seed, imported):
    """An object that is lower or higher, with its ends in one place, is the same rig."""
    deck = drawn(seed)
    whole = imported(deepcopy(deck))
    draw = np.random.default_rng(seed)
    for at in ("Ring", "Between"):
        height = float(draw.uniform(-3.0, 3.0))
        for row in places(deck, at).values():
            row[3] += height
    assert imported(deck) == whole


@pytest.mark.parametrize("seed", range(24))
def test_an_end_apart_from_the_others_is_refused(seed, imported):
    """Its distance would stretch tensioners or lines: 1 m at four links of 50 kN/m is 200 kN."""
    deck = drawn(seed)
    draw = np.random.default_rng((seed, 1))
    rows = places(deck, str(draw.choice(["Ring", "Between"])))
    rows.pop("Hose", None)
    name = str(draw.choice(sorted(rows)))
    apart = float(draw.choice([-1.0, 1.0]) * draw.uniform(0.01, 3.0))
    rows[name][3] += apart
    with pytest.raises(InputError) as refused:
        imported(deck)
    assert "ConnectionZ" in str(refused.value)
    assert f"{apart:+.6g} m above" in str(refused.value) or f"{-apart:+.6g} m above" in str(refused.value)


@pytest.mark.parametrize("seed", range(12))
def test_a_clamped_end_that_leans_is_refused(seed, imported):
    """Two lines clamped at an angle to each other, or to a flex joint, are bent at rest."""
    draw = np.random.default_rng((seed, 2))
    lean = float(draw.uniform(1.0, 179.0))
    if seed % 4 == 0:
        deck = read_yaml(DECK)
        flexing(deck)
        deck["Lines"][0][ENDS][1][5] = lean
        name = "Riser"
    else:
        deck = drawn(seed)
        name, end = [("Riser", 1), ("Lower", 0), ("InnerBarrel", 1)][seed % 4 - 1]
        next(line for line in deck["Lines"] if line["Name"] == name)[ENDS][end][5] = lean
    with pytest.raises(InputError, match=rf"Lines\[{name}\]\.ConnectionDeclination"):
        imported(deck)


@pytest.mark.parametrize("seed", range(6))
def test_a_joint_that_ends_beside_the_riser_is_refused(seed, imported):
    deck = drawn(seed)
    aside = float(np.random.default_rng((seed, 3)).uniform(0.1, 3.0))
    if seed % 3 and seed % 2:
        deck["Constraints"][0]["InFrameInitialPosition"] = [aside, 0, 0]
        name = r"Constraints\[Slip\]\.InFrameInitialPosition"
    else:
        deck["Lines"][1][ENDS][1][1 + (seed % 3 == 0)] = aside
        name = r"Lines\[InnerBarrel\]\.ConnectionX"
    with pytest.raises(InputError, match=name):
        imported(deck)


@pytest.mark.parametrize("seed", range(12))
def test_a_ring_displaces_water_where_the_riser_ends_not_where_its_statics_begin(seed, imported):
    draw = np.random.default_rng((seed, 4))
    deck = drawn(seed)
    deck["6DBuoys"][0]["InitialPosition"] = [float(one) for one in draw.uniform(-50.0, 50.0, 3)]
    surface = 9.4 + float(draw.choice([-1.0, 1.0]) * draw.uniform(0.5, 5.0))
    deck["Environment"]["WaterSurfaceZ"] = surface
    deck["Environment"]["WaterDepth"] = 500.0 + surface
    body = imported(deck)["top"]["body"]
    assert ("displaced_volume" in body) == (surface > 9.4)


@pytest.mark.parametrize("seed", range(6))
def test_a_body_on_a_guide_is_at_the_end_of_the_riser(seed):
    draw = np.random.default_rng((seed, 5))
    buoy = {"Name": "Ring", "BuoyType": "Lumped buoy", "Connection": "Slide", "Mass": 15.0, "Volume": 2.0}
    part = Part(buoy | {"InitialPosition": [0, 0, 0]}, "6DBuoys[Ring]", DECK)
    assert "displaced_volume" in ring_of(part, CALM, -1.0, on="Slide")
    assert "submerged_weight" in ring_of(part, CALM, 1.0, on="Slide")
    apart = [0.0, 0.0, 0.0]
    apart[seed % 3] = float(draw.uniform(0.1, 3.0))
    part = Part(buoy | {"InitialPosition": apart}, "6DBuoys[Ring]", DECK)
    ring_of(part, CALM, -1.0, on="Slide")
    assert [str(fault).count("InitialPosition") for fault in part.faults] == [1]
