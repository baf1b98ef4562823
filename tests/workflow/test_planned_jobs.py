"""A job does what the workflow planned, or nothing."""

import random
import sys
from pathlib import Path

import pytest
import xarray as xr
from edits import forget_sources

from riserstudy.jobs.tasks import run
from riserstudy.jobs.workplan import Workplan
from riserstudy.study.new import new_study

CHANGED = "changed while the workflow was running"
#: what each job writes, its arguments, and a file whose edit counts
JOBS = {
    "derive": ("tension_swing.nc", "chapters/example/derived.py"),
    "draw": ("swing_over_heave.png", "chapters/example/figures.py"),
    "grade": ("reproduction.csv", "chapters/example/claims.py"),
    "printed": ("reproduction.csv", "config/published/example.yaml"),
    "words": ("reproduction.csv", "config/published/words.yaml"),
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder of a study with invented runs: a swing that grows by a power of heave."""
    here = tmp_path / "Studie ä"
    new_study(here)
    monkeypatch.chdir(here)
    monkeypatch.syspath_prepend(here)
    (here / "results/example").mkdir(parents=True)
    heave = xr.Dataset(
        {
            "effective_tension_max": (("heave_amplitude", "s_node"), [[0.0, 1e3], [0.0, 9e3]]),
            "effective_tension_min": (("heave_amplitude", "s_node"), [[0.0, -1e3], [0.0, -9e3]]),
        },
        {"heave_amplitude": ("heave_amplitude", [1.0, 3.0]), "s_node": [0.0, 9.0]},
    )
    heave.to_netcdf(here / "results/example/heave.nc")
    words = "no_difference: 2 %\nbecause: curves touch\nwords: {}\n"
    (here / "config/published/words.yaml").write_text(words)
    yield here
    forget_sources()


def planned(kind):
    """The command of a job, as the rules of the workflow write it."""
    forget_sources()
    plan, results = Workplan.read(Path("config"), {}), "results/example"
    if kind == "derive":
        settings = plan.derived_settings("example", "tension_swing")
        digest = plan.derived_digest("example", "tension_swing")
        words = ["tension_swing", f"{results}/tension_swing.nc", f"{results}/heave.nc"]
        return ["derive", "example", *words, "--settings", settings, "--expect", digest]
    if kind == "draw":
        files = [f"{results}/swing_over_heave.{end}" for end in ("png", "pdf", "csv")]
        digest = plan.figure_digest("example", "swing_over_heave")
        source = f"{results}/tension_swing.nc"
        return ["draw", "example", "swing_over_heave", *files, source, "--expect", digest]
    tables = [f"{results}/{name}.csv" for name in ("reproduction", "errata", "margins", "false_claims")]
    source, digest = f"{results}/tension_swing.nc", plan.grade_digest("example")
    return ["grade", "example", *tables, source, "--expect", digest]


def exit_status(command):
    """That of a job, which reads everything anew."""
    forget_sources()
    for name in [name for name in sys.modules if name.startswith("chapters.example")]:
        del sys.modules[name]
    return run(command)


@pytest.mark.long
@pytest.mark.parametrize("kind", JOBS)
def test_a_job_whose_code_was_edited_after_planning_writes_nothing(kind, folder, capsys):
    target, edited = JOBS[kind]
    if kind != "derive":
        assert exit_status(planned("derive")) == 0
    command, file = planned(kind), folder / edited
    as_planned, draw = file.read_text(), random.Random(kind)
    text = f"{draw.choice('abc')}_{draw.randrange(10**6)} = {draw.random()}\n"
    more = text if file.suffix == ".py" else f"# {text}"
    file.write_text(as_planned + more)
    assert exit_status(command) == 3
    assert CHANGED in capsys.readouterr().err
    assert not (folder / "results/example" / target).exists()
    file.write_text(as_planned)
    assert exit_status(command) == 0
    assert (folder / "results/example" / target).exists()


def test_an_older_study_file_in_the_place_of_a_newer_one_makes_the_database_stale(folder):
    """As ``mv backup.yaml example.yaml`` does, which keeps its date."""
    study = folder / "config/studies/example.yaml"
    text, found = study.read_text(), set()
    for caption in ("one", "two"):
        study.write_text(text.replace("heave of several amplitudes", caption))
        forget_sources()
        found.add(Workplan.read(Path("config"), {}).database_digest)
    assert len(found) == 2
