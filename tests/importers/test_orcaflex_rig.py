"""Decks of a whole drilling riser: several lines, of whichever version, in whatever order."""

import math
import re
from copy import deepcopy
from pathlib import Path

import numpy as np
import pytest
from ruamel.yaml import YAML

from riserstudy import load_scene, simulate
from riserstudy.errors import InputError
from riserstudy.importers.orcaflex import as_text, read_deck
from riserstudy.scene.load import SceneFile
from riserstudy.scene.origin import unwrap

FOLDER = Path(__file__).parent / "decks"
GRAVITY, SEA, STEEL = 9.80665, 1025.0, 7850.0
LISTS = ("Lines", "Links", "Winches", "6DBuoys", "3DBuoys", "Constraints", "LineTypes", "P-yModels")

#: 250e3, as decks have it
pytestmark = pytest.mark.filterwarnings("ignore::ruamel.yaml.error.MantissaNoDotYAML1_1Warning")


def deck_of(name):
    return YAML(typ="safe", pure=True).load(FOLDER / name)


def written(deck, folder):
    target = folder / "deck.yml"
    writer = YAML(typ="safe", pure=True)
    writer.version, writer.width = (1, 1), 4096
    writer.representer.ignore_aliases = lambda data: True
    with target.open("w") as file:
        writer.dump(deck, file)
    return target


def scene_of(deck, folder):
    path = written(deck, folder)
    tree = read_deck(path).tree
    return SceneFile(str(path), unwrap(tree)[0]).resolved()


def named(deck, of, name):
    return next(one for one in deck[of] if one["Name"] == name)


def table(part, column):
    """Header and rows of the table with a column."""
    return next((key, part[key]) for key in part if column in [c.strip() for c in key.split(",")])


def statics(path, **changes):
    without = {"analysis.duration": None, "analysis.output": None}
    return simulate(load_scene(path, **without, **changes))


def disc(diameter):
    return 0.25 * math.pi * diameter**2


def test_a_drilling_deck_goes_in_as_it_is(tmp_path):
    scene = scene_of(deck_of("drilling.yml"), tmp_path)
    assert [s.name for s in scene.riser] == ['22" PIPE 2', '22" PIPE 1', '22" PIPE 1, above water']
    assert [s.total_length for s in scene.riser] == pytest.approx([0.5, 792.0, 18.0])
    assert [[line.name for line in s.lines or []] for s in scene.riser] == [
        [], ["Choke", "Kill"], ["Choke", "Kill"],
    ]  # fmt: skip
    assert scene.water.seabed == -812.0
    assert (scene.bottom.hold, scene.bottom.elevation) == ("wellhead", -792.5)
    assert scene.bottom.rotation.stiffness == pytest.approx(95e3 * 180.0 / math.pi)
    assert scene.top.telescopic_joint.length == pytest.approx(22.0 - 18.0)
    assert scene.top.rotation.stiffness == pytest.approx(25e3 * 180.0 / math.pi)
    assert scene.top.tensioners.damping == pytest.approx(6e3)
    assert (scene.platform.cruise.speed, scene.platform.cruise.ramp) == (0.3, 10.0)
    assert (scene.wave.height, scene.wave.period) == (3.0, 11.0)


def test_every_object_of_the_deck_is_in_the_scene_or_left_out_by_name(tmp_path):
    deck = deck_of("drilling.yml")
    found = read_deck(written(deck, tmp_path))
    used = {"Riser", "Slip joint", "Choke", "Kill", "Stub", "Ring", "T1", "T2", "T3", "T4",
            '22" PIPE', "Sliding", "Service"}  # fmt: skip
    for of in LISTS:
        for one in deck[of]:
            whole = [line for line in found.left_out if line.startswith(f"{of}[{one['Name']}]: ")]
            assert bool(whole) != (one["Name"] in used), one["Name"]


def test_the_deck_hangs_in_balance_with_all_its_lines(tmp_path):
    target = tmp_path / "scene.yaml"
    deck = written(deck_of("drilling.yml"), tmp_path)
    target.write_text(as_text(read_deck(deck), deck))
    run = statics(target)
    force, stroke = (float(run[f"tensioner_{n}_static"][0]) for n in ("force", "stroke"))
    length = math.hypot(2.5, 23.0 - 18.0)  # of a tensioner, the riser unstretched
    assert force == pytest.approx(
        1e3 * np.interp(length + stroke, [0, 4, 8, 14], [1500, 1900, 2050, 2500]), rel=1e-6
    )
    pull = 4.0 * force * math.sqrt((length + stroke) ** 2 - 2.5**2) / (length + stroke)
    mass = {
        "riser": STEEL * (disc(0.56) - disc(0.51)) * 810.5 + 1500.0 * disc(0.51) * 810.0,
        "lines": 2.0 * 810.0 * (STEEL * (disc(0.15) - disc(0.1)) + 1400.0 * disc(0.1)),
        "half of the joint": 4.5 * (400.0 + 1500.0 * disc(0.5)),
        "ring": 1.0,
    }
    displaced = SEA * (792.5 * disc(0.56) + 2.0 * 792.0 * disc(0.15))
    weight = GRAVITY * (sum(mass.values()) - displaced)
    assert pull - weight == pytest.approx(float(run["lower_end_tension"]), rel=1e-6)


