"""A process with libraries and kernels loaded; every job of a run is a fork of it.

To import them costs a job 1 to 3 s, often more than its work. The server lives as long as its standard
input is open, so it ends with the Snakemake that started it, however that ends, and ends the jobs that
are left; a job lives as long as the process that asked for it.
"""

from __future__ import annotations

import gc
import json
import os
import select
import signal
import socket
import struct
import sys
import threading
import traceback
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from importlib import import_module
from pathlib import Path
from types import FrameType
from typing import NoReturn

import psutil

from riserstudy.jobs import TAKEN

# What jobs import first thing, and in the midst of their work.
LOADED = (
    "matplotlib.backends.backend_agg",
    "matplotlib.backends.backend_pdf",
    "matplotlib.pyplot",
    "netCDF4",
    "xarray",
    "riserstudy.chapters",
    "riserstudy.figures",
    "riserstudy.study.collect",
    "riserstudy.schematic",
    "riserstudy.jobs.tasks",
    "riserstudy.jobs.workplan",
)
LATER = ("riserstudy.grading.grade",)  # takes a second, and a figure alone does without
MANY = 8  # jobs, from which on it pays to load what may not be asked for


def serve(listener: socket.socket, compiled: Path) -> None:
    """Fork a job for everyone who asks, until standard input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # an interrupt is for the jobs and for Snakemake
    signal.signal(signal.SIGCHLD, note_ended)
    load_libraries()
    gc.freeze()  # what a fork never touches stays shared
    jobs, waiting = 0, later()
    while True:
        may_load = waiting and jobs >= MANY and compiled.exists()
        ready, _, _ = select.select([listener, sys.stdin], [], [], 0.0 if may_load else None)
        if not ready:
            load(waiting.pop(0))
            continue
        if sys.stdin in ready:
            break
        asker, _ = listener.accept()
        if not of_this_user(asker):
            asker.close()
            continue
        jobs += 1
        with asker:
            if os.fork() == 0:
                listener.close()
                become_job(asker)
    for (
        job
    ) in psutil.Process().children():  # of a Snakemake that was killed: the next run does them
        with suppress(psutil.NoSuchProcess):
            job.kill()


def of_this_user(asker: socket.socket) -> bool:
    """Whether who asks is the user that this process is of, as far as the system tells."""
    if not hasattr(socket, "SO_PEERCRED"):
        return True  # the socket's own permissions stand
    size = struct.calcsize("3i")
    _, user, _ = struct.unpack("3i", asker.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, size))
    return bool(user == os.getuid())


def load_libraries() -> None:
    """Import what most jobs need."""
    for module in LOADED:
        import_module(module)
    import xarray as xr

    # with its first dataset xarray imports what array libraries there are
    xr.Dataset({"any": ("x", [0.0])})


def note_ended(_signal: int, _frame: FrameType | None) -> None:
    """Take note of jobs that ended: their time counts as the server's."""
    with suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass


def later() -> list[Callable[[], object]]:
    """What is loaded when there is time: modules, and what is compiled together."""
    from riserstudy.simulation.kernel_groups import GROUPS
    from riserstudy.simulation.warm_up import warm_up

    modules = [partial(import_module, name) for name in LATER]
    return [*modules, *(partial(warm_up, group) for group in GROUPS)]


def load(one: Callable[[], object]) -> None:
    """Load a library or kernels; what cannot be loaded fails in the job that needs it, and is told."""
    with suppress(Exception):
        one()
    gc.freeze()


def become_job(asker: socket.socket) -> NoReturn:
    """Become the job that is asked for; tell its exit status."""
    from riserstudy.jobs.tasks import run

    status = 1
    try:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        _, streams, _, _ = socket.recv_fds(asker, 1, 3)
        for number, stream in enumerate(streams):
            os.dup2(stream, number)
            os.close(stream)
        with asker.makefile("rb") as lines:
            request = json.loads(lines.readline())
        asker.sendall(TAKEN)
        threading.Thread(target=end_with, args=(asker,), daemon=True).start()
        os.environ.clear()
        os.environ.update(request["environ"])
        status = run(request["arguments"])
    except BaseException:
        traceback.print_exc()
    with suppress(OSError):
        sys.stdout.flush()
        sys.stderr.flush()
        asker.sendall(str(status).encode())
    os._exit(status)


def end_with(asker: socket.socket) -> None:
    """End this job when nobody waits for it any more."""
    if not asker.recv(1):
        os.kill(os.getpid(), signal.SIGKILL)


if __name__ == "__main__":
    number, marker_file = sys.argv[
        1:
    ]  # of the socket that was passed on; says that kernels are compiled
    serve(socket.socket(fileno=int(number)), Path(marker_file))
