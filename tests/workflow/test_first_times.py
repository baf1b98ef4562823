"""The times that come with the project are those of a run of the standard tier."""

import shutil

import pytest

from first_times import main
from riserstudy.jobs.progress import Progress
from riserstudy.jobs.step_times import FIRST, StepName, first_times

STEPS = {
    StepName.of("compile", {"group": "plane"}): 12.0,
    StepName.of("simulate", {"paper": "a", "study": "b-c, part 2 of 4"}): 3.0,
    StepName.of("figure", {"paper": "a", "figure": "one"}): 1.0,
    StepName.of("figure", {"paper": "a", "figure": "two"}): 2.0,
}


def run_of(tier, memory):
    """A run of these steps, which are remembered."""
    now = 0.0
    progress = Progress(tier, memory, lambda: now)
    for job, (name, seconds) in enumerate(STEPS.items()):
        progress.begin(job, name)
        now += seconds
        progress.end(job)
    progress.remember()


def test_times_of_a_run_become_those_of_the_project(tmp_path):
    memory, target = tmp_path / "steps.json", tmp_path / "first.json"
    shutil.copyfile(FIRST, target)
    run_of("standard", memory)
    main(memory, target)
    found, before = first_times(target), first_times()
    of_figures = {name for name in STEPS if name.rule == "figure"}
    assert {name: of.seconds for name, of in found.steps.items()} == {
        name: seconds for name, seconds in STEPS.items() if name not in of_figures
    }
    assert found.a_step == before.a_step | {"figure": 1.5}
    assert found.a_point == before.a_point


@pytest.mark.parametrize("tier", ["preview", None])
def test_without_a_run_of_the_standard_tier_there_are_no_times(tmp_path, tier):
    memory, target = tmp_path / "steps.json", tmp_path / "first.json"
    if tier:
        run_of(tier, memory)
    with pytest.raises(SystemExit, match="no times of the tier standard"):
        main(memory, target)
    assert not target.exists()
