"""Outputs of every command: no input and no file of another kind is replaced without being told to.

Commands and their outputs are found in the command line itself, so that a new one is tested too.
"""

import inspect
import random
import shutil
import sqlite3
import typing
from pathlib import Path

import pytest
import typer

from riserstudy import cli
from riserstudy.cli.targets import ENDINGS, Writes
from riserstudy.database.build import schema
from riserstudy.scene.tables import PLACES, is_table

pytestmark = pytest.mark.long

DECKS = Path(__file__).parents[1] / "importers/decks"
SCENE = """\
title: one section in a current
gravity: 9.81 m/s^2
water: {density: 1025 kg/m^3, surface: 300 m, seabed: 0 m}
riser:
  - {name: riser, length: 300 m, outer_diameter: 0.5 m, inner_diameter: 0.46 m, young_modulus: 210 GPa,
     mass: 400 kg/m, submerged_weight: 2 kN/m, drag: {coefficient: 1, diameter: 0.5 m}}
current: {profile: {file: current.csv}}
bottom: {hold: wellhead, elevation: 0 m, rotation: free}
top: {x: platform, z: free, tension: 1.5 MN, rotation: free}
platform: {surge: {file: surge.csv}}
analysis: {duration: 4 s, mesh: {elements: 6}, step: 0.2 s, output: {interval: 1 s}}
"""
TABLES = {
    "current.csv": "elevation (m), speed (m/s)\n0, 0\n300, 0.4\n",
    "surge.csv": "time (s), value (m)\n" + "0, 0\n2, 0\n4, 0\n8, 0\n",
}
#: a table that each place of a scene could read
HEADINGS = [",".join(f"{names[0]} (m)" for names in place.columns) for place in PLACES]
WELD = {
    "fatigue.angles": 8,
    "fatigue.details": [
        {
            "name": "weld",
            "at": "lower end of riser",
            "stress_per_moment": "1 MPa/kN/m",
            "thickness": "25 mm",
            "curve": {"detail_class": "D", "environment": "air"},
            "stress_concentration": 1.0,
            "safety_factor": 3.0,
        }
    ],
}
RECORD = "time,hs (m),tp (s)\n" + "".join(
    f"2001-01-01 0{hour}:00,{height},{period}\n"
    for hour, (height, period) in enumerate([(1, 8), (3, 9), (2, 12), (1, 10)])
)
OPERATORS = "8 0 1 0.5 0 0.5 0\n12 0 1 0.7 0 0.7 0\n"  # of WAMIT: surge at two periods
#: parameters that are read, by what the help calls them
INPUTS = {
    "SCENE.yaml": "scene.yaml",
    "FILE.nc": "run.nc",
    "DECK.yml": "deck.yml",
    "OLD": "run.nc",
    "NEW": "run.nc",
    "STUDY.yaml": "study.yaml",
    "RECORD.csv": "record.csv",
    "OTHER.csv": "other_program.csv",
    "STUDY.nc": "damage.nc",
    "STATEMENT": "select path from files",
}
READ_BY_OPTION = {"--results", "--config", "--scatter", "--seas", "--without", "--scene", "--study"}
#: options that a command needs, and what its scene lacks of what it is about
NEEDED = {
    "tension": [
        *("--units", "6", "--failed", "1", "--tension-ratio", "0.95"),
        *("--weight", "1.05", "--buoyancy", "0.96"),
        *("--set", "riser[0].buoyancy_lift=0 N/m"),
        *("--set", "riser[0].contents={density: 1200 kg/m^3}"),
    ],
    "envelope": ["--reach", "1 m", "--current", "0.2 m/s", "--set", "limits=ANGLES"],
    "watch-circles": [
        *("--disconnect", "1 s", "--prepare", "1 s", "--set", "limits=ANGLES"),
        *("--set", "platform={cruise: {speed: 1 m/s, ramp: 2 s}}"),
    ],
    "recoil": ["--set", "disconnect={at: 2 s}"],
    "seas": ["record.csv"],  # or a synthetic one
    "downtime": [
        *("--scene", "scene.yaml", "--seeds", "1", "--error", "0.5", "--set", "limits=ANGLES"),
        *("--set", "platform=IN_A_SEA"),
    ],
}
WRITTEN = (0, 4)  # exit status; 4: not all of what the command is about could be evaluated
IN_A_SEA = (
    "{centre_of_rotation: {elevation: 300 m}, response: {phases: lead, beyond: hold, ramp: 1 s, "
    "operators: [{period: 5 s, surge: 0.1 m/m, surge_phase: 90 deg}, "
    "{period: 20 s, surge: 0.3 m/m, surge_phase: 90 deg}], "
    "wave: {significant_height: 1 m, peak_period: 8 s, peak_enhancement: 2, components: 5, seed: 1}}}"
)
ANGLES = "[{output: lfj_angle, largest: 9 deg, mode: disconnect}]"


