"""As a new user: an empty environment, the wheel, a folder of one's own, `snakemake`. Times are told."""

import os
import re
import subprocess
import sys
import time
import venv
from pathlib import Path

import pytest
import xarray as xr

ROOT = Path(__file__).parents[2]
LIMIT = 300.0  # s, on two cores that do little else


class User:
    """Somebody in an empty environment, with neither clone nor cache."""

    def __init__(self, folder):
        self.folder = folder
        self.tools = folder / "environment/bin"
        self.times = {}
        kept = ("HOME", "LANG", "PATH", "PIP_CONFIG_FILE", "PIP_INDEX_URL")
        self.environment = {name: os.environ[name] for name in kept if name in os.environ}

    def do(self, step, *command, cwd=None):
        """Run one of the environment's commands, and note its time."""
        began = time.monotonic()
        done = subprocess.run(
            [self.tools / command[0], *command[1:]],
            cwd=cwd or self.folder,
            env=self.environment,
            capture_output=True,
            text=True,
        )
        self.times[step] = time.monotonic() - began
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout + done.stderr


@pytest.mark.slow
def test_a_new_user_has_a_report_of_an_own_study(tmp_path):
    user = User(tmp_path)
    wheels = tmp_path / "wheels"
    pip = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation"]
    subprocess.run([*pip, "-w", wheels, ROOT], check=True)
    (wheel,) = wheels.glob("riserstudy-*.whl")

    venv.create(tmp_path / "environment", with_pip=True)
    quiet = ("pip", "install", "-q", "--disable-pip-version-check")
    user.do("build backends", *quiet, "--require-hashes", "-r", ROOT / "build.lock")
    # One dependency is published as source only; its backend is among those of build.lock.
    locked = ("--require-hashes", "--no-build-isolation", "-r", ROOT / "requirements.lock")
    user.do("dependencies", *quiet, *locked)
    user.do("riserstudy", *quiet, "--no-deps", wheel)

    user.do("new", "riserstudy", "new", "my-study")
    study = tmp_path / "my-study"
    user.do("snakemake", "snakemake", cwd=study)
    again = user.do("again", "snakemake", cwd=study)

    assert "Nothing to be done" in again
    page = (study / "results/report.html").read_text()
    assert len(re.findall(r'<figure id="example-', page)) == 6
    heave = xr.load_dataset(study / "results/example/heave.nc")
    force = heave["tensioner_force"].max(["time", "cylinder"])
    assert (force.diff("heave_amplitude") > 0.0).all()  # more heave, more pull
    told = ", ".join(f"{step} {seconds:.0f} s" for step, seconds in user.times.items())
    print(f"\n{told}; in all {sum(user.times.values()):.0f} s")
    load = os.getloadavg()[0] / (os.cpu_count() or 1)
    assert sum(user.times.values()) < LIMIT * max(1.0, load)
