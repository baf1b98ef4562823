"""Chapters: code for one paper or study, in one folder each, with derived datasets, figures and claims.

A part of a chapter is a file or a folder of files; the names in a study file are functions in it. The folder
of a user's own study may contain such a folder ``chapters``, too. Its parts:

- ``derived``: datasets made from others;
- ``figures``;
- ``claims``: checks of what a paper prints;
- ``measured``, with ``models``: datasets that code of the chapter makes without a grid;
- ``report``: ``tiles`` and ``section``, the chapter's additions to the report.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from riserstudy.files.chapters import chapter_modules, import_of_chapter
from riserstudy.files.digests import defining


def function_of(paper: str, part: str, name: str) -> Callable[..., Any]:
    """Return the function of a chapter by its name. Raises LookupError when it does not exist."""
    module = defining(chapter_modules(paper, part), name)
    if module is None:
        raise LookupError(f"{paper}: its {part} define no function {name}")
    function: Callable[..., Any] = getattr(import_of_chapter(module), name)
    return function


def checks_of(paper: str) -> Callable[[str], Callable[..., Any]]:
    """Return a function that finds, by name, the checks of a paper's numbers and claims."""
    return partial(function_of, paper, "claims")
