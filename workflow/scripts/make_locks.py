"""Resolve the dependencies into the lock files. Uses only the standard library.

Each lock is valid for every supported Python, with one version of each package for all of them, so
that results do not change with the interpreter. A lock contains neither an address nor a path: any
index that provides identical files can be used.
"""

import os
import subprocess
import sys
import tempfile
import tomllib
import venv
from pathlib import Path

from installer import PURE, PURE_FROM, pip_of, pip_settings, with_settings

ROOT = Path(__file__).resolve().parents[2]
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
    """Write all locks, requirements.lock first: the other locks, except crate.lock, agree with it."""
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        tools = Path(folder) / "bin"
        run(*pip_of(tools / "python"), "install", "-qq", *pinned("installer"))
        env = with_settings(dict(os.environ), leading_to_the_index(tools / "python"))
        uv = (tools / "uv", "pip", "compile", *OPTIONS)
        run(*uv, "pyproject.toml", "--group=dev", "--output-file=requirements.lock", env=env)
        for group in ("build", "bench", "slurm", "formats", "container", "installer"):
            agree = ("--constraints", "requirements.lock")
            run(*uv, f"--group={group}", *agree, f"--output-file={group}.lock", env=env)
        # for a separate environment, because it needs an older release of a library of riserstudy
        run(*uv, "--group=crate", "--output-file=crate.lock", env=env)
        print(about_pure(tools / "uv", env))


def leading_to_the_index(python: Path) -> dict[str, str]:
    """Return pip's settings without extra indexes and links, which may lack files of a release.

    A lock names all files of a release.
    """
    settings = pip_settings(python)
    return {name: settings[name] for name in settings.keys() - {"extra-index-url", "find-links"}}


def pinned(group: str) -> list[str]:
    """Return the requirements of a dependency group of the project."""
    about = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    return list(about["dependency-groups"][group])


def about_pure(uv: Path, env: dict[str, str]) -> str:
    """State whether `PURE`, used without its compiled part in newer Pythons, has a wheel for them now."""
    version = ".".join(map(str, PURE_FROM))
    requested = (uv, "pip", "compile", "--quiet", f"--python-version={version}", "--only-binary=:all:")
    found = subprocess.run([*map(str, requested), "-"], input=PURE, text=True, capture_output=True, env=env)
    if not found.returncode:
        return (
            f"{PURE} has a wheel for Python {version} now: PURE and install_pure can leave "
            "workflow/scripts/installer.py."
        )
    if PURE not in found.stderr:
        return f"Whether {PURE} has a wheel for Python {version} is not known: {found.stderr.strip()}"
    return f"{PURE} has no wheel for Python {version} yet."


def run(*command: object, env: dict[str, str] | None = None) -> None:
    """Run a command in the project's folder; exit if it fails."""
    words = [str(word) for word in command]
    status = subprocess.run(words, cwd=ROOT, stdout=subprocess.DEVNULL, env=env)
    if status.returncode:
        sys.exit(status.returncode)


if __name__ == "__main__":
    main()
