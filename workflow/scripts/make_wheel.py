"""Build the package into dist/, with the locked build backend and nothing else installed."""

import subprocess
import sys
import tempfile
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PIP = ("-m", "pip", "--quiet", "--disable-pip-version-check")


def main() -> int:
    """Make the wheel in a temporary environment; return the exit status."""
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        python = Path(folder) / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
        for command in (
            ("install", "--require-hashes", "--no-deps", "-r", "build.lock"),
            ("wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", "dist", "."),
        ):
            done = subprocess.run([python, *PIP, *command], cwd=ROOT)
            if done.returncode:
                return done.returncode
    return 0


if __name__ == "__main__":
    sys.exit(main())