def parameters(command):
    """Name, type, marks and option or argument of each parameter of a command."""
    hints = typing.get_type_hints(command, include_extras=True)
    for name, parameter in inspect.signature(command).parameters.items():
        base, *marks = typing.get_args(hints[name])
        (info,) = [mark for mark in marks if isinstance(mark, typer.models.ParameterInfo)]
        yield name, base, [mark for mark in marks if isinstance(mark, Writes)], info, parameter


def called(name, info):
    """How an option is given: Typer takes the first of its names for a default until it is asked."""
    given = [info.default, *(info.param_decls or ())]
    return [n for n in given if isinstance(n, str) and n.startswith("-")] or [f"--{name.replace('_', '-')}"]


def commands_of_the_line():
    return {info.name or info.callback.__name__: info.callback for info in cli.app.registered_commands}


def outputs():
    """Command, option and kinds of every output but folders."""
    for command, function in commands_of_the_line().items():
        for name, _, marks, info, _ in parameters(function):
            for mark in marks:
                if mark.kinds:
                    yield command, called(name, info)[0], mark.kinds


OUTPUTS = list(outputs())
IDS = [f"{command} {option}" for command, option, _ in OUTPUTS]
every_output = pytest.mark.parametrize("command, option, kinds", OUTPUTS, ids=IDS)


def test_every_file_of_a_command_is_known_as_one_that_it_reads_or_writes():
    for command, function in commands_of_the_line().items():
        for name, base, marks, info, _ in parameters(function):
            if Path not in (base, *typing.get_args(base)):
                continue
            if isinstance(info, typer.models.ArgumentInfo):
                read = info.metavar in INPUTS
            else:
                read = bool(READ_BY_OPTION & {*called(name, info)})
            assert read != bool(marks), f"{command}: {name}"


def test_every_command_with_an_output_can_be_told_to_replace_it():
    for command, function in commands_of_the_line().items():
        marked = [mark for _, _, marks, _, _ in parameters(function) for mark in marks if mark.kinds]
        forced = "force" in inspect.signature(function).parameters
        assert forced == bool(marked), command


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    """A folder with one good input of each kind."""
    folder = tmp_path_factory.mktemp("inputs")
    (folder / "scene.yaml").write_text(SCENE)
    for name, text in TABLES.items():
        (folder / name).write_text(text)
    shutil.copy(DECKS / "riser.yml", folder / "deck.yml")
    (folder / "body.4").write_text(OPERATORS)
    (folder / "record.csv").write_text(RECORD)
    (folder / "other_program.csv").write_text("time (s),ufj_angle (deg)\n0,0\n1,1\n2,1\n3,1\n4,0\n")
    (folder / "results").mkdir()
    (folder / "results/reproduction.csv").write_text("paper,id\n")
    with sqlite3.connect(folder / "results/results.sqlite") as db:
        db.executescript(schema())
        db.execute("insert into about values ('1', 'test')")
        db.execute("insert into files values ('reproduction.csv', 'table', 9, ?)", ("0" * 64,))
    db.close()
    from riserstudy.dataset.write_dataset import write_dataset
    from riserstudy.scene.load import read_scene
    from riserstudy.simulation.simulate import simulate

    scene = read_scene(folder / "scene.yaml")
    write_dataset(simulate(scene), folder / "run.nc")
    write_dataset(simulate(scene.with_values(WELD, "test")), folder / "damage.nc")
    return folder


@pytest.fixture
def here(inputs, tmp_path, monkeypatch):
    """In a copy of these inputs; what costs are asked for is one tolerance alone."""
    monkeypatch.setattr("riserstudy.advice.accuracy_cost.REQUESTS", (0.05,))
    folder = tmp_path / "here"
    shutil.copytree(inputs, folder)
    monkeypatch.chdir(folder)
    return folder


def words_of(command, ending=""):
    """A command with what it needs to write a file of an ending."""
    if (command, ending) == ("import", ".csv"):
        return ["import", "body.4", "--length", "1 m"]
    words = [command]
    for name, _, marks, info, parameter in parameters(commands_of_the_line()[command]):
        if parameter.default is not inspect.Parameter.empty or marks:
            continue
        if isinstance(info, typer.models.ArgumentInfo):
            words.append(INPUTS[info.metavar])
        else:
            assert called(name, info)[0] in NEEDED.get(command, ()), f"{command}: {name}"
    return words + [
        word.replace("ANGLES", ANGLES).replace("IN_A_SEA", IN_A_SEA) for word in NEEDED.get(command, ())
    ]


def endings_of(kinds):
    return sorted({ending for kind in kinds for ending in ENDINGS[kind]})


