"""The run crate of a study: true of every file, valid by the profiles, and rerun by whoever unpacks it."""

import hashlib
import json
import os
import random
import re
import subprocess
import sys
import zipfile
from pathlib import Path
from urllib.parse import unquote

import pytest
from short_study import lay_out, numbers, same, shared_kernels, snakemake

from riserstudy.crate.metadata import NAME, write_crate

pytestmark = pytest.mark.long

VALIDATE = Path(__file__).with_name("validate.py")
TABLE = """\
paper,id,figure,kind,statement,published,simulated,unit,error,verdict,depends_on,margin,margin_low,margin_high,note,grounds
example,C1,1,claim,it sags,,,1,,holds,,0.25,,,,
example,C2,1,claim,it sings,,,1,,not reproducible,,,,,nobody listened,
"""
#: two of the six that are drawn where a study names none
FIGURES = """\
figures:
  tension_utilisation: {caption: Limits over tension, reads: [tension], plot: utilisation}
  heave_lines: {caption: Extremes over amplitude, reads: [heave], plot: lines}
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A study that has run, in a path with a blank."""
    folder = tmp_path_factory.mktemp("crate") / "a study"
    lay_out(folder)
    file = folder / "config/studies/example.yaml"
    file.write_text(file.read_text("utf-8") + FIGURES, "utf-8")
    environment = os.environ | {"RISERSTUDY_CACHE": str(folder.parent / "cache")}
    shared_kernels(folder.parent / "cache")
    status, said = snakemake(folder, environment)
    assert status == 0, said
    return folder, environment


def graph(file):
    return {entity["@id"]: entity for entity in json.loads(file.read_text("utf-8"))["@graph"]}


def references(value):
    if isinstance(value, list):
        return [one for part in value for one in references(part)]
    if isinstance(value, dict):
        own = [value["@id"]] if [*value] == ["@id"] else []
        return own + [one for part in value.values() for one in references(part)]
    return []


def assert_true_of_files(entities, root):
    files = {name: entity for name, entity in entities.items() if "sha256" in entity}
    for name, entity in files.items():
        content = (root / unquote(name)).read_bytes()
        assert entity["sha256"] == hashlib.sha256(content).hexdigest(), name
        assert int(entity["contentSize"]) == len(content), name
    return files


def test_a_run_leaves_a_crate_that_is_true_of_every_file(study):
    folder, _ = study
    entities = graph(folder / "results" / NAME)
    files = assert_true_of_files(entities, folder / "results")
    for name in ("../config/scenes/riser.yaml", "../Snakefile", "example/tension.nc", "report.html"):
        assert name in files
    run = entities["#run"]
    assert run["startTime"] <= run["endTime"]
    inputs, outputs = ({one["@id"] for one in run[side]} for side in ("object", "result"))
    made = {path.relative_to(folder / "results").as_posix() for path in (folder / "results").rglob("*.*")}
    left = {name for name in made if name.startswith(".seals") or name == NAME}
    assert outputs == {name for name in made - left if (folder / "results" / name).is_file()}
    assert all(name.startswith("../") for name in inputs)
    for rule in ("simulate", "database", "report"):
        assert entities[f"#jobs-{rule}"]["startTime"] >= run["startTime"]


def test_a_run_that_was_killed_after_its_last_job_gets_its_crate_from_the_next(study):
    """Without jobs to do, Snakemake calls no hook of the workflow; a dry run writes nothing."""
    folder, environment = study
    crate = folder / "results" / NAME
    before = graph(crate)
    crate.unlink()
    status, said = snakemake(folder, environment, "--dry-run")
    assert (status, crate.exists()) == (0, False), said
    status, said = snakemake(folder, environment)
    assert (status, "Nothing to be done" in said) == (0, True)
    assert graph(crate).keys() == before.keys()
    assert_true_of_files(graph(crate), folder / "results")


