"""Printed numbers stand in config/published alone: figures, derived datasets and checks are told them."""

import ast
import inspect
from pathlib import Path

import pytest

from riserstudy.chapters import function_of
from riserstudy.errors import InputError
from riserstudy.grading.printed import with_printed
from riserstudy.grading.published import printed_of
from riserstudy.study.read import read_studies

CONFIG = Path(__file__).parents[2] / "config"
PAPERS = ["chang2020", "fem_riser", "liu2017", "liu2020", "mao_hangoff"]
COMMON = {50.0, 52.0, 0.3, 0.5}  # numbers so plain that they mean other things, too


def told(paper, settings):
    return with_printed(settings, CONFIG, paper)


@pytest.mark.parametrize("paper", PAPERS)
def test_figures_and_derived_datasets_take_what_they_are_told(paper):
    studies = read_studies(CONFIG, paper)
    for part, models in (("figures", studies.figures), ("derived", studies.derived)):
        for name, model in models.items():
            if part == "figures" and model.plot:
                continue
            signature = inspect.signature(function_of(paper, part, name))
            given = told(paper, model.settings) if model.settings else {}
            signature.bind(**dict.fromkeys(model.reads), **given)


@pytest.mark.parametrize("paper", PAPERS)
def test_no_source_of_a_chapter_repeats_a_printed_number(paper):
    numbers = {item.published for item in printed_of(CONFIG, paper).items} - {None} - COMMON
    repeated = [
        f"{path.name}:{node.lineno}: {node.value}"
        for path in (CONFIG.parent / "chapters" / paper).rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Constant) and isinstance(node.value, int | float) and node.value in numbers
    ]
    assert repeated == []


def test_a_number_that_is_not_printed_is_refused():
    with pytest.raises(InputError, match="no number 'N9'; use one of N1, N2, N3"):
        told("mao_hangoff", {"heavy": {"printed": "N9"}})


def test_what_names_no_number_stays_as_it_is():
    settings = {"times": ["15 s"], "share": {"assumed": 0.1, "range": [0, 1], "because": "it is"}}
    assert told("mao_hangoff", settings) == settings
