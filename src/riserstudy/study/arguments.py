"""Check of the arguments that study and published files give to functions of a chapter."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from riserstudy.errors import InputError
from riserstudy.files.chapters import chapter_modules
from riserstudy.files.digests import arguments_of


def refuse_arguments(
    path: Path, field: str, paper: str, part: str, function: str, given: Iterable[str]
) -> None:
    """Refuse unknown or missing arguments of a chapter's function, before it runs.

    Raises InputError with the file ``path`` and its ``field``.
    """
    needed, taken = arguments_of(chapter_modules(paper, part), function)
    names = {*given}
    if unknown := sorted(names - taken if taken is not None else ()):
        allowed = "use only " + ", ".join(sorted(taken or ()))
        found = f"the function {function} has no argument {unknown[0]!r}"
        raise InputError(path, field, found, allowed)
    if missing := sorted(needed - names):
        allowed = "add it to `reads` or `with`"
        found = f"the function {function} requires the argument {missing[0]!r}"
        raise InputError(path, field, found, allowed)
