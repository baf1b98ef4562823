"""Decks of another program as scenes: conventions, weights, and everything named that is left out."""

import math
import sys
from copy import deepcopy
from pathlib import Path

import numpy as np
import pytest
from ruamel.yaml import YAML

from riserstudy import load_scene, simulate
from riserstudy.cli import main
from riserstudy.errors import InputError
from riserstudy.model.rao import operator
from riserstudy.scene.orcaflex import BENDING, CURRENT, ENDS, LINKED, SECTIONS, read_deck

DECK = Path(__file__).parent / "decks/riser.yml"
GRAVITY = 9.80665


#: 250e3, as decks have it
pytestmark = pytest.mark.filterwarnings("ignore::ruamel.yaml.error.MantissaNoDotYAML1_1Warning")


def changed(folder, change=lambda deck: None):
    """The deck with a change, as a file of its own."""
    reader = YAML()
    deck = reader.load(DECK)
    change(deck)
    target = folder / "deck.yml"
    writer = YAML()
    writer.version = (1, 1)
    with target.open("w") as file:
        writer.dump(deck, file)
    return target


def loaded(folder, change=lambda deck: None):
    """Its scene, by the command."""
    target = folder / "scene.yaml"
    sys.argv = ["riserstudy", "import", str(changed(folder, change)), "-o", str(target)]
    main()
    return load_scene(target).scene()


def test_a_deck_becomes_its_scene(tmp_path):
    scene = loaded(tmp_path)
    assert [s.name for s in scene.riser] == ["Pipe 2", "Joint", "Pipe 1"]  # from below
    assert [s.total_length for s in scene.riser] == pytest.approx([59.4, 400.0, 45.0])
    joint = scene.riser[1]
    assert (joint.bending_stiffness, joint.axial_stiffness) == (250e6, 7.4e9)
    wet = (750.0 - 1025.0 * math.pi / 4.0 * 0.8**2) * GRAVITY
    assert joint.submerged_weight == pytest.approx(wet)
    pipe = scene.riser[0]
    steel = 7850.0 * math.pi / 4.0 * (0.5334**2 - 0.4826**2)
    assert pipe.mass == pytest.approx(steel)
    assert pipe.contents_mass == pytest.approx(1200.0 * math.pi / 4.0 * 0.4826**2)
    assert (scene.water.surface, scene.water.seabed, scene.bottom.elevation) == (
        0.0,
        -500.0,
        -495.0,
    )
    assert scene.bottom.rotation.stiffness == pytest.approx(120e3 * 180.0 / math.pi)
    assert (scene.top.x, scene.top.elevation) == ("platform", 10.0)
    assert scene.current.turns
    assert scene.current.directions == pytest.approx([math.radians(a) for a in (60, 30, 0)])
    assert (scene.wave.height, scene.wave.period, scene.wave.ramp) == (4.0, 12.0, 20.0)
    assert scene.analysis.duration == 100.0


def test_everything_that_is_not_mapped_is_named():
    left = read_deck(DECK).left_out
    assert {line.partition(":")[0] for line in left} == {
        "General.ImplicitConstantTimeStep", "Environment.KinematicViscosity",
        "Environment.SeabedType", "Environment.WaveTrains[Wave1].Name", "VesselTypes[Semi].Length",
        "LineTypes[Joint].PoissonRatio", "Lines[Riser].DrawNodesAsDiscs",
    }  # fmt: skip


def test_what_is_left_out_stands_in_the_scene_and_on_the_screen(tmp_path, capsys):
    loaded(tmp_path, lambda deck: deck["Lines"][0].update({"Cdz": 0.008}))
    assert "left out: Lines[Riser].Cdz: 0.008" in capsys.readouterr().out
    assert "#   Lines[Riser].Cdz: 0.008" in (tmp_path / "scene.yaml").read_text()


LOW = "trough"  # codespell:ignore trough
CONVENTIONS = {
    "leads": ({"RAOPhaseConvention": "leads"}, lambda r: r.conjugate()),
    "not from the crest": ({"RAOPhaseRelativeToConvention": LOW}, lambda r: -r),
    "bow down": ({"PitchPositiveBow": "down"}, lambda r: -r),
}


@pytest.mark.parametrize("case", CONVENTIONS)
def test_operators_keep_their_meaning_in_every_convention(tmp_path, case):
    frequency = np.array([0.5])

    def pitch(change=lambda deck: None):
        response = loaded(tmp_path, change).platform.response
        return operator(response, "pitch", frequency, 0.0)[0]

    words, expected = CONVENTIONS[case]
    plain = pitch()
    # 0.4 deg/m that lags by -88 deg, and positive with the bow up: half a turn from ours
    assert plain == pytest.approx(-math.radians(0.4) * np.exp(1j * math.radians(88.0)))
    other = pitch(lambda deck: deck["VesselTypes"][0].update(words))
    assert other == pytest.approx(expected(plain))


