"""Make .venv from the hashed locks. Needs nothing but the standard library.

The order is what makes the install closed: first the build backends, hashed; then everything else,
hashed and built without isolation, since one dependency is published as source only and its build
would otherwise fetch a backend that no lock names; then the project itself.
"""

import fcntl
import hashlib
import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
VENV = ROOT / ".venv"
LOCKS = (ROOT / "build.lock", ROOT / "requirements.lock")


def main(marker: Path) -> int:
    """Bring the environment up to date and touch `marker` last."""
    if sys.prefix != sys.base_prefix:  # started from an environment, perhaps the one to replace
        base = getattr(sys, "_base_executable", sys.executable)
        os.execv(base, [base, *sys.argv])
    (ROOT / ".cache").mkdir(exist_ok=True)
    with (ROOT / ".cache" / "environment.lock").open("a+") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            print("Waiting for another run that installs the environment ...", flush=True)
            fcntl.flock(lock, fcntl.LOCK_EX)
        if not marker.exists():
            try:
                install(marker)
            except subprocess.CalledProcessError as error:
                print(
                    "riserstudy: the installation failed, see above; the next make begins anew. "
                    f"It was at: {' '.join(error.cmd)}",
                    file=sys.stderr,
                )
                return 1
    return 0


def install(marker: Path) -> None:
    """Install the locked packages unless they are there, then the project."""
    locked = VENV / f".locked-{locks_digest()}"
    if not locked.exists():
        python = f"Python {platform.python_version()}"
        print(f"Installing the environment ({python}; once, a minute or two) ...", flush=True)
        shutil.rmtree(VENV, ignore_errors=True)
        run(sys.executable, "-m", "venv", VENV)
        for lock in LOCKS:
            pip_install("--require-hashes", "--no-build-isolation", "-r", lock)
        locked.touch()
    for stale in VENV.glob(".ready-*"):
        stale.unlink()
    pip_install("--no-deps", "--no-build-isolation", "-e", ROOT)
    marker.touch()


def locks_digest() -> str:
    """Digest of what the installed packages depend on: the locks and the place."""
    content = b"".join(lock.read_bytes() for lock in LOCKS) + os.fsencode(ROOT)
    return hashlib.sha256(content).hexdigest()[:12]


def pip_install(*arguments: object) -> None:
    """Install into the environment, silently unless it fails.

    Modules are compiled here: where PYTHONDONTWRITEBYTECODE is set, every job would do it anew.
    """
    quiet = ("-qq", "--no-input", "--disable-pip-version-check")
    run(VENV / "bin" / "python", "-m", "pip", "install", *quiet, *arguments)


def run(*command: object) -> None:
    """Run a command; its failure is an exception."""
    subprocess.run([str(word) for word in command], check=True)


if __name__ == "__main__":
    sys.exit(main(ROOT / sys.argv[1]))