def test_every_reference_is_to_an_entity_or_an_address(study):
    entities = graph(study[0] / "results" / NAME)
    for name in {one for entity in entities.values() for one in references(entity)}:
        assert name in entities or name.startswith("http"), name


def test_a_second_run_leaves_the_crate_as_it_is(study):
    folder, environment = study
    crate = folder / "results" / NAME
    before = crate.stat().st_mtime_ns
    status, said = snakemake(folder, environment)
    assert (status, "Nothing to be done" in said) == (0, True)
    assert crate.stat().st_mtime_ns == before


def test_claims_stand_in_it_with_verdict_and_margin(study, tmp_path):
    folder = tmp_path / "copy"
    subprocess.run(["cp", "-a", study[0], folder], check=True)
    (folder / "results/reproduction.csv").write_text(TABLE)
    (folder / "results/.seals/reproduction.csv").write_text("as sealed")
    entities = graph(write_crate(folder))
    assert entities["#review-example-C1"]["reviewRating"]["@id"] == "#verdict-holds"
    assert entities["#margin-example-C1"]["value"] == 0.25
    assert entities["#review-example-C2"]["reviewBody"] == "nobody listened"
    assert "#margin-example-C2" not in entities


@pytest.mark.parametrize("seed", range(4))
def test_a_damaged_table_is_not_packed(seed, study, commands, tmp_path):
    folder = tmp_path / "copy"
    subprocess.run(["cp", "-a", study[0], folder], check=True)
    (folder / "results/.seals/reproduction.csv").write_text("as sealed")
    draw = random.Random(seed)
    whole = bytearray(TABLE.encode())
    for _ in range(3):  # in the header and in the rows
        whole[draw.randrange(len(whole))] = draw.choice(b'\xff,"\n')
    (folder / "results/reproduction.csv").write_bytes(whole)
    code, _, wrong = commands("crate", tmp_path / "study.zip", "--study", folder)
    assert (code, wrong.count("\n")) == (2, 1)
    assert "reproduction.csv" in wrong
    assert not (tmp_path / "study.zip").exists()


def test_what_is_not_known_is_left_out(study):
    entities = graph(study[0] / "results" / NAME)
    assert "agent" not in entities["#run"]
    assert "author" not in entities["./"]
    assert "No licence is stated" in entities["./"]["license"]


def test_an_unpacked_crate_reruns_by_one_command(study, commands, tmp_path):
    folder, environment = study
    code, said, wrong = commands("crate", tmp_path / "study.zip", "--study", folder)
    assert (code, wrong) == (0, "")
    assert "snakemake" in said
    unpacked = tmp_path / "of a stranger"
    with zipfile.ZipFile(tmp_path / "study.zip") as archive:
        archive.extractall(unpacked)
    assert_true_of_files(graph(unpacked / NAME), unpacked)
    packed = numbers(unpacked)
    status, said = snakemake(unpacked, environment, "--forcerun", "simulate")  # without the kernels
    assert status == 0, said
    assert same(packed, numbers(unpacked))


@pytest.mark.parametrize("seed", range(3))
def test_a_changed_input_of_an_unpacked_crate_is_named(study, commands, tmp_path, seed):
    commands("crate", tmp_path / "study.zip", "--study", study[0])
    unpacked = tmp_path / "of a stranger"
    with zipfile.ZipFile(tmp_path / "study.zip") as archive:
        archive.extractall(unpacked)
    code, said, wrong = commands("verify", "--results", unpacked / "results")
    assert (code, wrong, said.splitlines()[0].split(" in ")[0]) == (0, "", "0 faults")
    files = sorted(path for path in (unpacked / "config").rglob("*") if path.is_file())
    file = random.Random(seed).choice([*files, unpacked / "Snakefile"])
    file.write_bytes(file.read_bytes() + b"\n")
    code, said, _ = commands("verify", "--results", unpacked / "results")
    assert code == 1
    assert said.startswith(f"{file}: differs from its checksum in {NAME}; ")
    assert "1 fault in" in said


