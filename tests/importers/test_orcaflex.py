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
from riserstudy.importers.orcaflex import read_deck
from riserstudy.importers.orcaflex.deck import Part
from riserstudy.importers.orcaflex.sea import Sea
from riserstudy.importers.orcaflex.top import ring_of
from riserstudy.model.rao import operator
from riserstudy.model.sea import components

DECK = Path(__file__).parent / "decks/riser.yml"
GRAVITY = 9.80665
CALM = Sea(0.0, -500.0, 1025.0, GRAVITY)
#: headers of tables, as decks have them
ENDS = (
    "Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionAzimuth, ConnectionDeclination, "
    "ConnectionGamma, ConnectionReleaseStage, ConnectionzRelativeTo"
)
BENDING = "ConnectionxBendingStiffness, ConnectionyBendingStiffness"
SECTIONS = "LineType, Length, TargetSegmentLength"
CURRENT = "CurrentDepth, CurrentFactor, CurrentRotation"
LINKED = "Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionzRelativeTo"
WINCHED = "Connection, ConnectionX, ConnectionY, ConnectionZ"
SPRING = "SpringLength, SpringTension"
STAGES = "StageMode, StageValue"
FREEDOMS = "DOFFree, DOFInitialValue"


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
    writer.representer.ignore_aliases = lambda data: True
    with target.open("w") as file:
        writer.dump(deck, file)
    return target


def loaded(folder, change=lambda deck: None):
    """Its scene, by the command."""
    target = folder / "scene.yaml"
    sys.argv = ["riserstudy", "import", str(changed(folder, change)), "-o", str(target), "--force"]
    main()
    return load_scene(target).resolved()


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
        "Environment.SeabedType", "VesselTypes[Semi].Length", "LineTypes[Joint].PoissonRatio",
        "what only draws",
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
        for s in _file(tmp_path, pulled).resolved().riser
    )
    assert vertical - weight == pytest.approx(float(found["lower_end_tension"]), rel=1e-6)


def sea(deck, **changes):
    """A JONSWAP sea in the place of the wave."""
    train = deck["Environment"]["WaveTrains"][0]
    del train["WaveHeight"], train["WavePeriod"]
    train.update({
        "WaveType": "JONSWAP", "WaveJONSWAPParameters": "Partially specified", "WaveHs": 5.0,
        "WaveTp": 11.0, "WaveGamma": 2.0, "WaveNumberOfComponents": 60, "WaveSeed": 12345, **changes,
    })  # fmt: skip
    for key in [key for key, value in train.items() if value is None]:
        del train[key]


def test_a_sea_keeps_its_height_period_and_shape(tmp_path, capsys):
    wave = loaded(tmp_path, sea).wave
    assert (wave.significant_height, wave.peak_period, wave.peak_enhancement) == (5.0, 11.0, 2.0)
    assert (wave.components, wave.seed, wave.ramp) == (60, 12345, 20.0)
    assert "WaveSeed: the record is another" in capsys.readouterr().out


@pytest.mark.parametrize("kind", ["JONSWAP", "ISSC"])
def test_a_sea_told_by_its_zero_crossings_has_them(tmp_path, kind):
    def change(deck):
        sea(
            deck, WaveType=kind, WaveTp=None, WaveTz=8.0, WaveGamma=3.3, WaveNumberOfComponents=9000
        )

    wave = loaded(tmp_path, change).wave
    frequency, amplitude = components(wave)
    crossing = (
        2.0 * math.pi * math.sqrt((amplitude**2).sum() / ((amplitude * frequency) ** 2).sum())
    )
    assert crossing == pytest.approx(
        8.0, rel=0.02
    )  # components end at ten times the peak's frequency
    assert wave.peak_period > 9.5


REACH = math.hypot(5.0 - 1.0, 20.0)  # of each tensioner, the riser unstretched


