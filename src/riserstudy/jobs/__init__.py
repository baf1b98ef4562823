"""What the rules of the workflow run, as ``python -m riserstudy.jobs <name>``.

They are part of the package, so that a checkout and a folder of one's own run the same.
"""

from __future__ import annotations

import atexit
import os
import subprocess
import sys
from pathlib import Path


def start_server(compiled: str) -> None:
    """Start the process that jobs are forks of; it ends when this one does.

    ``compiled`` is the file that tells that kernels are compiled.
    """
    address, log_file = Path(".snakemake/jobs"), Path("logs/server.log")
    log_file.parent.mkdir(exist_ok=True)
    with log_file.open("wb") as log:
        command = [sys.executable, "-m", "riserstudy.jobs.server", str(address), compiled]
        server = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=log, stderr=log)
    atexit.register(server.communicate)  # which closes its input and waits for it
    os.environ["RISERSTUDY_JOBS"] = str(address)
