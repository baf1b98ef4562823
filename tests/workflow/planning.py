"""A dry run of Snakemake in a process where it is imported already: to import it takes half the time."""

import os
import re
import sys
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory

SERVER = get_context("forkserver")
SERVER.set_forkserver_preload(["snakemake.cli"])


def dry_run(folder, environment, *arguments):
    """Exit status of ``snakemake -n`` in a folder, and what it said."""
    with TemporaryDirectory() as aside:
        said = Path(aside) / "said"
        run = SERVER.Process(target=_run, args=(folder, {**environment}, arguments, said))
        run.start()
        run.join()
        return run.exitcode, said.read_text()


def jobs_in(log):
    """Messages of the jobs in what Snakemake says."""
    return set(re.findall(r"^Job \d+: (.*)$", log, re.M))


def _run(folder, environment, arguments, said):
    from snakemake.cli import main

    with said.open("w") as file:
        for stream in (1, 2):
            os.dup2(file.fileno(), stream)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    sys.path[:0] = [path for path in environment.get("PYTHONPATH", "").split(os.pathsep) if path]
    main(["-n", "--nocolor", *arguments])
