"""Jobs as forks of a process that has everything loaded."""

import os
import subprocess
import sys
import time

import psutil
import pytest

JOBS = (sys.executable, "-m", "riserstudy.jobs")
JOIN = (*JOBS, "join_tables")


@pytest.fixture
def server(tmp_path):
    """A server at work in a folder of its own."""
    command = [*JOBS[:2], "riserstudy.jobs.server", ".jobs", "not compiled"]
    with subprocess.Popen(command, cwd=tmp_path, stdin=subprocess.PIPE) as process:
        until(lambda: (tmp_path / ".jobs").exists())
        yield process
        process.stdin.close()
        process.wait(20)
        assert not (tmp_path / ".jobs").exists()


def until(happened):
    """Wait for something that is about to happen."""
    for _ in range(600):
        if happened():
            return
        time.sleep(0.05)
    raise AssertionError


def ask(folder, *command, **options):
    """Start a job that a server there would do."""
    environ = os.environ | {"RISERSTUDY_JOBS": ".jobs"}
    return subprocess.Popen(
        command, cwd=folder, env=environ, text=True, stderr=subprocess.PIPE, **options
    )


def waiting_job(server, folder):
    """A job that waits for its source to be written, and its process."""
    os.mkfifo(folder / "source")
    asker = ask(folder, *JOIN, "joined", "source")
    until(psutil.Process(server.pid).children)
    return asker, psutil.Process(server.pid).children()[0]


def test_a_fork_of_the_server_does_the_job(server, tmp_path):
    asker, job = waiting_job(server, tmp_path)
    assert asker.poll() is None
    (tmp_path / "source").write_text("a,b\n1,2\n")
    assert asker.wait(20) == 0
    assert (tmp_path / "joined").read_text() == "a,b\n1,2\n"
    until(lambda: not job.is_running())


def test_what_a_job_says_and_its_exit_status_reach_the_asker(server, tmp_path):
    (tmp_path / "one").write_text("a,b\n")
    (tmp_path / "other").write_text("a,c\n")
    with ask(tmp_path, *JOIN, "joined", "one", "other") as asker:
        assert asker.stderr.read() == "joined: tables with different columns cannot be joined\n"
    assert asker.returncode == 1
    with ask(tmp_path, *JOIN, "joined", "missing") as asker:
        assert "FileNotFoundError" in asker.stderr.read()
    assert asker.returncode == 1
    with ask(tmp_path, *JOIN) as asker:
        assert "usage: " in asker.stderr.read()
    assert asker.returncode == 2


def test_a_killed_job_is_told(server, tmp_path):
    asker, job = waiting_job(server, tmp_path)
    job.kill()
    assert asker.wait(20) == 1
    assert "was killed" in asker.stderr.read()


def test_a_job_ends_with_its_asker(server, tmp_path):
    asker, job = waiting_job(server, tmp_path)
    asker.kill()
    until(lambda: not job.is_running())


def test_a_job_without_a_server_runs_by_itself(tmp_path):
    (tmp_path / "one").write_text("a,b\n1,2\n")
    (tmp_path / ".jobs").write_text("left behind")
    with ask(tmp_path, *JOIN, "joined", "one") as asker:
        assert asker.stderr.read() == ""
    assert asker.returncode == 0
    assert (tmp_path / "joined").exists()
