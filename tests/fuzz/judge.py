"""Meet hostile input in processes of their own, and say what is wrong with how it ended.

Allowed is: done (0), refused (2) or not to be completed (3), the latter two with one message and no file
left; a dataset without NaN when done; all within the time and memory given.
"""

import contextlib
import io
import multiprocessing
import re
import resource
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from pathlib import Path

import psutil
import xarray as xr
from hostile import OUT, case

from riserstudy.cli import main
from riserstudy.errors import RiserStudyError

SECONDS = 60.0  # of a core that a case may take
HANGS = 600.0  # s that it may take in all, on a machine with much else to do
MEMORY = 4 * 2**30  # bytes of address space
OF_WALLS = "von_mises_stress"  # without a value where a scene does not give the wall, as it says itself
#: what a run says of itself that takes more than seconds
PROGRESS = re.compile(
    r"^riserstudy: "
    r"(compiling|run \d+: |the first periods: |a coarser run|the requested run: |takes about ).*\n",
    re.MULTILINE,
)


def faults_of(kind, seeds, notify=lambda _: None):
    """Faults by seed, and how often each exit code came."""
    faults, codes = {}, Counter()
    context = multiprocessing.get_context("spawn")
    worker = connection = None
    for seed in seeds:
        if worker is None:
            connection, far = context.Pipe()
            worker = context.Process(target=_work, args=(far,), daemon=True)
            worker.start()
            far.close()
            connection.recv()  # imports done
        connection.send((kind, seed))
        fault = code = None
        try:
            if _answers(connection, worker.pid):
                code, fault = connection.recv()
            else:
                fault = f"ran past {SECONDS:g} s"
        except EOFError:
            fault = "the process died"
        if code is None:
            worker.kill()
            worker.join()
            worker = None
        codes[code] += 1
        if fault:
            faults[seed] = fault
            notify(f"{kind} {seed}: {fault}")
    if worker:
        worker.kill()
        worker.join()
    return faults, codes


def _answers(connection, pid):
    """Whether a process answers before its time is up."""
    process, began = psutil.Process(pid), time.monotonic()
    spent = process.cpu_times().user
    while not connection.poll(0.5):
        if process.cpu_times().user - spent > SECONDS or time.monotonic() - began > HANGS:
            return False
    return True


def _work(connection):
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    connection.send("ready")
    while True:
        connection.send(attempt(*connection.recv()))


def attempt(kind, seed):
    """How a case ends that is met in this process, and its fault, if any."""
    with tempfile.TemporaryDirectory() as name, contextlib.chdir(name):
        folder = Path(name)
        doing = case(kind, seed, folder)
        before = _files(folder)
        out, err = io.StringIO(), io.StringIO()
        with warnings.catch_warnings(), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            warnings.simplefilter("always")
            try:
                code = _call(doing) if callable(doing) else _command(doing)
            except Exception as error:
                return 1, "".join(traceback.format_exception(error, limit=-4))
        fault = fault_of(code, err.getvalue(), _files(folder) - before, folder)
        return ("2 (output alone)" if "--output: absent/" in err.getvalue() else code), fault


def in_a_process(kind, seed):
    """The same through the installed command."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        words = case(kind, seed, folder)
        before = _files(folder)
        try:
            done = subprocess.run(
                [Path(sys.executable).with_name("riserstudy"), *words],
                cwd=folder, capture_output=True, text=True, timeout=HANGS, check=False,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return None, f"ran past {HANGS:g} s"
        left = _files(folder) - before
        return done.returncode, fault_of(done.returncode, done.stderr, left, folder)


def fault_of(code, said, made, folder):
    """What is wrong with how a command ended, if anything."""
    if code not in (0, 2, 3) or "Traceback" in said:
        return f"exit {code}: {said}"
    said = PROGRESS.sub("", said)
    if code and (not said.startswith("riserstudy: ") or said.count("\n") != 1 or len(said) > 2000):
        return f"exit {code} with no single message: {said[:300]!r}"
    if code and made:
        return f"exit {code} leaves {made}"
    if any(Path(file).name.startswith(".") for file in made):
        return f"leaves {made}"
    if OUT in made:
        with xr.open_dataset(folder / OUT, engine="netcdf4") as dataset:
            numbers = [
                v for name, v in dataset.variables.items()
                if v.dtype.kind == "f" and not str(name).startswith(OF_WALLS)
            ]  # fmt: skip
            if any(v.isnull().any() for v in numbers):
                return "NaN in the result"
    return None


def _command(words):
    sys.argv = ["riserstudy", *words]
    try:
        main()
    except SystemExit as done:
        return done.code or 0
    return 0


def _call(doing):
    try:
        doing()
    except RiserStudyError as error:
        print(f"riserstudy: {error}", file=sys.stderr)
        return error.exit_code
    return 0


def _files(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}
