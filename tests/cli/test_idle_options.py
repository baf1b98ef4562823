"""An option that would have no effect is refused, and no table is kept or replaced in silence."""

from pathlib import Path

import numpy as np
import pytest
from random_rigs import rig, written
from ruamel.yaml import YAML


@pytest.fixture
def scene(tmp_path, monkeypatch):
    """A file of a rig in a weak current, which excites no mode, with a limit."""
    monkeypatch.chdir(tmp_path)
    tree = rig(3, spatial=False, conductor=False)
    tree["current"]["profile"]["surface_speed"] = 1e-4
    tree["analysis"] = {"mesh": {"elements": 24}}
    limits = [{"output": "lfj_angle", "largest": "4 deg", "mode": "drilling"}]
    with Path("rig.yaml").open("w") as file:
        YAML().dump(written(tree) | {"limits": limits}, file)
    return "rig.yaml"


@pytest.mark.parametrize("option, value", [("--seeds", 5), ("--seeds", 30), ("--exposure", "3 h")])
def test_options_of_seas_of_an_envelope_in_calm_water_are_refused(scene, commands, option, value):
    words = ["--reach", "10 m", "--current", "0 m/s", option, value]
    code, out, err = commands("envelope", scene, *words)
    assert (code, out) == (2, "")
    assert option in err
    assert "--sea" in err.replace("--seeds", "")


@pytest.mark.parametrize("command", ["operability", "tension", "modes", "viv"])
def test_a_path_that_is_set_twice_is_refused(scene, commands, command):
    """Of two values, one would have no effect."""
    words = {"operability": ["--reach", "10 m"], "tension": []}.get(command, [])
    if command == "tension":
        words = ["--units", 6, "--failed", 1, "--tension-ratio", 0.95, "--weight", 1, "--buoyancy", 1]
    path = "current.profile.surface_speed"
    code, out, err = commands(command, scene, *words, "--set", f"{path}=1 m/s", "--set", f"{path} = 2 m/s")
    assert (code, out) == (2, "")
    assert f"{path} is given twice" in err


def test_a_table_without_modes_replaces_that_of_another_current(scene, commands):
    fast = ["--set", "current.profile.surface_speed=1.5 m/s"]
    counts = []
    for words in (fast, []):
        assert commands("viv", scene, *words, "--csv", "modes.csv")[0] == 0
        counts.append(len(Path("modes.csv").read_text().splitlines()))
    assert counts[0] > 1
    assert counts[1] == 1  # the header


def test_units_that_change_no_number_are_refused(commands, tmp_path):
    hours = np.datetime64("2001-01-01T00") + np.arange(60) * np.timedelta64(1, "h")
    rows = [f"{time}:00,{1 + k % 3},{8 + k % 4}" for k, time in enumerate(hours)]
    record = tmp_path / "sea.csv"
    record.write_text("\n".join(["time,hs (m),tp (s)", *rows]))
    assert commands("downtime", record, "--limit", "hs <= 2 m")[0] == 0
    for units in ("si", "field", "us"):
        code, out, err = commands("downtime", record, "--limit", "hs <= 2 m", "--units", units)
        assert (code, out) == (2, "")
        assert "--units" in err
