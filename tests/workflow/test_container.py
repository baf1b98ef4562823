"""The Containerfile: linted, true to the repository; `make test-container` runs its steps in a clean root."""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from containerfile import BASE, CleanRoot, ignored, steps_of

ROOT = Path(__file__).parents[2]
FILE = ROOT / "Containerfile"
TEXT = FILE.read_text("utf-8")
PATTERNS = [
    line
    for line in (ROOT / ".dockerignore").read_text("utf-8").splitlines()
    if line and not line.startswith("#")
]
#: Python of a release of Debian
PYTHONS = {"bookworm": (3, 11), "trixie": (3, 13)}
HADOLINT = shutil.which("hadolint")


def faults(text):
    """What is wrong with a Containerfile, a line each: the rules of hadolint that it could break."""
    steps = steps_of(text)
    names = [step.name for step in steps]
    users = [step.rest for step in steps if step.name == "USER"]
    runs = [step.rest for step in steps if step.name == "RUN"]
    found = []
    if names[:1] != ["FROM"] or not BASE.fullmatch(steps[0].rest):
        found.append("no base of a named release")
    if not users or users[-1] in ("0", "root"):
        found.append("runs as root")
    if "ADD" in names:
        found.append("ADD where COPY would do")
    if names.count("CMD") != 1 or names[-1] != "CMD" or not steps[-1].rest.startswith("["):
        found.append("not one CMD, as a list, at the end")
    if any(not step.rest.startswith("/") for step in steps if step.name == "WORKDIR"):
        found.append("a WORKDIR that is not absolute")
    for run in runs:
        if "apt-get install" in run and "rm -rf /var/lib/apt/lists/*" not in run:
            found.append("lists of packages stay in the image")
        if "apt-get install" in run and "--no-install-recommends" not in run:
            found.append("packages that are only recommended")
        if "sudo" in run or re.search(r"\bpip\d? install", run):
            found.append("sudo, or packages that no lock names")
        if subprocess.run(["bash", "-n", "-c", run], capture_output=True).returncode:
            found.append("no command of a shell")
    return found


def test_the_recipe_has_no_fault():
    assert faults(TEXT) == []


@pytest.mark.parametrize(
    "old, new",
    [
        ("debian:bookworm-slim", "debian:latest"),
        ("USER 1000\n", ""),
        ("USER 1000\n", "USER root\n"),
        ("COPY --chown=1000:1000 . .", "ADD . ."),
        ('CMD ["make", "study", "TIER=preview"]', "CMD make study"),
        ("WORKDIR /home/riser/riserstudy", "WORKDIR riserstudy"),
        (" && rm -rf /var/lib/apt/lists/* \\\n", ""),
        (" --no-install-recommends", ""),
        ("RUN make environment", "RUN pip install riserstudy"),
        ("RUN make environment", "RUN make (environment"),
    ],
)
def test_a_fault_is_found(old, new):
    assert old in TEXT
    assert faults(TEXT.replace(old, new))


def test_nothing_that_git_tracks_is_left_out_of_the_image():
    listed = ["git", "ls-files", "--cached", "-z"]
    names = subprocess.run(listed, cwd=ROOT, capture_output=True, text=True)
    if names.returncode:
        pytest.skip("no git here, or no repository")
    left = [name for name in names.stdout.split("\0") if name and ignored(PATTERNS, name)]
    assert left == []
    assert all(ignored(PATTERNS, name) for name in (".venv/bin/python", "a/__pycache__/b.pyc"))


def test_its_targets_are_those_of_the_makefile_and_its_python_is_supported():
    makefile = (ROOT / "Makefile").read_text("utf-8")
    words = [step.words for step in steps_of(TEXT) if step.rest.lstrip('["').startswith("make")]
    assert len(words) == 2
    for _, target, *_ in words:
        assert re.search(rf"^{target}: ", makefile, re.MULTILINE)
    release = BASE.fullmatch(steps_of(TEXT)[0].rest)["release"]
    allowed = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    low, high = re.findall(r"3\.(\d+)", allowed["project"]["requires-python"])
    assert int(low) <= PYTHONS[release][1] < int(high)


@pytest.mark.skipif(not HADOLINT, reason="run by `make test-container`")
def test_hadolint_says_nothing():
    done = subprocess.run([HADOLINT, str(FILE)], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (0, "")
    spoiled = TEXT.replace("debian:bookworm-slim", "debian:latest")
    done = subprocess.run([HADOLINT, "-"], input=spoiled, capture_output=True, text=True)
    assert "DL3007" in done.stdout


@pytest.mark.skipif("RISERSTUDY_CLEAN_ROOT" not in os.environ, reason="run by `make test-container`")
def test_its_steps_make_an_environment_in_a_clean_root(tmp_path):
    """All steps but CMD, as its user; then a command that CMD rests on, and a run of a scene."""
    if os.geteuid() or not shutil.which("mmdebstrap"):
        pytest.skip("needs root, and mmdebstrap (Debian: apt install mmdebstrap)")
    root = CleanRoot(tmp_path / "root", ROOT, PATTERNS)
    tmp_path.chmod(0o755)
    for step in steps_of(TEXT):
        root.take(step)
    assert root.user == "1000"
    assert "riserstudy" in root.run_as("riserstudy --version")
    said = root.run_as("riserstudy run config/scenes/bench/s1.yaml -o run.nc && ls run.nc")
    assert "run.nc" in said
    command = steps_of(TEXT)[-1].words
    assert "run_study.py --tier 'preview'" in root.run_as(" ".join([*command, "--dry-run"]))
    root.run_as("snakemake --config tier=preview --cores 1 chang2020_fig05")