def test_files_older_than_a_zip_can_say_are_packed(study, commands, tmp_path):
    """As in archives that are made to be the same twice: their files are of 1970."""
    subprocess.run(["cp", "-a", study[0], tmp_path / "old"], check=True)
    for path in (tmp_path / "old/config").rglob("*"):
        os.utime(path, (0, 0))
    code, _, wrong = commands("crate", tmp_path / "old.zip", "--study", tmp_path / "old")
    assert (code, wrong) == (0, "")
    with zipfile.ZipFile(tmp_path / "old.zip") as archive:
        assert archive.testzip() is None
        assert any(name.startswith("config/") for name in archive.namelist())


@pytest.mark.parametrize("seed", range(3))
def test_a_result_that_is_not_as_its_job_wrote_it_is_not_packed(study, commands, tmp_path, seed):
    folder, draw = tmp_path / "copy", random.Random(seed)
    subprocess.run(["cp", "-a", study[0], folder], check=True)
    seals = folder / "results/.seals"
    names = sorted(p.relative_to(seals) for p in seals.rglob("*") if p.is_file() and p.name != "tier")
    file = folder / "results" / draw.choice(names)
    file.write_bytes(file.read_bytes() + b"x")
    code, _, said = commands("crate", tmp_path / "study.zip", "--study", folder)
    assert code == 2
    assert f"{file}: the file was changed after the study wrote it" in said
    assert not (tmp_path / "study.zip").exists()


@pytest.mark.parametrize("seed", range(4))
def test_results_of_a_run_that_did_not_end_are_not_packed(study, commands, tmp_path, seed):
    """A job that is killed or fails has removed its old files."""
    folder, draw = tmp_path / "copy", random.Random(seed)
    subprocess.run(["cp", "-a", study[0], folder], check=True)
    seals = folder / "results/.seals"
    made = sorted(seals.rglob("*.*" if seed % 2 else "*.nc"))
    file = folder / "results" / draw.choice(made).relative_to(seals)
    file.unlink()
    code, _, said = commands("crate", tmp_path / "study.zip", "--study", folder)
    assert code == 2
    assert f"{file}: missing, because" in said
    assert not (tmp_path / "study.zip").exists()


def run_crate(folder, archive, environment):
    """The command in a process of its own, which reads all files again: exit status and messages."""
    main = "from riserstudy.cli import main; raise SystemExit(main())"
    words = [sys.executable, "-c", main, "crate", str(archive), "--study", str(folder)]
    done = subprocess.run(words, env=environment, capture_output=True, text=True)
    return done.returncode, done.stderr


@pytest.mark.parametrize("date", [0.0, 4e9])
def test_an_edit_that_changes_nothing_is_not_told_whatever_its_date(study, tmp_path, date):
    folder = tmp_path / "copy"
    subprocess.run(["cp", "-a", study[0], folder], check=True)
    scene = folder / "config/scenes/riser.yaml"
    scene.write_text(scene.read_text() + "# a note\n")
    os.utime(scene, (date, date))
    assert run_crate(folder, tmp_path / "study.zip", study[1]) == (0, "")


@pytest.mark.parametrize("date", [0.0, 4e9])
@pytest.mark.parametrize(
    "name, old, new",
    [
        ("scenes/riser.yaml", "mass: 700", "mass: 701"),
        ("scenes/current.csv", "0, 0.2", "0, 0.3"),
        ("studies/example.yaml", "[1, 2]", "[1, 3]"),
        ("studies/example.yaml", "heave", "swell"),
    ],
)
def test_results_from_before_an_edit_are_told_whatever_its_date(study, tmp_path, date, name, old, new):
    folder = tmp_path / "copy"
    subprocess.run(["cp", "-a", study[0], folder], check=True)
    file = folder / "config" / name
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))
    os.utime(file, (date, date))
    code, said = run_crate(folder, tmp_path / "study.zip", study[1])
    assert code == 0
    assert f"note: {folder}/results/example/heave.nc and " in said
    assert "made before an edit" in said


