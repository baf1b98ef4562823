"""What papers need of their own: a folder a paper, with derived datasets, figures and claims.

A part of a chapter is a file or a folder of files; what a study file names is a function in it. A folder
of one's own study may hold such a folder ``chapters``, too. Its parts:

- ``derived``: datasets made from others;
- ``figures``;
- ``claims``: checks of what a paper prints;
- ``measured``, with ``models``: datasets that code of the chapter makes without any grid;
- ``report``: ``tiles`` and ``section``, what the chapter adds to the report.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from riserstudy.digests import defining
from riserstudy.folders import chapter_modules, import_of_chapter

if TYPE_CHECKING:
    from collections.abc import Callable


def function_of(paper: str, part: str, name: str) -> Callable[..., Any]:
    """The function of a chapter that has a name.

    Raises
    ------
    LookupError
        When there is none.
    """
    module = defining(chapter_modules(paper, part), name)
    if module is None:
        raise LookupError(f"{paper}: its {part} define no function {name}")
    function: Callable[..., Any] = getattr(import_of_chapter(module), name)
    return function


def checks_of(paper: str) -> Callable[[str], Callable[..., Any]]:
    """What finds the functions that a paper's numbers and claims are checked by."""
    return partial(function_of, paper, "claims")
