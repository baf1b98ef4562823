"""The server: a process with libraries and kernels loaded, from which every job of a run is forked.

Importing them would cost a job 1 to 3 s, often more than its work. The server lives as long as its standard
input is open: it thus ends with the Snakemake that started it, however that ends, and then ends the jobs that
are left. A job lives as long as the process that requested it.
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

# Modules that jobs import at their start or during their work.
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
# which take a second, and which a single figure does not need
WHEN_IDLE = ("riserstudy.study.write_study", "riserstudy.grading.grade")
MANY = 8  # number of jobs from which it pays to load modules that may not be needed


def serve(listener: socket.socket) -> None:
    """Fork a job for every request, until standard input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the jobs and Snakemake handle an interrupt
    signal.signal(signal.SIGCHLD, note_ended)
    load_libraries()
    gc.freeze()  # memory that a fork never changes stays shared
    jobs, waiting, kernels = 0, to_load_when_idle(), kernels_to_load()
    while True:
        waiting += [kernels.pop(marker) for marker in list(kernels) if marker.exists()]
        may_load = waiting and jobs >= MANY
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
                run_job(asker)
    # Jobs of a Snakemake that was killed: the next run does them.
    for job in psutil.Process().children():
        with suppress(psutil.NoSuchProcess):
            job.kill()


def of_this_user(asker: socket.socket) -> bool:
    """Return whether the requesting process belongs to our user, as far as the system tells."""
    if not hasattr(socket, "SO_PEERCRED"):
        return True  # the permissions of the socket must suffice
    size = struct.calcsize("3i")
    _, user, _ = struct.unpack("3i", asker.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, size))
    return bool(user == os.getuid())


def load_libraries() -> None:
    """Import the modules that most jobs need."""
    for module in LOADED:
        import_module(module)
    import xarray as xr

    # with its first dataset xarray imports the array libraries that are installed
    xr.Dataset({"any": ("x", [0.0])})


def note_ended(_signal: int, _frame: FrameType | None) -> None:
    """Wait for jobs that have ended: only then their time counts as time of the server."""
    with suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass


def to_load_when_idle() -> list[Callable[[], object]]:
    """Return functions that load modules, and the digest of their sources, while the server is idle."""
    from riserstudy.files.digests import engine_digest

    return [*(partial(import_module, name) for name in WHEN_IDLE), engine_digest]


def kernels_to_load() -> dict[Path, Callable[[], object]]:
    """Return functions that load groups of kernels, by the marker which means that a group is compiled."""
    from riserstudy.simulation.compile import marker
    from riserstudy.simulation.kernel_groups import GROUPS
    from riserstudy.simulation.warm_up import warm_up

    return {marker(group): partial(warm_up, group) for group in GROUPS}


def load(one: Callable[[], object]) -> None:
    """Load a library or kernels. An error is ignored here: the job that needs them meets and reports it."""
    with suppress(Exception):
        one()
    gc.freeze()


def run_job(asker: socket.socket) -> NoReturn:
    """Become the requested job; send its exit status at the end."""
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
        threading.Thread(target=end_if_abandoned, args=(asker,), daemon=True).start()
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


def end_if_abandoned(asker: socket.socket) -> None:
    """End this job as soon as the requesting process no longer waits for it."""
    if not asker.recv(1):
        os.kill(os.getpid(), signal.SIGKILL)


if __name__ == "__main__":
    serve(socket.socket(fileno=int(sys.argv[1])))  # number of the inherited socket