def test_a_ring_that_is_free_gives_the_riser_no_moment(tmp_path):
    def hung(deck):
        for of, name in (("Lines", "Slip joint"), ("Lines", "Choke"), ("Lines", "Kill")):
            deck[of].remove(named(deck, of, name))
        deck["Environment"]["RefCurrentSpeed"] = 0.8
        return deck

    deck = written(hung(deck_of("drilling.yml")), tmp_path)
    tree = read_deck(deck).tree
    assert tree["top"]["rotation"] == "free"
    target = tmp_path / "scene.yaml"
    target.write_text(as_text(read_deck(deck), deck))
    moment = statics(target)["bending_moment"]
    assert abs(float(moment[-1])) < 1e-6 * float(abs(moment).max())


def test_drag_along_lines_and_damping_of_links_are_carried(tmp_path):
    scene = scene_of(deck_of("drilling.yml"), tmp_path)
    alone, dressed = scene.riser[:2]
    assert alone.tangential_drag.coefficient * alone.tangential_drag.diameter == 0.01 * 0.56
    both = 0.01 * (0.56 + 2.0 * 0.15)
    assert dressed.tangential_drag.coefficient * dressed.tangential_drag.diameter == pytest.approx(both)
    assert dressed.drag.constant * dressed.drag.diameter == pytest.approx(1.1 * 0.56 + 2.0 * 1.2 * 0.15)
    assert dressed.added_mass.displaced(1.0) == pytest.approx(disc(0.56) + 2.0 * disc(0.15))


def respelled(deck, seed):
    """The same deck as other versions and other hands write it."""
    chance = np.random.default_rng(seed)
    sea, vessel = deck["Environment"], deck["Vessels"][0]
    if chance.random() < 0.5:
        sea["WaterDepth"] = sea.pop("SeabedOriginDepth")
    if chance.random() < 0.5:
        vessel["InitialHeading"] = vessel.pop("Orientation")[2]
    for line in deck["Lines"]:
        if chance.random() < 0.5 and "Sections" not in line:
            header, rows = table(line, "LineType")
            del line[header]
            line["Sections"] = [
                {"LineType": kind, "Length": length, "NumberOfSegments": 3} for kind, length, _ in rows
            ]
        header, rows = table(line, "ConnectionxBendingStiffness")
        if chance.random() < 0.5:
            del line[header]
            header = "ConnectionxBendingStiffness, ConnectionyBendingStiffness"
            rows = line[header] = [row[:2] for row in rows]
        if chance.random() < 0.5:  # told from its other end
            line["TopEnd"] = "End B"
            sections = line["Sections"] if "Sections" in line else table(line, "LineType")[1]
            for upside in (table(line, "ConnectionX")[1], rows, sections):
                upside.reverse()
    for link in deck["Links"]:
        if chance.random() < 0.5:
            table(link, "ConnectionX")[1].reverse()
    for of in LISTS:
        chance.shuffle(deck[of])
    return deck


@pytest.mark.parametrize("seed", range(8))
def test_versions_and_orders_of_a_deck_are_one_scene(tmp_path, seed):
    plain = scene_of(deck_of("drilling.yml"), tmp_path)
    other = scene_of(respelled(deck_of("drilling.yml"), seed), tmp_path)
    for one, same in zip(plain.riser, other.riser, strict=True):
        by_name = [sorted(s.lines or [], key=lambda line: line.name) for s in (one, same)]
        assert by_name[0] == by_name[1]
        assert one.replaced(lines=None) == same.replaced(lines=None)
    assert other.replaced(riser=plain.riser) == plain