def test_headings_that_the_deck_leaves_to_symmetry_are_there(tmp_path):
    response = loaded(tmp_path).platform.response
    right, left = (
        operator(response, "roll", np.array([0.5]), h) for h in (-math.pi / 2, math.pi / 2)
    )
    assert abs(left[0]) == pytest.approx(math.radians(0.4))
    assert right == pytest.approx(-left)


def pulled(deck):
    """The upper end free, on four springs to a circle of 5 m, 20 m above it, that each pull 800 kN."""
    deck["Environment"]["WaveTrains"][0]["WaveHeight"] = 0
    del deck["Vessels"], deck["General"]["StageDuration"], deck["Environment"]["RefCurrentSpeed"]
    line = deck["Lines"][0]
    line[ENDS][0] = ["Free", 0, 0, 9.4, 0, 0, 0, None, None]
    line[BENDING][0] = [0, None]
    reach = math.hypot(5.0, 20.0)
    deck["Links"] = [
        {
            "Name": f"T{k}", "LinkType": "Spring/Damper", "LinearSpring": True,
            "UnstretchedLength": reach - 16.0, "Stiffness": 50.0,
            LINKED: [["Fixed", x, y, 29.4, None], ["Riser", 0, 0, 0, "End A"]],
        }
        for k, (x, y) in enumerate(((5, 0), (0, 5), (-5, 0), (0, -5)))
    ]  # fmt: skip


def test_links_are_tensioners_and_carry_what_the_deck_hangs_on_them(tmp_path):
    found = simulate(_file(tmp_path, pulled))
    force, stroke = (float(found[f"tensioner_{n}"][0]) for n in ("force", "stroke"))
    assert force == pytest.approx(800e3 + 50e3 * stroke, rel=1e-9)
    # at rest the springs carry the riser with its contents, and what is left at its foot
    upright = 20.0 - float(found["z"][-1] - 9.4)
    vertical = 4.0 * force * upright / math.hypot(5.0, upright)
    weight = sum(
        (s.submerged_weight + s.contents_mass * GRAVITY) * s.total_length
        for s in _file(tmp_path, pulled).scene().riser
    )
    assert vertical - weight == pytest.approx(float(found["lower_end_tension"]), rel=1e-6)


def _file(folder, change):
    loaded(folder, change)
    return load_scene(folder / "scene.yaml")


@pytest.mark.parametrize(
    "change, said",
    [
        (lambda d: d["General"].update(UnitsSystem="US"), "General.UnitsSystem: US; allowed is SI"),
        (lambda d: d["Lines"].append(deepcopy(d["Lines"][0])), "2 of them"),
        (lambda d: d["Environment"].pop("Density"), "nothing is guessed"),
        (lambda d: d["LineTypes"][0].update(EIy=100.0), "EIy: 100.0"),
        (lambda d: d["LineTypes"][1].update(Category="Stress joint"), "Homogeneous pipe"),
        (lambda d: d["Lines"][0][SECTIONS][0].__setitem__(0, "Foam"), "no line type 'Foam'"),
        (lambda d: d["Lines"][0][ENDS][1].__setitem__(0, "Buoy"), "lower end on 'Buoy'"),
        (lambda d: d["Lines"][0][ENDS][0].__setitem__(5, 90), "declination 90"),
        (lambda d: d["Environment"]["WaveTrains"][0].update(WaveType="JONSWAP"), "seas are drawn"),
        (lambda d: d["Environment"].update(VerticalCurrentVariationMethod="Power law"), "Interpolated"),
        (lambda d: d["Environment"][CURRENT].append([1]), "no table"),
        (lambda d: d["VesselTypes"][0].update(Symmetry="circular"), "xz plane"),
        (lambda d: d["Vessels"][0].update(InitialHeading=30), "bow along x"),
        (lambda d: d["Lines"][0].update(ContentsMethod="Slug flow"), "Uniform"),
    ],
)  # fmt: skip
def test_what_a_scene_cannot_say_is_refused(tmp_path, change, said):
    with pytest.raises(InputError, match="deck") as refused:
        read_deck(changed(tmp_path, change))
    assert said in str(refused.value)


def test_what_is_no_deck_is_refused(tmp_path):
    (tmp_path / "other.yml").write_text("a: 1\n")
    with pytest.raises(InputError, match="no deck"):
        read_deck(tmp_path / "other.yml")
