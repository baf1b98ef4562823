"""Decks of another program as scenes: conventions, weights, and everything named that is left out."""

import math

import numpy as np
import pytest
from changed_decks import (
    CALM,
    DECK,
    GRAVITY,
    REACH,
    _file,
    at_rest,
    changed,
    flexing,
    in_soil,
    later,
    loaded,
    pulled,
    rig,
    sea,
)

from riserstudy import load_scene, simulate
from riserstudy.errors import InputError
from riserstudy.importers.orcaflex import read_deck
from riserstudy.importers.orcaflex.deck import Part
from riserstudy.importers.orcaflex.top import ring_of
from riserstudy.model.rao import operator
from riserstudy.model.sea import components

#: 250e3, as decks have it
pytestmark = pytest.mark.filterwarnings("ignore::ruamel.yaml.error.MantissaNoDotYAML1_1Warning")


def test_a_deck_becomes_its_scene(tmp_path):
    scene = loaded(tmp_path)
    assert [s.name for s in scene.riser] == [
        "Pipe 2", "Joint", "Pipe 1", "Pipe 1, above water",
    ]  # from below  # fmt: skip
    assert [s.total_length for s in scene.riser] == pytest.approx([59.4, 400.0, 35.6, 9.4])
    joint = scene.riser[1]
    assert (joint.bending_stiffness, joint.axial_stiffness) == (250e6, 7.4e9)
    wet = (750.0 - 1025.0 * math.pi / 4.0 * 0.8**2) * GRAVITY
    assert joint.submerged_weight == pytest.approx(wet)
    pipe = scene.riser[0]
    steel = 7850.0 * math.pi / 4.0 * (0.5334**2 - 0.4826**2)
    assert pipe.mass == pytest.approx(steel)
    assert pipe.contents_mass == pytest.approx(1200.0 * math.pi / 4.0 * 0.4826**2)
    assert (scene.water.surface, scene.water.seabed, scene.bottom.elevation) == (0.0, -500.0, -495.0)
    assert scene.bottom.rotation.stiffness == pytest.approx(120e3 * 180.0 / math.pi)
    assert (scene.top.x, scene.top.elevation) == ("platform", 10.0)
    assert scene.current.turns
    elevations, _ = scene.current.table(scene.water)
    at = dict(zip(elevations, scene.current.directions, strict=True))
    for depth, angle in ((0.0, 0), (100.0, 30), (500.0, 60)):
        assert at[-depth] == pytest.approx(math.radians(angle))
    assert (scene.wave.height, scene.wave.period, scene.wave.ramp) == (4.0, 12.0, 20.0)
    assert scene.analysis.duration == 100.0


