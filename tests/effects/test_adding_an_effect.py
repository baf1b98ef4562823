"""The page on adding an effect shows what is in the project."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/adding_an_effect.md").read_text("utf-8")
NAMED = re.compile(r"`((?:src|tests)/[^`]*\.py)`")


def blocks():
    """Every block of Python, with the file that was named last before it."""
    file = None
    for before, code in re.findall(r"(.*?)```python\n(.*?)```", PAGE, re.DOTALL):
        file = NAMED.findall(before)[-1] if NAMED.search(before) else file
        yield pytest.param(file, code, id=f"{file}: {code.strip().splitlines()[0]}")


@pytest.mark.parametrize("file, code", list(blocks()))
def test_what_the_page_shows_stands_in_the_file_that_it_names(file, code):
    assert code in (ROOT / file).read_text("utf-8")


def test_an_effect_is_three_files_and_its_test():
    assert {block.values[0] for block in blocks()} == {
        "src/riserstudy/effects/guide.py",
        "src/riserstudy/scene/riser.py",
        "src/riserstudy/model/joints.py",
        "tests/effects/each/guide.py",
    }
