"""Names of files that are no text are refused before any run; no encoding of the output stops a command."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from random_rigs import rig, written

ODD = os.fsdecode(b"a\xff\xfe")
COMMANDS = {
    "run": ["run", "SCENE", "-o", "out.nc"],
    "csv": ["run", "SCENE", "-o", "out.csv"],
    "check": ["check", "SCENE"],
    "draw": ["draw", "SCENE", "-o", "out.png"],
    "export": ["export", "SCENE", "-o", "out.yml"],
    "workbook": ["table", "SCENE", "-o", "out.xlsx"],
    "effects": ["effects", "SCENE"],
    "output": ["run", "scene.yaml", "-o", f"{ODD}.nc"],
    "figure": ["draw", "scene.yaml", "-o", f"{ODD}.svg"],
    "other": ["compare", "run.nc", f"{ODD}.csv", "-o", "out.png"],
    "dataset": ["plot", f"{ODD}.nc", "-o", "out.png"],
}


@pytest.mark.parametrize("name", COMMANDS)
def test_a_name_that_is_no_text_is_refused_and_nothing_written(name, commands, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    tree = written(rig(4)) | {"limits": [{"output": "lfj_angle", "largest": "4 deg", "mode": "drilling"}]}
    Path("scene.yaml").write_text(yaml.safe_dump(tree), "utf-8")
    try:
        shutil.copy("scene.yaml", f"{ODD}.yaml")
    except OSError:
        pytest.skip("this file system refuses such a name itself")
    if name == "other":
        assert commands("run", "scene.yaml", "-o", "run.nc")[0] == 0
    before = sorted(Path().iterdir())
    status, _, said = commands(*(f"{ODD}.yaml" if part == "SCENE" else part for part in COMMANDS[name]))
    assert (status, said.count("\n")) == (2, 1)
    assert said.isascii()
    assert sorted(Path().iterdir()) == before


@pytest.mark.long
@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
@pytest.mark.parametrize("command", ["downtime", "statistics", "viv"])
def test_help_is_printed_in_any_encoding(command, encoding):
    done = subprocess.run(
        [sys.executable, "-c", "from riserstudy.cli import main; main()", command, "--help"],
        env=os.environ | {"PYTHONIOENCODING": encoding},
        capture_output=True,
    )
    assert done.returncode == 0, done.stderr
    assert b"Usage" in done.stdout