def rig(deck, links=0, winches=0):
    """A ring of 15 t on four tensioners to the vessel, by a table if nothing is asked, under a joint."""
    line = deck["Lines"][0]
    line[ENDS][0] = ["Ring", 0, 0, 0, 0, 180, 0]
    line[BENDING][0] = ["Infinity", None]
    deck["6DBuoys"] = [{
        "Name": "Ring", "BuoyType": "Lumped buoy", "Connection": "Free", "Mass": 15.0, "Volume": 2.0,
        "InitialPosition": [0, 0, 9.4], "MomentsOfInertia": [1, 1, 1],
    }]  # fmt: skip
    deck["LineTypes"].append({
        "Name": "Barrel", "Category": "General", "OD": 0.5, "ID": 0.4, "EIx": 600e3, "MassPerUnitLength": 0.5,
    })  # fmt: skip
    deck["Lines"].append({
        "Name": "InnerBarrel", "TopEnd": "End A",
        ENDS: [["Rig", 0, 0, 28, 0, 180, 0], ["Slip", 0, 0, 0, 0, 180, 0]],
        BENDING: [[10, None], ["Infinity", None]],
        SECTIONS: [["Barrel", 18.6, 2]],
    })  # fmt: skip
    free = [[False], [False], [True, -1.0], [False], [False], [False]]
    deck["Constraints"] = [{
        "Name": "Slip", "InFrameConnection": "Ring", "ConstraintType": "Calculated DOFs", FREEDOMS: free,
        "TranslationalStiffness": 0,
    }]  # fmt: skip
    places = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    ends = [[["Rig", 5 * x, 5 * y, 29.4], ["Ring", x, y, 0]] for x, y in places]
    table = [[REACH - 5.0, 700.0], [REACH, 800.0], [REACH + 5.0, 1000.0]]
    straight = {"LinearSpring": "Yes", "UnstretchedLength": REACH - 16.0, "Stiffness": 50.0}
    for k, end in enumerate(ends):
        if winches:
            deck.setdefault("Winches", []).append({
                "Name": f"T{k}", "WinchType": "Simple", WINCHED: end, "Stiffness": 1e5, "Damping": 0,
                "WinchControlType": "By stage", STAGES: [["Specified tension", 800.0]] * 3,
            })  # fmt: skip
            continue
        law = straight if links else {"LinearSpring": "No", SPRING: table}
        deck.setdefault("Links", []).append(
            {"Name": f"T{k}", "LinkType": "Spring/damper", WINCHED: end, **law}
        )


def at_rest(deck):
    """Without waves and current."""
    deck["Environment"]["WaveTrains"][0]["WaveHeight"] = 0
    deck["General"]["StageDuration"] = None
    del deck["Environment"]["RefCurrentSpeed"]


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


def flexing(deck):
    """The lower end clamped to a constraint on the seabed that turns about x and y."""
    line = deck["Lines"][0]
    line[ENDS][1] = ["Flex", 0, 0, 0, 0, 0, 0]
    line[BENDING][1] = ["Infinity", None]
    free = [[False], [False], [False], [True, 0], [True, 0], [False]]
    deck["Constraints"] = [{
        "Name": "Flex", "InFrameConnection": "Anchored", "InFrameInitialPosition": [0, 0, 5],
        "ConstraintType": "Calculated DOFs", FREEDOMS: free, "StiffnessAndDampingMethod": "Coefficients",
        "RotationalStiffness": 120.0,
    }]  # fmt: skip


def test_a_constraint_that_turns_is_a_flex_joint(tmp_path):
    plain, flexed = (loaded(tmp_path, change) for change in (lambda deck: None, flexing))
    assert flexed.bottom == plain.bottom


def _file(folder, change):
    loaded(folder, change)
    return load_scene(folder / "scene.yaml")


def in_soil(deck, **other):
    """The lowest pipe reaches 54.4 m into clay."""
    clay = {
        "DepthBelowSeabedFrom": 0, "ModelType": "API RP 2A soft clay", "EffectiveUnitSoilDensity": 0.6,
        "UndrainedShearStrength": 8, "J": 0.5, "Epsilonc": 2,
    }  # fmt: skip
    deck["P-yModels"] = [{"Name": "Clay", "PyCurves": [clay | other]}]
    line = deck["Lines"][0]
    line["PyModel"] = "Clay"
    line[ENDS][1][3] = -54.4
    line[BENDING][1] = [0, None]
    line[SECTIONS].append(["Pipe", 59.4, 5])


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
        "below 0.1 of the displacement at half the resistance a straight line"
    ]


def later(deck):
    """Line types as later versions write them."""
    joint, pipe = deck["LineTypes"]
    for name in ("EIx", "EIy", "Cdx", "Cdy", "Cax", "Cay"):
        joint.pop(name, None), pipe.pop(name, None)
    joint.update(EI=[250e3, None], Cd=[1.1, None, 0.008], Ca=[1, None, 0])
    pipe.update(Cdn=1.2, Can=1)