@pytest.mark.parametrize("units", ["si", "us", "field"])
def test_figures_and_report_from_before_an_edit_of_the_units_are_told(study, tmp_path, units):
    """A run makes just these again; `field` is what a study without units has."""
    folder = tmp_path / "copy"
    subprocess.run(["cp", "-a", study[0], folder], check=True)
    file = folder / "config/config.yaml"
    file.write_text(re.sub(r"(?m)^units:.*\n", "", file.read_text()) + f"units: {units}\n")
    code, said = run_crate(folder, tmp_path / "study.zip", study[1])
    told = "heave_lines.csv and 6 more: made before an edit of scene, study, units"
    assert (code, told in said) == (0, units != "field"), said
    assert bool(said) == (units != "field")


def test_results_of_which_a_run_made_only_some_are_not_packed(study, tmp_path):
    """A run of one file, or one that was killed, leaves figures and database of the former datasets."""
    folder, environment = tmp_path / "copy", study[1]
    subprocess.run(["cp", "-a", study[0], folder], check=True)
    scene = folder / "config/scenes/riser.yaml"
    scene.write_text(scene.read_text().replace("mass: 700", "mass: 720"))
    status, said = snakemake(folder, environment, "results/example/heave.nc")
    assert status == 0, said
    code, said = run_crate(folder, tmp_path / "study.zip", environment)
    assert code == 2
    assert "the file is older than its inputs" in said
    assert not (tmp_path / "study.zip").exists()
    status, said = snakemake(folder, environment)
    assert status == 0, said
    assert run_crate(folder, tmp_path / "study.zip", environment) == (0, "")


@pytest.mark.parametrize("name", ["there.zip", "study.tar", "nowhere/study.zip", "notes"])
def test_only_a_new_archive_is_written(study, commands, tmp_path, name):
    (tmp_path / "there.zip").write_text("what somebody needs")
    code, _, said = commands("crate", tmp_path / name, "--study", study[0])
    assert code == 2
    assert "name a new .zip file" in said
    assert (tmp_path / "there.zip").read_text() == "what somebody needs"


def test_a_folder_without_results_is_refused_and_nothing_written(commands, tmp_path):
    lay_out(tmp_path / "new")
    code, _, said = commands("crate", tmp_path / "study.zip", "--study", tmp_path / "new")
    assert code == 2
    assert "run the study in this folder first" in said
    assert not (tmp_path / "study.zip").exists()


#: of the environment that `make test-crate` makes
PYTHON = os.environ.get("RISERSTUDY_CRATE_PYTHON", "")
VALIDATOR = pytest.mark.skipif(not PYTHON, reason="run by `make test-crate`")


def validated(crate):
    done = subprocess.run([PYTHON, str(VALIDATE), str(crate)], capture_output=True, text=True, check=True)
    return done.stdout.splitlines()[:-1]


def copied(study, folder):
    """A copy in a path without blanks, which the validator takes for no address."""
    subprocess.run(["cp", "-a", study[0], folder], check=True)
    return folder / "results"


@VALIDATOR
def test_the_crate_meets_the_profiles_of_run_crates(study, tmp_path):
    assert validated(copied(study, tmp_path / "copy")) == []


@VALIDATOR
@pytest.mark.parametrize(
    "name, key", [("#run", "instrument"), ("#step-simulate", "workExample"), ("./", "license")]
)
def test_the_validator_finds_what_is_missing(study, tmp_path, name, key):
    results = copied(study, tmp_path / "copy")
    file = results / NAME
    content = json.loads(file.read_text("utf-8"))
    next(entity for entity in content["@graph"] if entity["@id"] == name).pop(key)
    file.write_text(json.dumps(content))
    assert validated(results)
