"""Resolve the dependencies into the lock files. Needs nothing but the standard library.

Each lock serves every supported Python at once, with one version of each package for all of them,
so that results do not change with the interpreter. A lock holds neither an address nor a path: any
index that serves the same files will do.
"""

import subprocess
import sys
import tempfile
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
UV = "uv==0.13.8"
#: the next Python, and the dependency of Snakemake that has no wheel for it
NEXT = "3.14"
WITHOUT_WHEEL = "immutables"
OPTIONS = (
    "--quiet",
    "--universal",
    "--python-version=3.11",
    "--fork-strategy=fewest",
    "--generate-hashes",
    "--upgrade",
    "--no-header",
    "--no-annotate",
    "--no-emit-index-url",
    "--no-emit-find-links",
)


def main() -> None:
    """Write requirements.lock first: the other locks agree with it."""
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        tools = Path(folder) / "bin"
        run(tools / "python", "-m", "pip", "install", "-qq", "--disable-pip-version-check", UV)
        uv = (tools / "uv", "pip", "compile", *OPTIONS)
        run(*uv, "pyproject.toml", "--group=dev", "--output-file=requirements.lock")
        for group in ("build", "bench", "slurm"):
            agree = ("--constraints", "requirements.lock")
            run(*uv, f"--group={group}", *agree, f"--output-file={group}.lock")
        print(about_next_python(tools / "uv"))


def about_next_python(uv: Path) -> str:
    """Whether the one dependency that keeps newer Pythons out still does."""
    asked = (
        uv,
        "pip",
        "compile",
        "--quiet",
        f"--python-version={NEXT}",
        "--only-binary=:all:",
        "-",
    )
    found = subprocess.run(
        [str(word) for word in asked], input=WITHOUT_WHEEL, text=True, capture_output=True
    )
    if not found.returncode:
        return (
            f"{WITHOUT_WHEEL} has a wheel for Python {NEXT} now: raise requires-python in pyproject.toml,"
            " and the range in workflow/scripts/with_python.sh; try make test-pythons."
        )
    if WITHOUT_WHEEL not in found.stderr:
        return f"Whether Python {NEXT} has become possible is not known: {found.stderr.strip()}"
    return f"{WITHOUT_WHEEL} has no wheel for Python {NEXT} yet."


def run(*command: object) -> None:
    """Run a command in the project's folder; its failure ends the program."""
    status = subprocess.run([str(word) for word in command], cwd=ROOT, stdout=subprocess.DEVNULL)
    if status.returncode:
        sys.exit(status.returncode)


if __name__ == "__main__":
    main()
