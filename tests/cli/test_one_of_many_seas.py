"""Verdicts in an irregular sea say that they are those of one sea, of which they state duration and seed."""

from pathlib import Path

import pytest
from random_rigs import rig, written
from ruamel.yaml import YAML

WORDS = "other seeds and longer seas have other extremes"


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("sea", ["none", "regular", "of the riser", "of the platform"])
@pytest.mark.parametrize("seed", range(2))
def test_only_verdicts_in_an_irregular_sea_are_those_of_one_of_many(
    commands, tmp_path, monkeypatch, seed, sea, spatial
):
    monkeypatch.chdir(tmp_path)
    tree = rig(seed, spatial=spatial, conductor=False)
    storm = {"significant_height": "2 m", "peak_period": "10 s", "peak_enhancement": 2.0}
    storm |= {"components": 10, "seed": 40 + seed}
    if sea == "regular":
        tree["wave"] = {"height": "2 m", "period": "10 s", "above_mean_level": "none", "ramp": "10 s"}
    elif sea == "of the riser":
        tree["wave"] = storm | {"above_mean_level": "none", "ramp": "10 s"}
    elif sea == "of the platform":
        rows = [{"period": f"{t} s", "heave": "0.3 m/m", "heave_phase": "0 deg"} for t in (1, 60)]
        tree["platform"]["response"] = {"operators": rows, "phases": "lead", "wave": storm, "ramp": "10 s"}
    tree["analysis"] = {"duration": 20.0, "step": 0.5, "mesh": {"elements": 60}, "output": {"interval": 0.5}}
    limits = [{"output": "joint_stroke", "largest": "30 m", "mode": "drilling"}]
    with Path("rig.yaml").open("w") as file:
        YAML().dump(written(tree) | {"limits": limits}, file)
    code, out, _ = commands("check", "rig.yaml")
    assert code in (0, 4)  # some errors are large on so few segments
    found = f"one irregular sea, of 20 s with seed {40 + seed}; {WORDS}"
    assert out.count(WORDS) == out.count(found) == sea.startswith("of")
