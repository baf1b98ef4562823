"""What a run of the study says of itself, from what Snakemake reports and from the logs of its jobs."""

import re
from pathlib import Path

import pytest

from riserstudy.jobs.progress import COUNTED, Progress, lasting
from riserstudy.jobs.step_times import StepName, first_times

ONE, TWO = StepName.of_study("paper/one"), StepName.of_study("paper/two")
FIGURE = StepName.of("figure", {"paper": "paper", "figure": "fig01"})
PLANNED = {"simulate": 2, "figure": 1, "total": 3}


def begin(progress, job, name):
    """Begin a step with words and log as in the rules of the workflow."""
    of = dict(name.wildcards)
    if name.rule == "figure":
        words, log = f"draw {of['paper']}/{of['figure']}", f"logs/paper/draw_{of['figure']}.log"
    else:
        part = f"{of['shard']} of {of['shards']}" if "shard" in of else ""
        words = f"simulate {name.study}" + (f", part {part}" if part else "")
        log = f"logs/{name.study}{'.' + part.replace(' ', '-') if part else ''}.log"
    progress.begin(job, name, words, Path(log))


class Clock:
    now = 100.0

    def __call__(self):
        return self.now


@pytest.fixture
def run(tmp_path, monkeypatch):
    """A run, what is fed to it, and its clock."""
    monkeypatch.chdir(tmp_path)

    def new(tier="preview"):
        progress = Progress(tier, tmp_path / "steps.json", clock, tmp_path / "points.json")
        progress.plan(PLANNED)
        progress.cores = 2
        return progress

    clock = Clock()
    return new, clock


def test_steps_points_and_cores_are_told(run):
    new, clock = run
    progress = new()
    begin(progress, 3, ONE)
    begin(progress, 4, FIGURE)
    clock.now += 5.0
    said = progress.text()
    assert re.match(r"\d+ %, no step done, 5 s, about ", said)
    assert said.endswith(" left on 2 cores: simulate paper/one, draw paper/fig01")
    log = Path("logs/paper/one.log")
    log.parent.mkdir(parents=True)
    log.write_text("1 of 40 points\n12 of 40 points\n")
    assert "simulate paper/one (12 of 40 points)" in progress.text()
    progress.end(3)
    progress.steps = "1 of 3 steps"
    assert re.match(r"\d+ %, 1 of 3 steps done, 5 s, about ", progress.text())


def test_a_part_of_a_study_has_a_log_of_its_own(run):
    new, _ = run
    progress = new()
    begin(progress, 3, StepName.of_study("paper/one", 2, 4))
    log = Path("logs/paper/one.2-of-4.log")
    log.parent.mkdir(parents=True)
    log.write_text("3 of 10 points\n")
    assert "part 2 of 4 (3 of 10 points)" in progress.text()


def test_time_left_is_that_of_the_last_run(run):
    new, clock = run
    first = new()
    for job, name, seconds in ((1, ONE, 60.0), (2, TWO, 20.0), (3, FIGURE, 4.0)):
        begin(first, job, name)
        clock.now += seconds
        first.end(job)
    assert first.seconds_left() is None  # nothing is left
    first.remember()

    second = new()  # one after the other, as the first: on two cores, of which one may have been idle
    assert second.seconds_left() == pytest.approx(60.0 + 20.0 + 4.0)
    begin(second, 7, ONE)
    clock.now += 15.0
    assert second.seconds_left() == pytest.approx(45.0 + 20.0 + 4.0)
    clock.now += 500.0  # slower than it was: no less than nothing of it is left
    assert second.seconds_left() == pytest.approx(20.0 + 4.0)
    second.end(7)  # so much slower tells nothing of the others
    assert second.seconds_left() == pytest.approx(20.0 + 4.0)
    assert "about 24 s left" in second.text()


@pytest.mark.parametrize("rule, word", [("everything", "about"), ("a_rule_of_mine", "at least")])
def test_a_rule_of_a_user_leaves_the_time_of_all_others(run, rule, word):
    new, _ = run
    progress, alone = new(), new()
    alone.plan({"sea_states": 24, "hours": 1})
    progress.plan({"sea_states": 24, "hours": 1, rule: 1})
    assert progress.seconds_left() == pytest.approx(alone.seconds_left())
    assert progress.seconds_left() > 60.0
    assert f", {word} " in progress.text()


@pytest.mark.parametrize("share, seconds", [(0.25, 30.0), (0.5, 10.0), (0.9, 200.0)])
def test_time_left_of_a_step_at_work_follows_its_own_points(run, share, seconds):
    """Half of the points in 10 s leave 10 s for the others; other steps are as much slower or quicker."""
    new, clock = run
    first = new()
    for job, name in ((1, ONE), (2, TWO), (3, FIGURE)):
        begin(first, job, name)
        clock.now += 60.0
        first.end(job)
    first.remember()
    second = new()
    begin(second, 7, ONE)
    clock.now += seconds
    log = Path("logs/paper/one.log")
    log.parent.mkdir(parents=True)
    log.write_text(f"{round(1000 * share)} of 1000 points\n")
    own = seconds * (1.0 - share) / share
    pace = (COUNTED + 2.0 * seconds) / (COUNTED + 2.0 * 60.0 * share)
    pace = pace if 0.25 < seconds / (60.0 * share) < 4.0 else 1.0
    assert second.seconds_left() == pytest.approx(own + (60.0 + 60.0) * pace)


