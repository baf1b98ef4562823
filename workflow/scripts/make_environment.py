"""Make .venv from the hashed locks, see ``installer.py``. Uses only the standard library.

The order of installation ensures that only locked packages are used. First come the build backends,
with hashes; then all other packages, with hashes and built without isolation, because one dependency
is published only as source, and its build would otherwise download a backend that no lock names;
then the project itself. A complete environment is updated in place when a lock changes: packages that
differ are installed, and packages that no lock names are removed.
"""

import fcntl
import hashlib
import os
import platform
import re
import shutil
import subprocess
import sys
from pathlib import Path

from installer import install, install_lock, pip_of, run

ROOT = Path(__file__).resolve().parents[2]
VENV = ROOT / ".venv"
PYTHON = VENV / "bin" / "python"
LOCKS = (ROOT / "build.lock", ROOT / "requirements.lock")
#: modules that most processes of a study import
IMPORTED = "snakemake.cli, snakemake.workflow, numba, xarray, netCDF4, scipy.optimize, scipy.interpolate"
IMPORTED += ", matplotlib.figure, matplotlib.backends.backend_agg, pint, pydantic, ruamel.yaml, typer"


def main(marker: Path) -> int:
    """Update the environment, and touch `marker` last."""
    if sys.prefix != sys.base_prefix:  # started from an environment, perhaps the one to replace
        base = getattr(sys, "_base_executable", sys.executable)
        os.execv(base, [base, *sys.argv])
    (ROOT / ".cache").mkdir(mode=0o700, exist_ok=True)  # private: its files are executed
    with (ROOT / ".cache" / "environment.lock").open("a+") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            print("Waiting for another run that installs the environment ...", flush=True)
            fcntl.flock(lock, fcntl.LOCK_EX)
        if not marker.exists():
            try:
                bring_up_to_date(marker)
            except subprocess.CalledProcessError as error:
                print(
                    "riserstudy: the installation failed, see above; the next make begins again. "
                    f"It was at: {' '.join(error.cmd)}",
                    file=sys.stderr,
                )
                return 1
    return 0


def bring_up_to_date(marker: Path) -> None:
    """Install the locked packages unless they are installed, then the project."""
    locked = VENV / f".locked-{locks_digest()}"
    if not locked.exists():
        python = f"Python {platform.python_version()}"
        if complete := is_complete():
            print(f"Bringing the environment ({python}) to the present locks ...", flush=True)
        else:
            print(f"Installing the environment ({python}; once) ...", flush=True)
            shutil.rmtree(VENV, ignore_errors=True)
            run(sys.executable, "-m", "venv", VENV)
        for former in VENV.glob(".locked-*"):
            former.unlink()  # from here on the environment counts as incomplete
        for lock in LOCKS:
            install_lock(PYTHON, lock)
        if complete and (strangers := not_locked()):
            run(*pip_of(PYTHON), "-qq", "uninstall", "--yes", *strangers)
        compile_modules()
        locked.touch()
    for stale in VENV.glob(".ready-*"):
        stale.unlink()
    install(PYTHON, "--no-deps", "--no-build-isolation", "-e", ROOT)
    marker.touch()


def compile_modules() -> None:
    """Compile the modules of `IMPORTED` if Python is set to write no bytecode.

    Each job would compile them again. With bytecode, Python compiles a module at its first import, and
    most modules are never imported.
    """
    if os.environ.get("PYTHONDONTWRITEBYTECODE"):
        env = os.environ | {"PYTHONDONTWRITEBYTECODE": ""}
        subprocess.run([PYTHON, "-c", f"import {IMPORTED}"], env=env, check=True)


def is_complete() -> bool:
    """Return whether a completely installed environment of this Python version, made here, exists."""
    if not any(VENV.glob(".locked-*")):
        return False
    about = (VENV / "pyvenv.cfg").read_text("utf-8")
    answers = dict(re.findall(r"^(\S+) = (.*)$", about, re.MULTILINE))
    here = answers.get("command", "").endswith(f" {VENV}")
    return here and answers.get("version") == platform.python_version() and PYTHON.exists()


def not_locked() -> list[str]:
    """Return the installed packages that no lock names, except this project and the installer."""
    named = {name for lock in LOCKS for name in re.findall(r"^([\w.-]+)==", lock.read_text(), re.M)}
    command = [*map(str, pip_of(PYTHON)), "list", "--format=freeze"]
    answers = subprocess.run(command, check=True, capture_output=True, text=True)
    names = [line.partition("==")[0] for line in answers.stdout.splitlines()]
    kept = {plain(name) for name in (*named, "pip", "setuptools", "riserstudy")}
    return [name for name in names if plain(name) not in kept]


def plain(name: str) -> str:
    """Return a package's name in the form in which the index compares names."""
    return re.sub(r"[-_.]+", "-", name).lower()


def locks_digest() -> str:
    """Return a digest of the locks and the project's path, on which the installed packages depend."""
    content = b"".join(lock.read_bytes() for lock in LOCKS) + os.fsencode(ROOT)
    return hashlib.sha256(content).hexdigest()[:12]


if __name__ == "__main__":
    sys.exit(main(ROOT / sys.argv[1]))
