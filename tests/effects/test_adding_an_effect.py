"""The page on adding an effect, followed to the letter in a copy of the project."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs/adding_an_effect.md"
STEP = re.compile(r"```python\n(.*?)```", re.DOTALL)


def follow(page, folder):
    """Make the new files and insert the lines that the page gives."""
    file = None
    texts = STEP.split(page)
    for before, code in zip(texts[::2], texts[1::2], strict=False):
        text = before.strip().split("\n\n")[-1]
        named = re.findall(r"`((?:src|tests)/[^`]*\.py)`", text)
        file = folder / named[-1] if named else file
        if "new file" in text:
            file.write_text(code)
            continue
        where, line = re.findall(r"(above|below) `([^`]+)`", text)[-1]
        content = file.read_text()
        assert content.count(f"{line}\n") == 1, line
        added = code + line + "\n" if where == "above" else line + "\n" + code
        file.write_text(content.replace(f"{line}\n", added))


@pytest.mark.slow
def test_the_page_on_adding_an_effect_works_as_written(tmp_path):
    for part in ("src", "tests", "pyproject.toml", "workflow"):
        copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy
        copy(ROOT / part, tmp_path / part)
    follow(PAGE.read_text("utf-8"), tmp_path)
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "tests/effects",
            "tests/verification",
            "-k",
            "guide or Guide",
        ],
        cwd=tmp_path,
        env=os.environ
        | {"PYTHONPATH": str(tmp_path / "src"), "RISERSTUDY_CACHE": str(tmp_path / ".cache")},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
    passed = int(re.search(r"(\d+) passed", done.stdout)[1])
    assert passed > 5
