"""The one command around Snakemake, on a workflow of three steps."""

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import netCDF4
import psutil
import pytest

pytestmark = pytest.mark.long

SCRIPTS = Path(__file__).parents[2] / "workflow/scripts"
SNAKEFILE = """\
rule all:
    input: "results/paper/a.nc", "results/reproduction.csv"
rule dataset:
    output: "results/paper/a.nc"
    log: "logs/dataset.log"
    shell: "(echo the pipe is gone; sh step.sh; python dataset.py {output:q} {config[tier]}) > {log:q} 2>&1"
rule table:
    input: "results/paper/a.nc"
    output: "results/reproduction.csv"
    shell: "cp table.csv {output:q}"
"""
DATASET = """\
import sys
import netCDF4
with netCDF4.Dataset(sys.argv[1], "w") as dataset:
    dataset.tier = sys.argv[2]
"""
TABLE = """\
paper,id,figure,kind,statement,published,simulated,unit,error,verdict,depends_on,note
paper,N1,,number,,1,1,m,0,reproduced,,
paper,C1,,claim,,,,,,holds,,
paper,C2,,claim,,,,,,not reproducible,,
"""


@pytest.fixture
def folder(tmp_path):
    """A checkout in small; its path has a blank, as paths do."""
    folder = tmp_path / "a checkout"
    shutil.copytree(SCRIPTS, folder / "workflow/scripts")
    (folder / "dataset.py").write_text(DATASET)
    (folder / "Snakefile").write_text(SNAKEFILE)
    (folder / "table.csv").write_text(TABLE)
    (folder / "step.sh").write_text("true\n")
    return folder


def start(folder, *arguments):
    command = [sys.executable, "workflow/scripts/run_study.py", "--cores", "1", *arguments]
    not_the_users = ("MAKELEVEL", "RISERSTUDY_CACHE")
    environment = {name: value for name, value in os.environ.items() if name not in not_the_users}
    return subprocess.Popen(
        command, cwd=folder, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )


def finish(process):
    said, complained = process.communicate(timeout=60)
    return process.returncode, said, complained


def wait_for(found):
    deadline = time.monotonic() + 30
    while not found():
        assert time.monotonic() < deadline
        time.sleep(0.05)


def test_a_run_ends_with_the_verdicts_and_a_second_run_does_nothing(folder):
    status, said, complained = finish(start(folder, "--tier", "preview"))
    assert (status, complained) == (0, "")
    with netCDF4.Dataset(folder / "results/paper/a.nc") as dataset:
        assert dataset.tier == "preview"
    assert "3 of 3 steps" in said
    assert "results/paper/*.nc (1)" in said
    lines = [line.split() for line in said.splitlines()]
    assert ["reproduced", "holds", "not", "reproducible"] in lines
    assert ["paper", "numbers", "1", "-", "-"] in lines
    assert ["paper", "claims", "-", "1", "1"] in lines

    status, said, _ = finish(start(folder, "--tier", "preview"))
    assert status == 0
    assert said.startswith("Nothing to do")


def test_verdicts_are_those_of_the_papers_where_the_joined_table_is_older(folder):
    assert finish(start(folder, "--tier", "preview"))[0] == 0
    graded = folder / "results/paper/reproduction.csv"
    graded.write_text(TABLE.replace("holds", "fails"))
    later = (folder / "results/reproduction.csv").stat().st_mtime + 1.0
    os.utime(graded, (later, later))
    _, said, _ = finish(start(folder, "--tier", "preview"))
    assert "results/reproduction.csv (of an earlier run)" in said
    lines = [line.split() for line in said.splitlines()]
    assert ["reproduced", "fails", "not", "reproducible"] in lines


def test_a_failing_step_is_named_with_the_end_of_its_log(folder):
    (folder / "step.sh").write_text("exit 7\n")
    status, _, complained = finish(start(folder))
    assert status == 1
    assert "dataset failed to make results/paper/a.nc" in complained
    assert "logs/dataset.log ends:\n    the pipe is gone" in complained


