"""What the rules of the workflow run, as ``python -m riserstudy.jobs <name>``: functions of ``tasks``.

They are part of the package, so that a checkout and a folder of one's own run the same.
"""

from __future__ import annotations

import atexit
import os
import socket
import subprocess
import sys
from pathlib import Path

from riserstudy.study.processes import forks

TAKEN = b"+"  # what a job is told by the process that will do it
CORES = "RISERSTUDY_CORES"  # variable with the number of cores that jobs share
SHARED = 2  # processes of a job for each thread that it claims there


def processes(claimed: int, worth: int) -> int:
    """Processes of a job: more than it claims where another, at its beginning or end, leaves cores idle.

    Parameters
    ----------
    claimed : threads that Snakemake counts for it.
    worth : those that it can use.
    """
    cores = int(os.environ.get(CORES, 0))  # of the run, on the machine that jobs share
    return min(worth, SHARED * claimed, cores) if cores else claimed


def use_this_python() -> None:
    """Let what is started from here on find this Python first."""
    others = os.environ.get("PATH", os.defpath)
    os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), others])


def start_server(compiled: str, cores: int) -> None:
    """Start the process that jobs are forks of, on so many cores; it ends when this one does.

    Where processes are no forks each job begins by itself. ``compiled`` is the file that tells that kernels
    are compiled.
    """
    os.environ[CORES] = str(cores)
    if not (forks() and hasattr(socket, "AF_UNIX")):
        return
    address, log_file = Path(".snakemake/jobs"), Path("logs/server.log")
    address.unlink(missing_ok=True)
    log_file.parent.mkdir(exist_ok=True)
    # Bound here, so that the first job finds it and waits, instead of loading everything once more.
    with socket.socket(socket.AF_UNIX) as listener, log_file.open("wb") as log:
        others = os.umask(0o077)  # the socket takes jobs from its owner alone
        listener.bind(str(address))
        os.umask(others)
        listener.listen(128)
        number = listener.fileno()
        command = [sys.executable, "-m", "riserstudy.jobs.server", str(number), compiled]
        server = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=log, stderr=log, pass_fds=[number]
        )
    atexit.register(address.unlink, missing_ok=True)
    atexit.register(server.communicate)  # which closes its input and waits for it
    os.environ["RISERSTUDY_JOBS"] = str(address)
