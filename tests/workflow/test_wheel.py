"""As a new user: an empty environment, the wheel, a folder of one's own, `snakemake`.

Times are told, and held to five minutes by the clock unless other work takes a part of the machine meanwhile.
"""

import os
import re
import resource
import subprocess
import sys
import time
import venv
from pathlib import Path

import psutil
import pytest
import xarray as xr
from hatchling.builders.wheel import WheelBuilder
from ruamel.yaml import YAML

ROOT = Path(__file__).parents[2]
LIMIT = 300.0  # s
#: how the package index is reached, and nothing that names a clone or a cache of ours
KEPT = re.compile(r"HOME$|LANG$|PATH$|PIP_|SSL_|REQUESTS_|\w+_proxy$", re.IGNORECASE)


def processors():
    """Time that processes which have ended took of processors (s)."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def others():
    """Time that processors spent on what neither we nor our processes that have ended did (s)."""
    spent = psutil.cpu_times()
    ours = resource.getrusage(resource.RUSAGE_SELF)
    return sum(spent) - spent.idle - spent.iowait - ours.ru_utime - ours.ru_stime - processors()


class User:
    """Somebody in an empty environment, with neither clone nor cache."""

    def __init__(self, folder):
        self.folder = folder
        self.tools = folder / "environment/bin"
        self.times = {}
        self.environment = {n: v for n, v in os.environ.items() if KEPT.match(n)}

    def do(self, step, *command, cwd=None):
        """Run one of the environment's commands, and note its time."""
        began, worked = time.monotonic(), processors()
        done = subprocess.run(
            [self.tools / command[0], *command[1:]],
            cwd=cwd or self.folder,
            env=self.environment,
            capture_output=True,
            text=True,
        )
        self.times[step] = time.monotonic() - began, processors() - worked
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout + done.stderr


def test_chapters_of_papers_and_of_the_engine_are_not_installed():
    """Read from what the build backend would pack, without packing it."""
    packed = {file.distribution_path for file in WheelBuilder(str(ROOT)).recurse_included_files()}
    assert "riserstudy/chapters/measure.py" in packed
    assert "riserstudy/study/measured.py" in packed
    names = {Path(path).parts[0] for path in packed}
    assert names == {"riserstudy", "snakemake_logger_plugin_riserstudy"}
    chapters = [Path(path).parts for path in packed if path.startswith("riserstudy/chapters/")]
    assert {len(parts) for parts in chapters} == {3}  # what calls them, and no folder of one


@pytest.mark.slow
def test_a_new_user_has_a_report_of_an_own_study(tmp_path):
    before = others()
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

    assert "Nothing to do: every result is up to date." in again
    page = (study / "results/report.html").read_text()
    asked = YAML(typ="safe").load(study / "config/studies/example.yaml")["figures"]
    assert {*re.findall(r'<figure id="example-(\w+)', page)} == {*asked}
    heave = xr.load_dataset(study / "results/example/heave.nc")
    force = heave["tensioner_force"].max(["time", "cylinder"])
    assert (force.diff("heave_amplitude") > 0.0).all()  # more heave, more pull
    told = ", ".join(f"{step} {clock:.0f} s ({work:.0f})" for step, (clock, work) in user.times.items())
    clock, work = (sum(times) for times in zip(*user.times.values(), strict=True))
    elsewhere = others() - before
    print(f"\n{told}; in all {clock:.0f} s ({work:.0f} s of processors; others {elsewhere:.0f} s)")
    assert clock < LIMIT or elsewhere > 0.1 * clock