def test_a_lock_that_cannot_be_written_is_told_in_one_line(folder):
    (folder / ".cache/study.lock").mkdir(parents=True)
    status, _, complained = finish(start(folder))
    assert (status, complained.count("\n")) == (1, 1)
    assert complained.startswith("riserstudy: .cache/study.lock: ")


@pytest.mark.parametrize("left", [0, 4096, 65536])
def test_a_disk_that_is_full_is_told_in_one_line(folder, left):
    """Snakemake itself ends in a traceback there."""
    script = f"""import runpy, shutil, sys
shutil.disk_usage = lambda path: shutil._ntuple_diskusage(10**9, 10**9 - {left}, {left})
sys.argv = ["workflow/scripts/run_study.py"]
sys.path[0] = "workflow/scripts"
runpy.run_path(sys.argv[0], run_name="__main__")
"""
    ran = subprocess.run([sys.executable, "-c", script], cwd=folder, capture_output=True, text=True)
    assert ran.returncode == 2
    assert ran.stderr == "riserstudy: results: the disk is full; free some space\n"


def test_a_workflow_that_cannot_start_says_why(folder):
    status, _, complained = finish(start(folder, "no_such_target"))
    assert status == 1
    assert "MissingRuleException" in complained
    assert "no_such_target" in complained


def test_a_copy_of_a_checkout_in_use_leaves_the_run_there_alone(folder, tmp_path):
    (folder / "step.sh").write_text("echo $$ > job; while ! test -e go; do sleep 0.1; done\n")
    first = start(folder)
    wait_for((folder / "job").exists)
    copy = tmp_path / "a copy"
    shutil.copytree(folder, copy)
    (copy / "step.sh").write_text("true\n")
    status, _, complained = finish(start(copy))
    assert (status, complained) == (0, "")
    assert first.poll() is None
    (folder / "go").touch()
    assert finish(first)[0] == 0


@pytest.mark.parametrize("victim", ["the run", "all"])
def test_a_second_run_stops_and_a_killed_run_is_resumed(folder, victim):
    (folder / "step.sh").write_text("echo $$ > job; sleep 60\n")
    first = start(folder)
    wait_for((folder / "job").exists)
    status, _, complained = finish(start(folder))
    assert status == 1
    assert f"another run (pid {first.pid}) is at work here" in complained
    assert complained.count("\n") == 1

    left = psutil.Process(first.pid).children(recursive=True)
    for process in left if victim == "all" else []:
        process.kill()
    first.kill()
    first.wait(timeout=60)  # what is left of it still holds its output
    assert any((folder / ".snakemake/locks").iterdir())

    (folder / "step.sh").write_text("true\n")
    status, said, complained = finish(start(folder))
    assert (status, complained) == (0, "")
    assert "3 of 3 steps" in said
    assert not any(process.is_running() for process in left)


def test_a_run_told_to_stop_leaves_nothing_behind(folder):
    (folder / "step.sh").write_text("echo $$ > job; sleep 60\n")
    run = start(folder)
    wait_for((folder / "job").exists)
    left = psutil.Process(run.pid).children(recursive=True)
    run.terminate()
    status, _, complained = finish(run)
    assert status == 130
    assert "stopped" in complained
    assert not any(process.is_running() for process in left)
    assert not list((folder / ".snakemake").glob("locks/*"))


@pytest.mark.parametrize("folder_in_the_way", ["results", "logs", ".cache"])
def test_a_folder_that_cannot_be_written_is_named_before_anything_runs(folder, folder_in_the_way):
    (folder / folder_in_the_way).write_text("a file")
    status, said, complained = finish(start(folder))
    assert (status, said) == (2, "")
    assert complained.startswith(f"riserstudy: {folder_in_the_way}: cannot be written")
    assert complained.count("\n") == 1
    assert not (folder / ".snakemake").exists()