def test_line_types_of_later_versions_are_the_same(tmp_path):
    plain, other = loaded(tmp_path).riser, loaded(tmp_path, later).riser
    assert [section.model_copy(update={"tangential_drag": None}) for section in other] == plain
    along = {s.name: s.tangential_drag and s.tangential_drag.coefficient for s in other}
    assert along == dict.fromkeys(along, None) | {"Joint": 0.008}
    left = read_deck(changed(tmp_path, later)).left_out
    assert not any(name in line for name in (".Ca", ".EI", ".Cd") for line in left)


@pytest.mark.parametrize(
    "change, said",
    [
        (lambda d: d["General"].update(UnitsSystem="US"), "General.UnitsSystem: US; allowed is SI"),
        (lambda d: d["Lines"].append(deepcopy(d["Lines"][0])), "2 of them may be the riser"),
        (lambda d: d["Environment"].pop("Density"), "nothing is guessed"),
        (lambda d: d["LineTypes"][0].update(EIy=100.0), "EIy: 100.0"),
        (lambda d: d["LineTypes"][1].update(Category="Stress joint"), "Homogeneous pipe"),
        (lambda d: d["Lines"][0][SECTIONS][0].__setitem__(0, "Foam"), "no line type 'Foam'"),
        (lambda d: d["Lines"][0][ENDS][1].__setitem__(0, "Buoy"), "from 'Rig' to 'Buoy'"),
        (lambda d: d["Lines"][0][ENDS][0].__setitem__(5, 90), "declination 90"),
        (lambda d: d["Environment"]["WaveTrains"][0].update(WaveType="Cnoidal", WavePeriod=4), "harmonic"),
        (lambda d: sea(d, WaveJONSWAPParameters="Automatic"), "Partially specified"),
        (lambda d: sea(d, WaveNumberOfSpectralDirections=7), "allowed is 1"),
        (lambda d: sea(d, WaveTp=None), "missing, as WaveTz is"),
        (lambda d: d["Lines"][0].update(PyModel="Soft clay"), "no p-y model 'Soft clay'"),
        (lambda d: in_soil(d, DepthBelowSeabedFrom=3), "1 ranges of depth; allowed is one from 0 m"),
        (lambda d: in_soil(d) or d["P-yModels"][0]["PyCurves"].append({}), "2 ranges of depth"),
        (lambda d: in_soil(d, ModelType="API RP 2A sand"), "no curves of sand"),
        (lambda d: in_soil(d, ModelType="P-y table"), "no tables"),
        (lambda d: in_soil(d, Epsilonc=None), "Epsilonc: missing"),
        (lambda d: later(d) or d["LineTypes"][0].update(Cdx=1.1), "Cd: given twice"),
        (lambda d: later(d) or d["LineTypes"][0].update(EI=[250e3, 200e3]), "EI: 250000.0, 200000.0"),
        (lambda d: rig(d, links=1) or d["Links"][0].update(Stiffness=40.0), "equal ones"),
        (lambda d: rig(d) or d["Constraints"][0].update(TranslationalStiffness=5.0), "slides freely"),
        (lambda d: rig(d) or d["Constraints"][0][FREEDOMS][5].__setitem__(0, True), "z alone"),
        (lambda d: rig(d) or d["6DBuoys"][0].update(BuoyType="Spar buoy"), "Lumped buoy"),
        (lambda d: rig(d, winches=1) or d["Winches"][0][STAGES].append(["Payout rate", 0.1]), "all stages"),
        (lambda d: flexing(d) or d["Constraints"][0][FREEDOMS][0].__setitem__(0, True), "Rx and Ry"),
        (lambda d: d["Environment"].update(VerticalCurrentVariationMethod="Power law"), "Interpolated"),
        (lambda d: d["Environment"][CURRENT].append([1]), "CurrentFactor: None"),
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


def test_a_ring_in_the_water_displaces_it_and_drags():
    buoy = {
        "Name": "Ring", "BuoyType": "Lumped buoy", "Connection": "Free", "Mass": 15.0, "Volume": 2.0,
        "InitialPosition": [0, 0, -4], "DragArea": [3, 3, 8], "DragForceCoefficient": [1.2, 1.2, 1.5],
    }  # fmt: skip
    body = ring_of(Part(buoy, "6DBuoys[Ring]", DECK), CALM)
    assert body["displaced_volume"] == "2 m^3"
    assert body["drag_area"] == {"horizontal": "3.6 m^2", "vertical": "12 m^2"}
    with pytest.raises(InputError, match="same along x and y"):
        ring_of(Part(buoy | {"DragArea": [3, 4, 8]}, "6DBuoys[Ring]", DECK), CALM)