@pytest.mark.parametrize("seed", range(4))
def test_a_riser_of_lines_on_end_is_the_riser_of_one_line(tmp_path, seed):
    chance = np.random.default_rng(seed)
    deck = deck_of("drilling.yml")
    for name in ("Choke", "Kill"):
        deck["Lines"].remove(named(deck, "Lines", name))
    plain = scene_of(deepcopy(deck), tmp_path)
    riser = named(deck, "Lines", "Riser")
    lengths = np.round(810.0 * chance.dirichlet([3.0] * 3), 1)
    lengths[-1] = 810.0 - lengths[0] - lengths[1]
    points = ["Ring", "A", "B", "Joint point"]
    deck["Lines"].remove(riser)
    for k, length in enumerate(lengths):
        piece = deepcopy(riser) | {"Name": f"Riser {k}"}
        ends = table(piece, "ConnectionX")[1]
        ends[0][0], ends[1][0] = points[k : k + 2]
        table(piece, "LineType")[1][0][1] = float(length)
        deck["Lines"].append(piece)
    deck["6DBuoys"] += [named(deck, "6DBuoys", "Joint point") | {"Name": n} for n in "AB"]
    other = scene_of(deck, tmp_path)
    assert len(other.riser) == len(plain.riser) + 2
    assert other.hanging == pytest.approx(plain.hanging)
    assert other.bottom == plain.bottom
    assert other.top == plain.top


FAULTS = {
    "General.UnitsSystem": lambda d: d["General"].update(UnitsSystem="US"),
    "Environment.Density": lambda d: d["Environment"].pop("Density"),
    "Environment.SeabedSlope": lambda d: d["Environment"].update(SeabedSlope=2),
    "WaveTrains[Wave 1].WaveType": lambda d: d["Environment"]["WaveTrains"][0].update(WaveType="Gerstner"),
    'LineTypes[22" PIPE].E:': lambda d: d["LineTypes"][0].pop("E"),
    'LineTypes[22" PIPE].CoatingThickness': lambda d: d["LineTypes"][0].update(CoatingThickness=0.02),
    "LineTypes[Sliding].EI": lambda d: d["LineTypes"][1].update(EI=[400e3, 300e3]),
    "Links[T3].LinearDamper": lambda d: named(d, "Links", "T3").update(LinearDamper=False),
    "Vessels[Rig].Orientation": lambda d: d["Vessels"][0].update(Orientation=[0, 0, 20]),
    "VesselTypes[Six columns].Symmetry": lambda d: d["VesselTypes"][0].update(Symmetry="circular"),
    "6DBuoys[Joint point].Mass": lambda d: named(d, "6DBuoys", "Joint point").update(Mass=40),
    "Lines[Riser].ContentsMethod": lambda d: named(d, "Lines", "Riser").update(ContentsMethod="Slug flow"),
    "Lines[Choke].Length": lambda d: table(named(d, "Lines", "Choke"), "LineType")[1].pop(),
}  # fmt: skip


@pytest.mark.parametrize("seed", range(6))
def test_all_that_is_wrong_with_a_deck_is_told_at_once(tmp_path, seed):
    chance = np.random.default_rng(seed)
    deck = deck_of("drilling.yml")
    wrong = list(chance.choice(list(FAULTS), size=chance.integers(2, 7), replace=False))
    for name in wrong:
        FAULTS[name](deck)
    with pytest.raises(InputError) as refused:
        read_deck(written(deck, tmp_path))
    lines = str(refused.value).splitlines()
    assert re.search(rf": {len(wrong)} faults:$", lines[0])
    for name in wrong:
        assert sum(name in line for line in lines[1:]) == 1, name


def spoiled(deck, chance):
    """A deck with an entry taken out, or one in the place of another."""
    here = deck
    while True:
        keys = list(here) if isinstance(here, dict) else list(range(len(here)))
        if not keys:
            return
        key = keys[chance.integers(len(keys))]
        if not isinstance(here[key], dict | list) or chance.random() < 0.1:
            break
        here = here[key]
    values = [None, "~", 0, -1, 1e308, "Infinity", True, "Riser", "Ring", [], {}, [1, 2], "x" * 99]
    if chance.random() < 0.3:
        del here[key]
    else:
        here[key] = values[chance.integers(len(values))]


@pytest.mark.long
@pytest.mark.parametrize("name", ["riser.yml", "drilling.yml"])
def test_a_spoiled_deck_is_read_or_refused(monkeypatch, name):
    chance, plain = np.random.default_rng(3), deck_of(name)
    refused = 0
    for _ in range(300):
        deck = deepcopy(plain)
        spoiled(deck, chance)
        monkeypatch.setattr("riserstudy.importers.orcaflex.read.read_yaml", lambda path: deck)  # noqa: B023
        try:
            read_deck(Path("deck.yml"))
        except InputError:
            refused += 1
    assert 50 < refused < 300
