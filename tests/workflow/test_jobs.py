"""Jobs as forks of a process that has everything loaded."""

import os
import select
import socket
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from riserstudy.jobs import CORES, SHARED
from riserstudy.jobs.tasks import processes

pytestmark = pytest.mark.long

JOBS = (sys.executable, "-m", "riserstudy.jobs")
JOIN = (*JOBS, "join_tables")


def listen(folder):
    """A socket where jobs are asked for."""
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(str(folder / ".jobs"))
    listener.listen()
    return listener


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    """A server at work in a folder of its own."""
    folder = tmp_path_factory.mktemp("jobs")
    with listen(folder) as listener:
        number = listener.fileno()
        command = [*JOBS[:2], "riserstudy.jobs.server", str(number)]
        pipe = subprocess.PIPE
        process = subprocess.Popen(command, cwd=folder, stdin=pipe, pass_fds=[number])
    yield process
    process.communicate(timeout=20)


@pytest.fixture
def folder(server):
    """The server's folder, with nothing in it."""
    folder = Path(psutil.Process(server.pid).cwd())
    for path in folder.glob("[!.]*"):
        path.unlink()
    return folder


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
    return subprocess.Popen(command, cwd=folder, env=environ, text=True, stderr=subprocess.PIPE, **options)


def waiting_job(server, folder):
    """A job that waits for its source to be written, and its process."""
    os.mkfifo(folder / "source")
    earlier = set(psutil.Process(server.pid).children())  # jobs that have told their end, not yet ended
    asker = ask(folder, *JOIN, "joined", "source")
    until(lambda: set(psutil.Process(server.pid).children()) - earlier)
    [job] = set(psutil.Process(server.pid).children()) - earlier
    until(lambda: job.num_threads() > 1)  # from then on the asker knows that the job is taken
    return asker, job


def test_a_fork_of_the_server_does_the_job(server, folder):
    asker, job = waiting_job(server, folder)
    assert asker.poll() is None
    (folder / "source").write_text("a,b\n1,2\n")
    assert asker.wait(20) == 0
    assert (folder / "joined").read_text() == "a,b\n1,2\n"
    until(lambda: not job.is_running())


def test_what_a_job_says_and_its_exit_status_reach_the_asker(folder):
    (folder / "one").write_text("a,b\n")
    (folder / "other").write_text("a,c\n")
    with ask(folder, *JOIN, "joined", "one", "other") as asker:
        text = asker.stderr.read()
    assert text.startswith("riserstudy: joined: the tables to join have different columns;")
    assert asker.returncode == 2
    with ask(folder, *JOIN, "joined", "missing") as asker:
        text = asker.stderr.read()
    assert text.startswith("riserstudy: missing: No such file")
    assert asker.returncode == 2
    (folder / "latin").write_bytes(b"\xff")
    with ask(folder, *JOIN, "joined", "latin") as asker:
        assert "UnicodeDecodeError" in asker.stderr.read()  # nobody foresaw it: a traceback
    assert asker.returncode == 1
    with ask(folder, *JOIN) as asker:
        assert asker.stderr.read().startswith("riserstudy: job: Missing argument")
    assert asker.returncode == 2


def test_a_killed_job_is_told(server, folder):
    asker, job = waiting_job(server, folder)
    job.kill()
    assert asker.wait(20) == 1
    assert "was killed" in asker.stderr.read()


def test_a_job_ends_with_its_asker(server, folder):
    asker, job = waiting_job(server, folder)
    asker.kill()
    until(lambda: not job.is_running())


def test_the_jobs_of_a_killed_snakemake_end(folder, tmp_path):
    """The server's input ends with the one that holds it."""
    os.mkfifo(tmp_path / "source")
    with listen(tmp_path) as listener:
        number = listener.fileno()
        command = [*JOBS[:2], "riserstudy.jobs.server", str(number)]
        process = subprocess.Popen(command, cwd=tmp_path, stdin=subprocess.PIPE, pass_fds=[number])
    asker = ask(tmp_path, *JOIN, "joined", "source")
    until(psutil.Process(process.pid).children)
    job = psutil.Process(process.pid).children()[0]
    until(lambda: job.num_threads() > 1)
    process.stdin.close()
    assert process.wait(20) == 0
    until(lambda: not job.is_running())
    assert asker.wait(20) == 1


def test_a_job_without_a_server_runs_by_itself(tmp_path):
    (tmp_path / "one").write_text("a,b\n1,2\n")
    (tmp_path / ".jobs").write_text("left behind")
    with ask(tmp_path, *JOIN, "joined", "one") as asker:
        assert asker.stderr.read() == ""
    assert asker.returncode == 0
    assert (tmp_path / "joined").exists()


def test_a_job_that_no_server_took_runs_by_itself(tmp_path):
    (tmp_path / "one").write_text("a,b\n1,2\n")
    listener = listen(tmp_path)
    with ask(tmp_path, *JOIN, "joined", "one") as asker:
        until(lambda: select.select([listener], [], [], 0)[0])
        listener.close()  # as when the server is killed
        assert asker.stderr.read() == ""
    assert asker.returncode == 0
    assert (tmp_path / "joined").exists()


@pytest.mark.parametrize("cores", range(1, 70))
def test_jobs_side_by_side_leave_no_core_idle_and_use_no_more_than_there_are(cores, monkeypatch):
    """Each claims half of what it uses: two of the largest fill the cores, one alone uses all it can."""
    monkeypatch.setenv(CORES, str(cores))
    for worth in range(1, 9):
        claimed = min(max(1, worth // SHARED), cores)  # as the rules have it
        used = processes(claimed, worth)
        assert claimed <= used <= min(worth, cores)
        assert used == min(worth, cores) or worth % SHARED
    monkeypatch.delenv(CORES)
    assert processes(3, 8) == 3  # on a node of a cluster, which counts what it gave