def test_per_cent_grows_to_a_hundred_only_with_nothing_left(run):
    new, clock = run
    progress = new()
    shares = []
    for _ in range(50):
        clock.now += 40.0
        shares.append(progress.percent(max(0.0, 1000.0 - 25.0 * len(shares))))
    assert shares == sorted(shares)
    assert shares[-1] == 99


def test_a_log_has_a_new_line_only_for_a_change(run):
    new, clock = run
    progress = new()
    begin(progress, 3, ONE)
    before = progress.state()
    assert progress.state() == before
    begin(progress, 4, FIGURE)
    assert progress.state() != before


def test_a_first_run_takes_the_times_that_come_with_the_project(run, tmp_path):
    new, clock = run
    (tmp_path / "points.json").write_text('{"paper/one": [1000, 1], "paper/two": [10, 1]}')
    progress = new()
    of = progress.first
    whole = 2 * of.a_step["simulate"] + 1010 * of.a_point["simulate"] + of.a_step["figure"]
    assert progress.seconds_left() == pytest.approx(whole / 2)
    begin(progress, 3, ONE)
    clock.now += 40.0
    progress.end(3)
    small = of.a_step["simulate"] + 10 * of.a_point["simulate"] + of.a_step["figure"]
    assert "about" in progress.text()
    # what this run had of a rule is in its memory only once it has ended
    assert progress.seconds_left() == pytest.approx(small / 2)


def test_every_rule_has_a_time_for_a_first_run():
    rules = (Path(__file__).parents[2] / "workflow").glob("rules/*.smk")
    named = {name for file in rules for name in re.findall(r"^rule (\w+):", file.read_text(), re.M)}
    assert named - {"figures"} <= first_times().a_step.keys()


def test_a_tier_that_never_ran_is_told_by_points_from_another(run, tmp_path):
    new, clock = run
    planned = tmp_path / "points.json"
    planned.write_text('{"paper/one": [4, 1], "paper/two": [2, 1]}')
    preview = new()
    for job, name, seconds in ((1, ONE, 8.0), (2, TWO, 2.0), (3, FIGURE, 5.0)):
        begin(preview, job, name)
        clock.now += seconds
        preview.end(job)
    preview.remember()

    # ten times the points, and as many
    planned.write_text('{"paper/one": [40, 1], "paper/two": [2, 1]}')
    standard = new("standard")
    fixed = standard.first.a_step["simulate"]  # which other points do not change
    whole = fixed + (2.0 * 8.0 - fixed) * 10 + 2.0 * (2.0 + 5.0)
    assert standard.seconds_left() == pytest.approx(whole / 2)
    begin(standard, 7, StepName.of_study("paper/one", 1, 4))
    clock.now += 3.0
    assert standard.seconds_left() == pytest.approx(whole / 2)  # a part is not known


BEFORE = '{"preview": {"simulate paper/one": ["simulate", 60.0, 1.0], "abcd": "abcd"}}'  # by messages
ENDLESS = '{"preview": [["simulate", {"paper": "paper", "study": "one"}, 60.0, 0]]}'  # seconds of no point


@pytest.mark.parametrize("damaged", ["{ broken", "[]", '{"preview": [["simulate", 3]]}', BEFORE, ENDLESS])
def test_a_damaged_memory_is_none(run, tmp_path, damaged):
    new, _ = run
    (tmp_path / "steps.json").write_text(damaged)
    assert new().seconds_left() > 0.0  # as in a first run
    progress = new()
    begin(progress, 3, ONE)
    progress.end(3)
    progress.remember()
    assert set(new().before) == {"preview"}
    assert set(new().before["preview"]) == {ONE}


def test_a_memory_that_cannot_be_written_ends_no_run(run, tmp_path):
    _, clock = run
    (tmp_path / "steps").write_text("a file, not a folder")
    progress = Progress("preview", tmp_path / "steps/steps.json", clock, tmp_path / "points.json")
    begin(progress, 3, ONE)
    progress.end(3)
    progress.remember()
    assert not (tmp_path / "steps/steps.json").exists()


def test_a_failed_step_is_no_longer_at_work(run):
    new, _ = run
    progress = new()
    begin(progress, 3, ONE)
    progress.fail(3)
    assert "simulate" not in progress.text()


def test_times_are_told_in_words():
    assert [lasting(s) for s in (3.4, 89.0, 120.0, 1500.0)] == ["3 s", "89 s", "2 min", "25 min"]
