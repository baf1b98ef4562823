"""Where file names are read as ASCII, a dataset below a folder with other letters is refused before a run."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from riserstudy.files.letters import fault_of_letters

SCENE = Path(__file__).parents[2] / "config/scenes/design/riser.yaml"
ASCII = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
LETTERS = ["Ölfeld", "油田", "champ pétrolier"]


def said(folder, *words):
    """Exit status and messages of a command in a folder.

    Without ``site``, Python also starts where the folder of the environment itself has other letters.
    """
    command = [sys.executable, "-S", "-c", "from riserstudy.cli import main; main()", *map(str, words)]
    environment = os.environ | ASCII | {"PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, check=False, timeout=120)
    return done.returncode, done.stderr.decode(errors="replace")


@pytest.mark.long
@pytest.mark.parametrize("letters", LETTERS)
def test_a_dataset_in_a_folder_of_other_letters_is_refused_in_one_line(tmp_path, letters):
    folder = tmp_path / letters
    folder.mkdir()
    for place in (tmp_path, folder):
        (place / "riser.yaml").write_text(SCENE.read_text("utf-8"), "utf-8")
    (folder / "old.nc").write_bytes(b"\x89HDF\r\n\x1a\n")
    for words in (
        ("run", "riser.yaml", "-o", "out.nc"),
        ("run", tmp_path / "riser.yaml", "-o", folder / "out.nc"),
        ("plot", "old.nc", "--kind", "range", "-o", "x.png"),
        ("table", folder / "old.nc", "-o", tmp_path / "x.csv"),
    ):
        status, lines = said(folder, *words)
        assert status == 2, lines
        assert "PYTHONUTF8=1" in lines
        assert lines.count("\n") == 1
    assert sorted(path.name for path in folder.iterdir()) == ["old.nc", "riser.yaml"]


@pytest.mark.parametrize("letters", ["plain", *LETTERS])
def test_only_letters_that_an_encoding_lacks_are_refused(letters):
    path = Path("/tmp") / letters / "out.nc"
    assert fault_of_letters(path, "utf-8") is None
    assert (fault_of_letters(path, "ascii") is None) == letters.isascii()
    assert fault_of_letters(Path("/tmp") / "\udcff" / "out.nc", "utf-8") is not None
