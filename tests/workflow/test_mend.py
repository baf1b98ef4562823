"""What would stop Snakemake itself: damaged records, and files from the future."""

import os
import random
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from planning import dry_run
from snakemake.persistence import MetadataRecord
from snakemake.persistence.file import FilePersistence

from riserstudy.jobs import mend

pytestmark = pytest.mark.long

DAY = 24 * 3600.0
SNAKEFILE = """\
from riserstudy.jobs.begin import begin

begun = []

def source(wildcards):
    if not begun and workflow.is_main_process:
        begun.append(True)
        at_work = workflow.executor_plugin and not (workflow.dryrun or workflow.touch)
        outputs = ["results/paper/a.nc", "results/paper/b.nc"]
        damaged, notes = begin(["paper"], outputs, at_work, "preview")
        workflow.dag.forcefiles.update(damaged)
        for note in notes:
            print("note:", note)
    return "config/{kind}.yaml"

rule all:
    input: "results/paper/a.nc", "results/paper/b.nc"
rule made:
    input: source, "chapters/paper.py"
    output: "results/paper/{kind}.nc"
    params: digest=lambda wildcards: open(f"config/{wildcards.kind}.yaml").read()
    shell: "cp {input[0]} {output} && python -c 'from riserstudy.jobs.seals import seal;"
           " from pathlib import Path; seal(Path(\\"{output}\\"))'"
"""


def record(rng):
    """A record as Snakemake writes it."""
    return MetadataRecord(
        rule="simulate",
        input=[f"config/scenes/{rng.randrange(100)}.yaml"],
        log=["logs/a.log"],
        shellcmd=f"python -m riserstudy.jobs simulate 'Überlast' {rng.random()}",
        params=[f"'{rng.randbytes(8).hex()}'"],
        code=rng.choice([None, "gASV"]),
        record_format_version=6,
        starttime=time.time(),
        endtime=time.time() + 1.0,
        job_hash=rng.randrange(10**12),
        input_checksums={"a": "b"},
    )


def spoilt(content, rng):
    """Bytes with a few bits flipped, replaced as a whole, or cut."""
    content = bytearray(content)
    kind = rng.choice(["flip", "flip", "flip", "cut", "other", "noise"])
    if kind == "flip":
        for _ in range(rng.choice([1, 1, 3])):
            content[rng.randrange(len(content))] ^= 1 << rng.randrange(8)
    elif kind == "cut":
        del content[rng.randrange(len(content)) :]
    elif kind == "other":
        others = [b"[]", b"3", b'"text"', b"null", b"[1, 2]", b'{"input": 3}', b"[" * 50_000, b"\\xff"]
        content = rng.choice(others)
    else:
        content = rng.randbytes(len(content))
    return bytes(content)


@pytest.mark.parametrize("seed", range(5))
def test_snakemake_reads_every_record_that_is_left(tmp_path, seed):
    rng = random.Random(seed)
    kept = FilePersistence(path=tmp_path / ".snakemake")
    names = [f"results/paper/{k}{'x' * rng.choice([0, 400])}.nc" for k in range(60)]
    for name in names:
        kept._write_record(name, record(rng))
        kept._mark_incomplete(name, None)
    files = {
        folder: [Path(kept._record_path(getattr(kept, f"_{folder}_path"), name)) for name in names]
        for folder in ("metadata", "incomplete")
    }
    whole = {path: path.read_bytes() for paths in files.values() for path in paths}
    damaged = rng.sample(sorted(whole), 60)
    for path in damaged:
        path.write_bytes(spoilt(whole[path], rng))
    found = mend.unreadable(tmp_path / ".snakemake")
    assert {*found} <= {*damaged}
    assert found
    made = mend.drop(found, tmp_path / ".snakemake")
    assert {*made} == {n for n, path in zip(names, files["metadata"], strict=True) if path in found}
    kept._clear_cache()
    for name in names:
        kept._read_record(name)
        kept._get_external_jobids([name])
    assert kept._filter_incomplete_keys(names) == {*names}
    for path in {*whole} - {*damaged}:
        assert path.read_bytes() == whole[path]
    assert mend.unreadable(tmp_path / ".snakemake") == []


@pytest.mark.parametrize("seed", range(5))
def test_nothing_is_from_the_future_and_the_past_stays(tmp_path, seed):
    rng = random.Random(seed)
    times = {}
    for k in range(30):
        path = tmp_path / rng.choice(["config", "results/.seals", "chapters/a/b"]) / f"{k}.yaml"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
        times[path] = time.time() + rng.choice([-1.0, 1.0]) * rng.uniform(60.0, 4000 * DAY)
        os.utime(path, (times[path], times[path]))
    began = time.time()
    dated, refused = mend.date_today([tmp_path / "absent", *tmp_path.rglob("*")])
    assert {*dated} == {path for path, when in times.items() if when > began}
    assert refused == []
    for path, when in times.items():
        assert path.stat().st_mtime == pytest.approx(min(when, began), abs=60.0 if when > began else 1e-3)


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """A workflow of two results that begins as ours does, done once; only to copy."""
    folder = tmp_path_factory.mktemp("done")
    (folder / "Snakefile").write_text(SNAKEFILE)
    for name in ("config/a.yaml", "config/b.yaml", "chapters/paper.py"):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(name)
    status, said = snakemake(folder)
    assert (status, "(100%) done" in said) == (0, True), said
    return folder


@pytest.fixture
def folder(done, tmp_path):
    """A copy of it, of the same dates."""
    shutil.copytree(done, tmp_path / "folder")
    return tmp_path / "folder"


def planned(folder):
    """Exit status of a dry run, and what it says."""
    return dry_run(folder, os.environ)


def snakemake(folder, *words):
    done = subprocess.run(
        [sys.executable, "-m", "snakemake", "--cores", "1", *words],
        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
    )  # fmt: skip
    return done.returncode, done.stdout


@pytest.mark.parametrize("how", ["no UTF-8", "cut"])
def test_an_edit_is_seen_whatever_became_of_the_records(folder, how):
    records = sorted(p for p in (folder / ".snakemake/metadata").rglob("*") if p.is_file())
    assert len(records) == 2
    for path in records:
        content = bytearray(path.read_bytes())
        content[len(content) // 2] |= 0x80
        path.write_bytes(content[: len(content) // 2] if how == "cut" else content)
    source = folder / "config/a.yaml"
    source.write_text("other")
    os.utime(source, (time.time() - DAY, time.time() - DAY))  # so that its record alone tells of it
    assert "a run repairs it" in planned(folder)[1]
    status, said = snakemake(folder)
    assert status == 0, said
    assert "damaged; the files of its job are made again" in said
    assert (folder / "results/paper/a.nc").read_text() == "other"
    assert "Nothing to be done" in planned(folder)[1]


def test_inputs_and_results_of_tomorrow_stop_no_run(folder):
    for path in [*folder.glob("config/*"), *folder.glob("chapters/*"), folder / "results/paper/b.nc"]:
        os.utime(path, (time.time() + DAY, time.time() + DAY))
    (folder / "results/paper/a.nc").unlink()
    status, said = snakemake(folder)
    assert status == 0, said
    assert "config/a.yaml is dated in the future; its date is set to today" in said
    assert (folder / "results/paper/a.nc").read_text() == "config/a.yaml"
    assert "Nothing to be done" in planned(folder)[1]


def test_a_dry_run_dates_nothing(folder):
    when = time.time() + DAY
    os.utime(folder / "config/a.yaml", (when, when))
    assert planned(folder)[0] == 0
    assert (folder / "config/a.yaml").stat().st_mtime == pytest.approx(when, abs=1e-3)
