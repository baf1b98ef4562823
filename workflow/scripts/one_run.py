"""Allow one run of the study at a time, also after a run that was killed.

A lock excludes a second run; the system releases it when its holder ends. Every process of a run has the
run's name in its environment. Processes that a killed run left behind can thus be found and ended before the
next run starts. Stored points are complete or absent: ending a job at any moment loses only its current work.
"""

import contextlib
import fcntl
import os
import signal
import subprocess
import sys
import threading
import time
import uuid
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import NoReturn, TextIO

import psutil

ROOT = Path(__file__).resolve().parents[2]
SNAKEMAKE = (sys.executable, "-m", "snakemake", "--nocolor")
RUN_NAME = "RISERSTUDY_RUN"
LOCK = Path(".cache/study.lock")
WAIT_FOR_LOCK = 3.0  # (s) a run whose `make` was killed ends sooner


class Occupied(Exception):
    """Another run is at work in this folder."""


@contextlib.contextmanager
def one_run() -> Iterator[dict[str, str]]:
    """Lock the folder for a run, and yield the environment of the run's processes.

    Raises
    ------
    Occupied
        When another run, or a snakemake that was started by hand, is at work in this folder.
    """
    LOCK.parent.mkdir(mode=0o700, exist_ok=True)
    with LOCK.open("a+", encoding="utf-8") as lock:
        if not take(lock):
            raise Occupied(f"another run {holder(lock)}is at work here; try again when it has ended.")
        end_processes(former_run(lock))
        if locked() and (pid := foreign_snakemake()):
            raise Occupied(f"a snakemake (pid {pid}) is at work here; try again when it has ended.")
        run = uuid.uuid4().hex
        write(lock, f"{os.getpid()} {run}")
        install_signal_handlers()
        try:
            unlock()
            yield os.environ | {RUN_NAME: mark(run)}
        finally:
            end_processes(run)
            unlock()
            write(lock, "")


def take(lock: TextIO) -> bool:
    """Acquire the lock; wait a moment for a run that is about to end."""
    deadline = time.monotonic() + WAIT_FOR_LOCK
    while True:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return True
        except BlockingIOError:
            if time.monotonic() > deadline:
                return False
            time.sleep(0.1)


def holder(lock: TextIO) -> str:
    """Return the process that holds the lock, if the lock file names it."""
    words = read(lock).split()
    return f"(pid {words[0]}) " if words else ""


def former_run(lock: TextIO) -> str | None:
    """Return the name of a run that did not finish, if there is one."""
    words = read(lock).split()
    return words[1] if len(words) == 2 else None


def read(lock: TextIO) -> str:
    """Return the text of the lock file."""
    lock.seek(0)
    return lock.read()


def write(lock: TextIO, text: str) -> None:
    """Replace the text of the lock file."""
    lock.seek(0)
    lock.truncate()
    lock.write(text)
    lock.flush()


def mark(run: str) -> str:
    """Return the mark of a run's processes; it differs from that of a copy of this folder."""
    return f"{run} in {ROOT}"


def end_processes(run: str | None) -> None:
    """End every process of a run and wait until all are gone."""
    while run is not None and (processes := list(processes_of(run))):
        for process in processes:
            with contextlib.suppress(psutil.NoSuchProcess):
                process.kill()
        psutil.wait_procs(processes, timeout=10)


def processes_of(run: str) -> Iterator[psutil.Process]:
    """Yield the living processes that have a run's name."""
    for process in psutil.process_iter(["environ", "status"]):
        named = (process.info["environ"] or {}).get(RUN_NAME)
        if named == mark(run) and process.info["status"] != psutil.STATUS_ZOMBIE:
            yield process


def foreign_snakemake() -> int | None:
    """Return the process number of a snakemake that was started by hand in this folder."""
    for process in psutil.process_iter(["cmdline", "cwd"]):
        names = [Path(word).name for word in process.info["cmdline"] or ()]
        if process.info["cwd"] == str(ROOT) and "snakemake" in names[1:3]:
            return int(process.pid)
    return None


def install_signal_handlers() -> None:
    """Convert a request to end, and the end of the `make` that started this process, into an interrupt."""

    def interrupt(_signal: int, _frame: FrameType | None) -> NoReturn:
        raise KeyboardInterrupt

    def watch(parent: int) -> None:
        while os.getppid() == parent:
            time.sleep(0.3)
        os.kill(os.getpid(), signal.SIGTERM)

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN or number == signal.SIGTERM:
            signal.signal(number, interrupt)
    if "MAKELEVEL" in os.environ:
        threading.Thread(target=watch, args=(os.getppid(),), daemon=True).start()


def locked() -> bool:
    """Whether Snakemake's own lock is set."""
    return any(Path(".snakemake/locks").glob("*"))


def unlock() -> None:
    """Remove the lock of a Snakemake that was killed; only call it when none is at work."""
    if locked():
        subprocess.run([*SNAKEMAKE, "--unlock"], capture_output=True, check=False)
