"""From whatever moment of a wave the phases of a deck count, the vessel moves as the deck states."""

import math

import numpy as np
import pytest
from changed_decks import DECK

from riserstudy.errors import InputError
from riserstudy.importers.orcaflex import read_deck
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.model.platform_motion import displacement
from riserstudy.scene.load import SceneFile
from riserstudy.scene.origin import unwrap

#: 250e3, as decks have it
pytestmark = pytest.mark.filterwarnings("ignore::ruamel.yaml.error.MantissaNoDotYAML1_1Warning")

MOTIONS = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
SENSES = {
    "SurgePositive": ("forward", "aft"),
    "SwayPositive": ("port", "starboard"),
    "HeavePositive": ("up", "down"),
    "RollPositiveStarboard": ("down", "up"),
    "PitchPositiveBow": ("down", "up"),
    "YawPositiveBow": ("port", "starboard"),
}
#: when the surface at the vessel, cos(w t), is there (periods)
LOW = "trough"  # codespell:ignore trough
MOMENTS = {"crest": 0.0, "zero down-crossing": 0.25, LOW: 0.5, "zero up-crossing": 0.75}
PERIODS = (6.0, 11.0, 17.0)
HEIGHT = 3.0
TIMES = np.linspace(40.0, 80.0, 161)


def drawn(seed):
    """A deck with random conventions, and its vessel's six motions (m, rad) at TIMES after the start."""
    draw = np.random.default_rng(seed)
    deck = read_yaml(DECK)
    moment = list(MOMENTS)[seed % 4]
    leads, degrees = bool(draw.integers(2)), bool(draw.integers(2))
    unit = math.radians(1.0) if degrees else 1.0
    turned = float(draw.choice([1.0, math.radians(1.0)]))  # of a rotation by 1 deg
    by = str(draw.choice(["period (s)", "frequency (rad/s)", "frequency (Hz)"]))
    kind = deck["VesselTypes"][0]
    kind |= {
        "RAOPhaseRelativeToConvention": moment,
        "RAOPhaseConvention": "leads" if leads else "lags",
        "RAOPhaseUnitsConvention": "degrees" if degrees else "radians",
        "RAOResponseUnits": "degrees" if turned == 1.0 else "radians",
        "WavesReferredToBy": by,
        "Symmetry": "None",
    }
    signs = []
    for key, words in SENSES.items():
        signs.append(int(draw.integers(2)))
        kind[key] = words[signs[-1]]
    heading = float(draw.choice([0.0, 30.0, 150.0, 200.0, 330.0]))
    size, late = draw.uniform(0.1, 1.0, (3, 6)), draw.uniform(-0.5, 0.5, (3, 6))
    size[:, 3:] *= 0.01
    columns = ["RAOPeriodOrFrequency"]
    columns += [f"RAO{name}{part}" for name in MOTIONS for part in ("Amp", "Phase")]
    rows = []
    for period, sizes, delays in zip(PERIODS, size, late, strict=True):
        wave = {"p": period, "f": 2.0 * math.pi / period}[by[0]]
        row = [wave / (2.0 * math.pi) if by.endswith("(Hz)") else wave]
        written = [*sizes[:3], *(sizes[3:] * turned / math.radians(1.0))]
        for a, b in zip(written, delays, strict=True):  # the greatest motion is b periods after the crest
            after = 2.0 * math.pi * (b - MOMENTS[moment])
            row += [float(a), float(-after if leads else after) / unit]
        rows.append(row)
    (draught,) = kind["Draughts"]
    draught["DisplacementRAOs"] |= {"RAOOrigin": [0, 0, 0], "RAOs": []}
    draught["DisplacementRAOs"]["RAOs"].append({"RAODirection": heading, ", ".join(columns): rows})
    at = int(draw.integers(3))
    train = deck["Environment"]["WaveTrains"][0]
    train |= {"WaveHeight": HEIGHT, "WavePeriod": PERIODS[at], "WaveDirection": heading}
    turn = 2.0 * math.pi / PERIODS[at]
    way = np.where(signs, -1.0, 1.0)
    moved = way * 0.5 * HEIGHT * size[at] * np.cos(turn * TIMES[:, None] - 2.0 * math.pi * late[at])
    return deck, moved


@pytest.mark.parametrize("seed", range(36))
def test_a_vessel_moves_as_its_deck_says_by_any_convention(seed, monkeypatch):
    deck, moved = drawn(seed)
    monkeypatch.setattr("riserstudy.importers.orcaflex.read.read_yaml", lambda path: deck)
    scene = SceneFile("deck.yml", unwrap(read_deck(DECK).tree)[0]).resolved()
    assert displacement(scene, TIMES) == pytest.approx(moved, abs=1e-7)


@pytest.mark.parametrize("seed", range(6))
def test_only_a_vessel_of_another_length_than_its_type_is_refused(seed, monkeypatch):
    """OrcaFlex scales the operators of a type to the length of its vessel."""
    deck, moved = drawn(seed)
    monkeypatch.setattr("riserstudy.importers.orcaflex.read.read_yaml", lambda path: deck)
    length = deck["VesselTypes"][0]["Length"]
    deck["Vessels"][0]["Length"] = length
    scene = SceneFile("deck.yml", unwrap(read_deck(DECK).tree)[0]).resolved()
    assert displacement(scene, TIMES) == pytest.approx(moved, abs=1e-7)
    deck["Vessels"][0]["Length"] = length * float(np.random.default_rng(seed).uniform(0.5, 0.99))
    with pytest.raises(InputError, match=r"Vessels\[Rig\]\.Length: .*scales"):
        read_deck(DECK)