def test_everything_that_is_not_mapped_is_named():
    left = read_deck(DECK).left_out
    assert {line.partition(":")[0] for line in left} == {
        "General.ImplicitConstantTimeStep", "Environment.WaveTrains[Wave1].WavePeriod",
        "Environment.KinematicViscosity", "Environment.CurrentRotation",
        "Environment.SeabedType", "VesselTypes[Semi].Length", "LineTypes[Joint].PoissonRatio",
        "values that affect only drawings",
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
    right, left = (operator(response, "roll", np.array([0.5]), h) for h in (-math.pi / 2, math.pi / 2))
    assert abs(left[0]) == pytest.approx(math.radians(0.4))
    assert right == pytest.approx(-left)


@pytest.mark.long
def test_links_are_tensioners_and_carry_what_the_deck_hangs_on_them(tmp_path):
    found = simulate(_file(tmp_path, pulled))
    force, stroke = (float(found[f"tensioner_{n}"][0]) for n in ("force", "stroke"))
    assert force == pytest.approx(800e3 + 50e3 * stroke, rel=1e-9)
    # at rest the springs carry the riser with its contents, and what is left at its foot
    upright = 20.0 - float(found["z"][-1] - 9.4)
    vertical = 4.0 * force * upright / math.hypot(5.0, upright)
    weight = sum(
        (s.submerged_weight + s.contents_mass * GRAVITY) * s.total_length
        for s in _file(tmp_path, pulled).resolved().riser
    )
    assert vertical - weight == pytest.approx(float(found["lower_end_tension"]), rel=1e-6)


def test_a_sea_keeps_its_height_period_and_shape(tmp_path, capsys):
    wave = loaded(tmp_path, sea).wave
    assert (wave.significant_height, wave.peak_period, wave.peak_enhancement) == (5.0, 11.0, 2.0)
    assert (wave.components, wave.seed, wave.ramp) == (60, 12345, 20.0)
    assert "WaveSeed: the sea record differs" in capsys.readouterr().out


@pytest.mark.parametrize("kind", ["JONSWAP", "ISSC"])
def test_a_sea_told_by_its_zero_crossings_has_them(tmp_path, kind):
    def change(deck):
        sea(deck, WaveType=kind, WaveTp=None, WaveTz=8.0, WaveGamma=3.3, WaveNumberOfComponents=9000)

    wave = loaded(tmp_path, change).wave
    frequency, amplitude = components(wave)
    crossing = 2.0 * math.pi * math.sqrt((amplitude**2).sum() / ((amplitude * frequency) ** 2).sum())
    assert crossing == pytest.approx(8.0, rel=0.02)  # components end at ten times the peak's frequency
    assert wave.peak_period > 9.5


@pytest.mark.parametrize("kind", ["links", "winches", "table"])
def test_a_ring_on_tensioners_of_the_vessel_hangs_as_the_deck_has_it(tmp_path, kind):
    def change(deck):
        rig(deck, **{kind: 1} if kind != "table" else {})
        at_rest(deck)

    scene = loaded(tmp_path, change)
    assert (scene.top.x, scene.top.z, scene.top.elevation) == ("platform", "platform", 28.0)
    assert scene.top.telescopic_joint.length == pytest.approx(28.0 - 9.4)
    assert scene.top.telescopic_joint.bending_stiffness == pytest.approx(600e6)
    assert (scene.top.body.name, scene.top.body.mass) == ("Ring", 15e3)
    run = simulate(load_scene(tmp_path / "scene.yaml"))
    force, stroke = (float(run[f"tensioner_{n}_static"][0]) for n in ("force", "stroke"))
    law = {
        "links": 800e3 + 50e3 * stroke,
        "winches": 800e3,
        "table": np.interp(stroke, [-5.0, 0.0, 5.0], [700e3, 800e3, 1000e3]),
    }
    assert force == pytest.approx(law[kind], rel=1e-6)
    # the ring hangs between its tensioners and the riser, which hangs on it with its contents
    length = REACH + stroke
    vertical = 4.0 * force * math.sqrt(length**2 - 16.0) / length
    weight = 15e3 * GRAVITY + sum(
        (s.submerged_weight + s.contents_mass * GRAVITY) * s.total_length for s in scene.riser
    )
    assert vertical - weight == pytest.approx(float(run["lower_end_tension"]), rel=1e-6)


def test_a_rig_moves_with_its_vessel_and_names_what_it_leaves(tmp_path, capsys):
    scene = loaded(tmp_path, rig)
    assert scene.platform.response is not None
    said = capsys.readouterr().out
    assert "6DBuoys[Ring].MomentsOfInertia" in said
    assert "LineTypes[Barrel].MassPerUnitLength" in said  # hangs on the vessel, not on the riser


def test_a_constraint_that_turns_is_a_flex_joint(tmp_path):
    plain, flexed = (loaded(tmp_path, change) for change in (lambda deck: None, flexing))
    assert flexed.bottom == plain.bottom


def test_a_line_in_soil_has_the_soil_of_its_model(tmp_path):
    scene = loaded(tmp_path, in_soil)
    clay = scene.soil.resistance
    assert (scene.bottom.hold, scene.bottom.elevation) == ("foot", pytest.approx(-554.4))
    assert scene.soil.mudline == scene.water.seabed == -500.0
    assert (clay.strength_at_mudline, clay.strength_gradient) == (8e3, 0.0)
    assert clay.submerged_unit_weight == pytest.approx(600.0 * GRAVITY)
    assert (clay.strain_at_half_strength, clay.depth_factor) == (0.02, 0.5)
    left = [line for line in read_deck(changed(tmp_path, in_soil)).left_out if "P-y" in line]
    assert left == [
        "P-yModels[Clay].PyCurves[0].ModelType: the curve is Matlock's cube root under static load, "
        "with a straight line below 0.1 times the displacement at half the resistance"
    ]


def test_line_types_of_later_versions_are_the_same(tmp_path):
    plain, other = loaded(tmp_path).riser, loaded(tmp_path, later).riser
    assert [section.replaced(tangential_drag=None) for section in other] == plain
    along = {s.name: s.tangential_drag and s.tangential_drag.coefficient for s in other}
    assert along == dict.fromkeys(along, None) | {"Joint": 0.008}
    left = read_deck(changed(tmp_path, later)).left_out
    assert not any(name in line for name in (".Ca", ".EI", ".Cd") for line in left)


def test_a_ring_in_the_water_displaces_it_and_drags():
    buoy = {
        "Name": "Ring", "BuoyType": "Lumped buoy", "Connection": "Free", "Mass": 15.0, "Volume": 2.0,
        "InitialPosition": [0, 0, -4], "DragArea": [3, 3, 8], "DragForceCoefficient": [1.2, 1.2, 1.5],
    }  # fmt: skip
    body = ring_of(Part(buoy, "6DBuoys[Ring]", DECK), CALM, -4.0)
    assert body["displaced_volume"] == "2 m^3"
    assert body["drag_area"] == {"horizontal": "3.6 m^2", "vertical": "12 m^2"}
    with pytest.raises(InputError, match="along x and y"):
        ring_of(Part(buoy | {"DragArea": [3, 4, 8]}, "6DBuoys[Ring]", DECK), CALM, -4.0)


@pytest.mark.parametrize("seed", range(20))
def test_a_ring_is_given_by_three_numbers_or_refused(seed):
    """A list that is cut, extended or missing never leaves out drag or added mass without a word."""
    draw = np.random.default_rng(seed)
    across, along = draw.uniform(1.0, 9.0, (2, 4)).round(2)
    lists = {
        key: [float(across[k]), float(across[k]), float(along[k])]
        for k, key in enumerate(
            ("DragArea", "DragForceCoefficient", "HydrodynamicMass", "AddedMassCoefficient")
        )
    }
    buoy = {"Name": "Ring", "BuoyType": "Lumped buoy", "Connection": "Free", "Mass": 15.0, "Volume": 2.0}
    buoy["InitialPosition"] = [0, 0, -4]
    body = ring_of(Part(buoy | lists, "6DBuoys[Ring]", DECK), CALM, -4.0)
    assert float(body["drag_area"]["horizontal"].split()[0]) == pytest.approx(across[0] * across[1], rel=1e-5)
    assert float(body["added_mass"]["vertical"].split()[0]) == pytest.approx(along[2] * along[3], rel=1e-5)
    for key, values in lists.items():
        for length in (1, 2, 4):
            with pytest.raises(InputError, match=f"{key}: the number of values is {length}"):
                ring_of(
                    Part(buoy | lists | {key: [*values, 1.0][:length]}, "6DBuoys[Ring]", DECK), CALM, -4.0
                )
    for key in ("DragForceCoefficient", "AddedMassCoefficient"):
        without = {name: values for name, values in lists.items() if name != key}
        with pytest.raises(InputError, match=key):
            ring_of(Part(buoy | without, "6DBuoys[Ring]", DECK), CALM, -4.0)