def contents(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def otherwise(path, rng):
    """Another way to write a path."""
    ways = [
        lambda: path.absolute(),
        lambda: path,
        lambda: Path("results") / ".." / path,
        lambda: Path("..") / Path.cwd().name / path,
        lambda: _linked(path, "link_to_folder"),
        lambda: _hard_link(path),
    ]
    return rng.choice(ways)()


def _linked(path, name):
    link = Path(name)
    if not link.is_symlink():
        link.symlink_to(Path.cwd())
    return link / path


def _hard_link(path):
    other = path.with_name(f"hard_{path.name}")
    if not other.exists():
        other.hardlink_to(path)
    return other


def inputs_with(command, ending):
    """Words of a command and files that it then reads, those that end as its output does."""
    words = words_of(command, ending)
    for k, word in enumerate(words[1:], 1):
        if not Path(word).is_file():
            continue
        named = Path(word).suffix in (".yaml", ".nc") or word == "record.csv"
        if named and ending != ".csv":
            other = Path(f"input{ending}")
            shutil.copy(word, other)
            yield [*words[:k], str(other), *words[k + 1 :]], other
        if word == "scene.yaml" and ending == ".csv":
            for name in TABLES:
                yield words, Path(name)
            shutil.copy("current.csv", "other.csv")
            yield [*words, "--set", "current.profile={file: other.csv}"], Path("other.csv")
        if Path(word).suffix == ending:
            yield words, Path(word)
    if command in ("results", "sql"):
        yield words, Path("results/reproduction.csv")
        yield words, Path("results/results.sqlite")


def refused(commands, words, folder, seed):
    """What a command says that is refused and leaves all files as they were."""
    before = contents(folder)
    code, out, error = commands(*words)
    assert (code, out, error.count("\n")) == (2, "", 1), (seed, words, error)
    assert contents(folder) == before, (seed, words)
    return error


@every_output
def test_no_output_replaces_an_input(commands, here, command, option, kinds):
    rng, tried = random.Random(f"{command} {option}"), 0
    for ending in endings_of(kinds):
        for words, path in inputs_with(command, ending):
            for seed in range(3):
                target = otherwise(path, rng)
                error = refused(commands, [*words, option, target], here, seed)
                assert option.strip("-")[0] in error
                tried += 1
    assert tried or set(kinds) == {"table"}, "no input ends as this output does"


@every_output
def test_no_output_replaces_a_file_of_another_kind(commands, here, command, option, kinds):
    rng = random.Random(f"{command} {option}")
    for ending in endings_of(kinds):
        for seed in range(4):
            target = Path(f"kept{ending}")
            target.write_bytes(rng.choice([rng.randbytes, _words])(rng.randint(1, 3000)))
            if ending == ".csv":
                target.write_text(f"{HEADINGS[seed % len(HEADINGS)]}\n1,2\n")
                assert is_table(target)
            error = refused(
                commands, [*words_of(command, ending), option, otherwise(target, rng)], here, seed
            )
            assert "--force" in error


def _words(count):
    return (b"what took somebody a day to write\n" * count)[: count * 7]


@every_output
@pytest.mark.parametrize("name", ["notes.txt", "notes", ".nc", "notes.NC", "scene.py", "a.sqlite"])
def test_an_output_of_no_kind_that_a_command_writes_is_refused(commands, here, command, option, kinds, name):
    for forced in ([], ["--force"]):
        error = refused(commands, [*words_of(command), option, name, *forced], here, name)
        assert "write a name that ends in" in error


@every_output
def test_an_output_replaces_its_own_and_what_it_is_told_to(commands, here, command, option, kinds):
    ending = ENDINGS[kinds[0]][0]
    words = words_of(command, ending)
    target = Path(f"out{ending}")
    if (command, option) == ("seas", "--csv"):  # what it writes takes a package that is optional
        assert "--contour" in refused(commands, [*words, option, target], here, 0)
        return
    written = commands(*words, option, target)[0]
    assert written in WRITTEN
    first = target.read_bytes()
    edited = kinds[0] in ("scene", "table of operators", "deck")
    code, _, error = commands(*words, option, target)
    assert (code, error.count("add --force")) == ((2, 1) if edited else (written, 0))
    target.write_text("what somebody does without\n")
    assert commands(*words, option, target, "--force")[0] == written
    assert target.read_bytes()[:8] == first[:8]


@every_output
def test_force_replaces_no_link_and_no_folder(commands, here, command, option, kinds):
    ending = ENDINGS[kinds[0]][0]
    Path(f"link{ending}").symlink_to("scene.yaml")
    Path(f"folder{ending}").mkdir()
    for name in ("link", "folder"):
        words = [*words_of(command), option, f"{name}{ending}", "--force"]
        assert "cannot be written" in refused(commands, words, here, name)
    assert Path(f"link{ending}").is_symlink()


def test_a_folder_for_a_study_is_made_where_nothing_is(commands, here):
    for name in (".", "results", "scene.yaml"):
        assert "already contains files" in refused(commands, ["new", name], here, name)
