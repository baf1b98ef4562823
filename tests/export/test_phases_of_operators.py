"""A vessel moves with the crest at the place that its deck names, in the scene and in the deck."""

import math

import numpy as np
import pytest
import yaml
from drawn_decks import drawn, file_of

from riserstudy.errors import InputErrors
from riserstudy.export.orcaflex import write_deck
from riserstudy.importers.orcaflex import read_deck
from riserstudy.model.platform_motion import centre, displacement

MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
PERIODS = (7.0, 11.0, 16.0)
HEADINGS = (0, 45, 135, 180, 250)
TIMES = np.linspace(20.0, 60.0, 81)


def in_waves(seed):
    """A riser at an offset, whose vessel turns about a place aside, in a wave of one of its operators."""
    tree, chance = drawn(seed), np.random.default_rng(seed)
    tree["top"]["offset"] = f"{chance.uniform(-12, 12)} m"
    rows = []
    for heading in HEADINGS:
        for period in PERIODS:
            row = {"heading": f"{heading} deg", "period": f"{period} s"}
            for name in MOTIONS:
                unit = "m/m" if name in MOTIONS[:3] else "deg/m"
                row |= {
                    name: f"{chance.uniform(0.1, 0.9)} {unit}",
                    f"{name}_phase": f"{chance.integers(-180, 180)} deg",
                }
            rows.append(row)
    about = {"x": f"{chance.uniform(-9, 9)} m", "y": f"{chance.uniform(-9, 9)} m"}
    tree["platform"] |= {
        "centre_of_rotation": about | {"elevation": "3 m"},
        "response": {
            "operators": rows,
            "phases": str(chance.choice(["lead", "lag"])),
            "headings": "towards",
            "ramp": "10 s",
        },
    }
    tree["wave"] = {
        "height": "4 m",
        "period": f"{chance.choice(PERIODS)} s",
        "heading": f"{chance.choice(HEADINGS)} deg",
        "above_mean_level": "constant",
        "ramp": "10 s",
    }
    tree["analysis"] = {"duration": "60 s", "output": {"interval": "0.5 s"}}
    return tree


def deck_of(tree):
    return yaml.safe_load(write_deck(file_of(tree)).text)


def moved_by(deck):
    """Six motions (m, rad) of a vessel by its deck, and the place that they move (m)."""
    sea, (vessel,), (kind,) = deck["Environment"], deck["Vessels"], deck["VesselTypes"]
    table = kind["Draughts"][0]["DisplacementRAOs"]
    origin = table["RAOOrigin"]
    at = [a if a not in (None, "~") else b for a, b in zip(table["PhaseOrigin"], origin, strict=True)]
    at = np.array(at[:2]) + vessel["InitialPosition"][:2]
    (wave,) = sea["WaveTrains"]
    turn, heading = 2.0 * math.pi / wave["WavePeriod"], math.radians(wave["WaveDirection"])
    number = turn**2 / 9.80665
    for _ in range(200):
        number = turn**2 / 9.80665 / math.tanh(number * sea["WaterDepth"])
    crest = number * (at[0] * math.cos(heading) + at[1] * math.sin(heading))
    near = lambda a: abs(math.remainder(math.radians(a) - heading, 2.0 * math.pi))  # noqa: E731
    rows = min(table["RAOs"], key=lambda one: near(one["RAODirection"]))
    (numbers,) = (rows[key] for key in rows if key.startswith("RAOPeriod"))
    row = min(numbers, key=lambda one: abs(one[0] - turn))
    assert row[0] == pytest.approx(turn)
    sign = 1.0 if kind["RAOPhaseConvention"] == "leads" else -1.0
    motion = [
        0.5 * wave["WaveHeight"] * row[1 + 2 * k]
        * np.cos(turn * TIMES - crest + sign * row[2 + 2 * k])
        for k in range(6)
    ]  # fmt: skip
    place = np.array(origin) + vessel["InitialPosition"]
    return np.array(motion).T, place


def moved_in(scene):
    """The same of a scene."""
    still = scene.platform.position
    rest = [getattr(still, name) or 0.0 if still else 0.0 for name in MOTIONS]
    return displacement(scene, TIMES) - rest, centre(scene.platform) + rest[:3]


@pytest.mark.parametrize("seed", range(15))
def test_an_exported_vessel_moves_as_that_of_the_scene(seed):
    tree = in_waves(seed)
    for ours, theirs in zip(moved_in(file_of(tree).resolved()), moved_by(deck_of(tree)), strict=True):
        assert ours == pytest.approx(theirs, abs=1e-6)


@pytest.mark.parametrize("seed", range(15))
def test_a_vessel_is_read_with_the_place_of_its_phases(seed, tmp_path):
    deck, chance = deck_of(in_waves(seed)), np.random.default_rng(100 + seed)
    table = deck["VesselTypes"][0]["Draughts"][0]["DisplacementRAOs"]
    table["RAOOrigin"] = chance.uniform(-20, 20, 3).round(2).tolist()
    table["PhaseOrigin"] = [
        None if chance.random() < 0.5 else round(float(at), 2) for at in chance.uniform(-20, 20, 3)
    ]
    path = tmp_path / "deck.yml"
    path.write_text(yaml.safe_dump(deck))
    scene = file_of(read_deck(path).tree, path).resolved()
    for ours, theirs in zip(moved_in(scene), moved_by(deck), strict=True):
        assert ours == pytest.approx(theirs, abs=1e-6)


@pytest.mark.parametrize(
    "symmetry, x, y, refused",
    [("xz plane", 3, 0, False), ("xz plane", 3, 2, True), ("xz and yz planes", 3, 0, True)],
)
def test_mirrored_operators_have_no_phases_at_another_place(symmetry, x, y, refused, tmp_path):
    deck = deck_of(in_waves(2))
    kind, offset = deck["VesselTypes"][0], deck["VesselTypes"][0]["Draughts"][0]["DisplacementRAOs"]
    kind["Symmetry"] = symmetry
    at = offset["PhaseOrigin"][0] or 0.0
    offset["RAOOrigin"], offset["PhaseOrigin"] = [0, 0, 0], [at + x, y, 0]
    offset["RAOs"] = [one for one in offset["RAOs"] if one["RAODirection"] in (0.0, 45.0)]
    path = tmp_path / "deck.yml"
    path.write_text(yaml.safe_dump(deck))
    if refused:
        with pytest.raises(InputErrors, match="PhaseOrigin"):
            read_deck(path)
    else:
        read_deck(path)
