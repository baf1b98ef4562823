"""Commands compile what their scenes need, once, and report it."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from riserstudy.simulation.kernel_groups import GROUPS, group_of
from riserstudy.simulation.warm_up import scenes

pytestmark = pytest.mark.long

SCENES = Path(__file__).parents[2] / "config/scenes"
GENERIC = SCENES / "design/riser.yaml"
TENSIONERS = ("--units", 6, "--tension-ratio", 0.95, "--weight", 1.05, "--buoyancy", 0.96)


def test_the_first_command_that_simulates_compiles_on_all_cores_and_says_so(monkeypatch, tmp_path):
    """With a compiler that only takes note: the real one takes minutes."""
    from riserstudy.simulation import compile as compiling

    asked, said = [], []
    monkeypatch.setattr(compiling, "kernel_cache", lambda: tmp_path / "kernels")
    monkeypatch.setattr(compiling, "available_cores", lambda: 3)

    def note(groups, cores):
        asked.append((list(groups), cores))
        for group in groups:
            about = {"began": 0.0, "ended": 1.0, "core_seconds": 1.0, "kernels": []}
            compiling.marker(group).write_text(json.dumps(about))

    monkeypatch.setattr(compiling, "compile_groups", note)
    compiling.compile_once(said.append)
    compiling.compile_once(said.append)
    assert asked == [(list(GROUPS), 3)]
    assert len(said) == 1
    assert "on 3 cores" in said[0]


def test_a_single_run_compiles_what_it_needs_and_says_so_once(tmp_path):
    environment = os.environ | {"RISERSTUDY_CACHE": str(tmp_path)}
    command = [Path(sys.executable).with_name("riserstudy"), "run", SCENES / "bench/s1.yaml"]
    said = []
    for _ in range(2):
        run = [*command, "-o", tmp_path / "out.nc"]
        done = subprocess.run(run, env=environment, capture_output=True, text=True, check=True)
        said.append(done.stderr.count("compiling the kernels that this scene needs"))
    assert said == [1, 0]


@pytest.mark.parametrize("name", ["modes", "operability", "tension"])
def test_no_command_compiles_what_its_scene_does_not_need(commands, monkeypatch, name):
    from riserstudy.simulation import compile as compiling

    def all_of_them(*_):
        raise AssertionError("all kernels are compiled")

    monkeypatch.setattr(compiling, "compile_once", all_of_them)
    monkeypatch.setattr(compiling, "compile_groups", all_of_them)
    limits = "limits=[{output: lfj_angle, largest: 4 deg, mode: drilling}]"
    more = {
        "modes": [],
        "operability": ["--reach", "20 m", "--set", limits],
        "tension": ["--failed", 1, *TENSIONERS],
    }
    assert commands(name, GENERIC, *more[name])[0] == 0


def test_compiling_reports_its_progress_without_a_terminal(monkeypatch):
    """Of functions that call one another: each report has more of them compiled than the one before."""
    numba = pytest.importorskip("numba")
    from riserstudy.simulation import compile_times

    monkeypatch.setattr(compile_times, "EVERY", 0.0)
    said = []
    compile_times.follow(lambda *report: said.append(report))
    inner = numba.njit(lambda x: x + 1.0)
    outer = numba.njit(lambda x: inner(x) * 2.0)
    assert outer(1.0) == 4.0
    compile_times.follow(None)
    assert said[0][:2] == ("", 0)
    counts, times = ([report[k] for report in said] for k in (1, 2))
    assert counts == sorted(counts)
    assert times == sorted(times)
    assert counts[-1] == 2


@pytest.mark.parametrize("group", scenes())
def test_a_scene_finds_most_of_what_it_runs_in_its_group(group):
    assert {group_of(scene) for scene in scenes()[group]} == {group}
