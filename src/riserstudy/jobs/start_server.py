"""Start of the server process, from which the jobs of a run are forked."""

from __future__ import annotations

import atexit
import os
import re
import shlex
import socket
import subprocess
import sys
from pathlib import Path

from riserstudy.errors import InputError
from riserstudy.jobs import CORES
from riserstudy.study.processes import forks


def use_this_python() -> None:
    """Put this Python first in ``PATH``, for all processes that are started from now on."""
    others = os.environ.get("PATH", os.defpath)
    os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), others])


def refuse_quoted_python(python: str) -> None:
    """Refuse a Python whose path a shell splits or expands. Raises InputError.

    Snakemake writes this path without quotes into the scripts that it submits to a cluster.
    """
    if re.search(r"[^\w@%+=:,./-]", python):
        link = "~/riserstudy-environment"
        raise InputError(
            python,
            "",
            "a cluster cannot start this Python, because its path has a blank or a special character",
            f"run `ln -s {shlex.quote(str(Path(python).parents[1]))} {link}`, "
            f"and start Snakemake by `{link}/bin/python -m snakemake`",
        )


def start_server(cores: int) -> None:
    """Start the server process, from which jobs are forked; it ends when the present process ends.

    On a system without forks each job starts by itself. ``cores`` is the number of cores that the jobs share.
    """
    os.environ[CORES] = str(cores)
    if not (forks() and hasattr(socket, "AF_UNIX")):
        return
    address, log_file = Path(".snakemake/jobs"), Path("logs/server.log")
    address.unlink(missing_ok=True)
    log_file.parent.mkdir(exist_ok=True)
    # The socket is bound here: the first job then finds it and waits, and does not load everything itself.
    with socket.socket(socket.AF_UNIX) as listener, log_file.open("wb") as log:
        others = os.umask(0o077)  # only the owner may connect to the socket
        listener.bind(str(address))
        os.umask(others)
        listener.listen(128)
        number = listener.fileno()
        command = [sys.executable, "-m", "riserstudy.jobs.server", str(number)]
        server = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=log, stderr=log, pass_fds=[number])
    atexit.register(address.unlink, missing_ok=True)
    atexit.register(server.communicate)  # closes the server's input and waits for its end
    os.environ["RISERSTUDY_JOBS"] = str(address)
