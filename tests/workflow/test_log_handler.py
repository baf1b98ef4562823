"""What Snakemake prints through the plugin: how far a run is, what failed, and nothing else."""

import logging
import subprocess
import sys
import threading
import time
from types import SimpleNamespace

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

from riserstudy.jobs import log_handler
from riserstudy.jobs.log_handler import LogHandler, LogHandlerSettings
from riserstudy.jobs.step_times import StepName


@pytest.fixture
def handler(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    made = LogHandler(SimpleNamespace(dryrun=False), LogHandlerSettings(tier="preview"))
    yield made
    made.close()


def record(event=None, message=None, level=logging.INFO, **facts):
    made = logging.LogRecord("snakemake", level, __file__, 1, message, None, None)
    made.__dict__ |= facts | ({"event": event} if event else {})
    return made


STUDY = {"paper": "paper", "study": "one"}


def begin(handler, job, rule, message, wildcards=None, log=()):
    about = {"jobid": job, "rule_name": rule, "rule_msg": message, "wildcards": wildcards, "log": [*log]}
    handler.emit(record(LogEvent.JOB_INFO, **about))


def test_steps_are_counted_and_their_times_remembered(handler, capsys):
    handler.emit(record(LogEvent.RESOURCES_INFO, cores=3))
    handler.emit(record(LogEvent.RUN_INFO, stats={"simulate": 1, "all": 1, "total": 2}))
    begin(handler, 4, "simulate", "simulate paper/one", STUDY)
    handler.emit(record(LogEvent.JOB_FINISHED, job_id=4))
    begin(handler, 0, "all", None)
    handler.emit(record(LogEvent.JOB_FINISHED, job_id=0))
    handler.emit(record(LogEvent.PROGRESS, done=2, total=2))
    handler.close()
    out, error = capsys.readouterr()
    assert out.startswith("2 of 2 steps done, ")
    assert out.endswith(" on 3 cores\n")
    assert not error
    again = LogHandler(SimpleNamespace(dryrun=False), LogHandlerSettings(tier="preview"))
    assert set(again._progress.before["preview"]) == {StepName.of("simulate", STUDY), StepName("all")}


def test_a_rule_of_a_user_with_the_words_of_a_study_is_none(handler, tmp_path):
    """A step is known by rule and wildcards, and its points by its log, whatever its message and paths."""
    (tmp_path / "mine.log").write_text("12 of 40 points\n")
    begin(handler, 4, "mine", "simulate paper/one, part 2 of 4", {"what": "one"}, ["mine.log"])
    begin(handler, 5, "simulate", "Run “one”: 3 of 4 points", STUDY, ["mine.log"])
    begin(handler, 6, "silent", None)
    at_work = "simulate paper/one, part 2 of 4, Run “one”: 3 of 4 points (12 of 40 points), silent"
    assert handler._progress.text().endswith(f": {at_work}")


def test_a_log_gets_a_line_only_for_a_change(handler, capsys, monkeypatch):
    monkeypatch.setattr(log_handler, "IN_LOG", 0.02)
    monkeypatch.setattr(handler._progress, "clock", lambda: 0.0)  # in which no time passes
    handler.emit(record(LogEvent.RUN_INFO, stats={"simulate": 1, "total": 1}))
    begin(handler, 4, "simulate", "simulate paper/one")
    out, deadline = "", time.monotonic() + 30.0  # on a machine that is busy
    while "simulate paper/one" not in out and time.monotonic() < deadline:
        time.sleep(0.05)
        out += capsys.readouterr().out
    time.sleep(0.3)
    out += capsys.readouterr().out
    assert out.count("simulate paper/one") == 1


def test_steps_that_begin_and_end_while_progress_is_shown_do_not_end_its_display(handler, monkeypatch):
    """Snakemake reports steps in one thread, while another one reads logs, which takes time, and prints."""
    monkeypatch.setattr(log_handler, "IN_LOG", 1e-3)
    monkeypatch.setattr("riserstudy.jobs.progress.last_points", lambda log: time.sleep(2e-4))
    failed = []
    monkeypatch.setattr(threading, "excepthook", failed.append)
    handler.emit(record(LogEvent.RUN_INFO, stats={"simulate": 60, "total": 60}))
    for job in range(60):
        study = {"paper": "paper", "study": str(job)}
        begin(handler, job, "simulate", f"simulate paper/{job}", study, ["one.log"])
        time.sleep(2e-3)
        if job >= 4:
            handler.emit(record(LogEvent.JOB_FINISHED, job_id=job - 4))
    assert not failed
    assert handler._showing.is_alive()
    assert len(handler._progress.took) == 60 - 4
    spent = sum(of.seconds for of in handler._progress.took.values())
    at_work = sum(step.seconds for step in handler._progress.at_work.values())
    assert spent + at_work <= handler._progress.clock() - handler._progress.began  # no time counts twice


def test_a_failed_step_is_named_with_its_log_and_what_follows_from_it_is_not(handler, tmp_path, capsys):
    (tmp_path / "one.log").write_text("\n".join(f"line {k}" for k in range(100)))
    begin(handler, 4, "simulate", "simulate paper/one")
    about = {"rule_name": "simulate", "jobid": 4, "output": ["results/one.nc"], "log": ["one.log"]}
    handler.emit(record(LogEvent.JOB_ERROR, level=logging.ERROR, **about))
    follows = "WorkflowError: at least one job failed"
    handler.emit(record(LogEvent.ERROR, follows, logging.ERROR, exception="WorkflowError"))
    handler.emit(record(message="Exiting because a job execution failed", level=logging.ERROR))
    handler.emit(record(message="Complete log(s): here.log", level=logging.WARNING))
    out, error = capsys.readouterr()
    lines = error.splitlines()
    assert lines[:2] == ["riserstudy: simulate failed to make results/one.nc", "one.log ends:"]
    assert lines[-1] == "Complete log(s): here.log"
    assert lines[-2] == "    line 99"
    assert len(lines) == 2 + log_handler.LOG_TAIL + 1
    assert not out


def test_the_command_of_a_failed_step_is_not_printed_and_snakemake_is_not_said_to_have_stopped(
    handler, capsys
):
    """Snakemake first reports an exception with the whole command, then the failed step, and goes on."""
    begin(handler, 4, "simulate", "simulate paper/one", STUDY)
    begin(handler, 5, "simulate", "simulate paper/two", STUDY)
    error = "RuleException:\nCalledProcessError: Command 'set -euo pipefail; python' returned 1"
    handler.emit(record(LogEvent.ERROR, error, logging.ERROR, exception="RuleException"))
    about = {"rule_name": "simulate", "jobid": 4, "output": ["results/one.nc"], "log": []}
    handler.emit(record(LogEvent.JOB_ERROR, level=logging.ERROR, **about))
    handler.close()
    assert capsys.readouterr().err == "riserstudy: simulate failed to make results/one.nc\n"


def test_an_error_without_a_failed_step_is_printed_at_the_end(handler, capsys):
    begin(handler, 4, "simulate", "simulate paper/one", STUDY)
    handler.emit(record(LogEvent.ERROR, "WorkflowError: no space", logging.ERROR, exception="WorkflowError"))
    handler.close()
    assert capsys.readouterr().err == "riserstudy: snakemake stopped:\nWorkflowError: no space\n"


def test_why_nothing_could_begin_is_printed(handler, capsys):
    handler.emit(record(LogEvent.ERROR, "MissingRuleException: no rule", logging.ERROR))
    assert capsys.readouterr().err.splitlines() == [
        "riserstudy: snakemake stopped:",
        "MissingRuleException: no rule",
    ]


def test_a_dry_run_is_left_to_snakemake(capsys):
    handler = LogHandler(SimpleNamespace(dryrun=True), LogHandlerSettings())
    assert not handler.writes_to_stream
    handler.emit(record(LogEvent.ERROR, "no rule", logging.ERROR))
    handler.emit(record(LogEvent.RUN_INFO, stats={"simulate": 1}))
    assert capsys.readouterr() == ("", "")


@pytest.mark.long
def test_a_plain_snakemake_finds_it_by_its_name(tmp_path):
    (tmp_path / "Snakefile").write_text(
        "rule all:\n    input: 'a'\nrule one:\n    output: 'a'\n    message: 'make a'\n    shell: 'touch a'\n"
    )
    command = [sys.executable, "-m", "snakemake", "-c1", "--logger", "riserstudy"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1].startswith("2 of 2 steps done, ")
    assert not done.stderr
    again = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert again.stdout == "Nothing to do: every result is up to date.\n"


def test_another_try_of_a_failed_step_is_announced(handler, capsys):
    about = {"rule_name": "simulate", "jobid": 4, "output": ["results/one.nc"], "log": []}
    handler.emit(record(LogEvent.JOB_ERROR, level=logging.ERROR, **about))
    handler.emit(record(message="Trying to restart job 4."))
    lines = capsys.readouterr().err.splitlines()
    assert lines == [
        "riserstudy: simulate failed to make results/one.nc",
        "riserstudy: the failed step starts again",
    ]
