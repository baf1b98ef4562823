"""What a chapter adds to the report by functions of its own."""

import sys
from types import SimpleNamespace

import pytest

from riserstudy.report.of_chapters import section_of, tiles_of

REPORT = """
from riserstudy.records.page import Cell, Section, Table, Tile

def tiles(datasets):
    number = str(datasets["counts"])
    return [
        Tile("swing", "How far?", number, "metres."),
        Tile("lift", "How high?"),
        Tile("absent", "Who sees this?", number),
    ]

def section(datasets):
    return Section([f"Counted: {sum(datasets.values())}."], [])
"""


@pytest.fixture
def chapter(tmp_path, monkeypatch):
    """Where one works, with a chapter that adds to the report, and one that does not."""
    for paper, text in (("told", REPORT), ("silent", "def other(): ...\n")):
        (tmp_path / "chapters" / paper).mkdir(parents=True)
        (tmp_path / "chapters" / paper / "report.py").write_text(text)
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    yield
    for name in ("told", "silent"):
        for module in (f"chapters.{name}", f"chapters.{name}.report"):
            sys.modules.pop(module, None)


def figure(paper, name, title=""):
    picture = SimpleNamespace(title=title)
    return SimpleNamespace(paper=paper, name=name, picture=picture, anchor=f"{paper}-{name}")


@pytest.mark.usefixtures("chapter")
def test_tiles_are_of_figures_that_are_drawn_and_link_to_them():
    drawn = [figure("told", "lift", "it rises by 2 m"), figure("told", "swing")]
    drawn += [figure("silent", "absent")]  # of another chapter
    found = {tile.figure: tile for tile in tiles_of("told", {"counts": 7}, drawn)}
    assert {*found} == {"told-swing", "told-lift"}
    assert found["told-swing"][1:4] == ("How far?", "7", "metres.")


@pytest.mark.usefixtures("chapter")
def test_a_tile_without_an_answer_has_the_title_of_its_figure():
    (tile,) = tiles_of("told", {"counts": 7}, [figure("told", "lift", "it rises by 2 m")])
    assert (tile.number, tile.answer) == ("", "It rises by 2 m.")


@pytest.mark.usefixtures("chapter")
def test_a_section_is_of_the_datasets_of_its_chapter():
    assert section_of("told", {"a": 2, "b": 5}).sentences == ["Counted: 7."]


@pytest.mark.usefixtures("chapter")
@pytest.mark.parametrize("paper", ["silent", "no chapter at all"])
def test_a_chapter_without_such_functions_adds_nothing(paper):
    assert tiles_of(paper, {}, [figure(paper, "swing")]) == []
    assert section_of(paper, {}) is None
