"""Inputs of a study: also what its chapters import from beside them."""

import random
import sys

import pytest

from riserstudy.crate.metadata import inputs_of
from riserstudy.study.new import new_study


@pytest.mark.parametrize("seed", range(6))
def test_modules_that_chapters_import_are_inputs_wherever_one_works(tmp_path, seed, monkeypatch):
    draw = random.Random(seed)
    study = tmp_path / "meine Studie"
    new_study(study)
    imported = {"tools.py", "lib/a.py", "lib/deep/b.py", "lib/deep/table.csv"}
    texts = {
        "tools.py": "from lib import a\n",
        "lib/a.py": "from lib.deep.b import B\n",
        "lib/deep/b.py": 'DATA_FILES = ("table.csv",)\nB = 1\n',
        "lib/deep/table.csv": "1\n",
        "unused.py": "A = 1\n",
        "lib/unused.py": "A = 1\n",
    }
    for name, text in draw.sample(sorted(texts.items()), len(texts)):
        file = study / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    part = draw.choice(["derived", "figures", "claims"])
    with (study / f"chapters/example/{part}.py").open("a") as file:
        file.write("\nimport tools\n")
    if draw.random() < 0.5:
        monkeypatch.chdir(tmp_path)
    names = {path.relative_to(study).as_posix() for path in inputs_of(study)}
    assert names & texts.keys() == imported
    assert {"config/config.yaml", "chapters/example/derived.py"} <= names
    assert "tools" not in sys.modules  # read, and not executed
