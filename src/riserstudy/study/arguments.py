"""Check of the arguments that study and published files give to functions of a chapter."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from riserstudy.digests import arguments_of
from riserstudy.errors import InputError
from riserstudy.folders import chapter_modules


def refuse_arguments(
    path: Path, field: str, paper: str, part: str, function: str, given: Iterable[str]
) -> None:
    """Refuse unknown or missing arguments of a chapter's function, before it runs.

    Raises InputError with the file ``path`` and its ``field``.
    """
    needed, taken = arguments_of(chapter_modules(paper, part), function)
    names = {*given}
    if unknown := sorted(names - taken if taken is not None else ()):
        allowed = "allowed are " + ", ".join(sorted(taken or ()))
        raise InputError(path, field, f"{function} has no argument {unknown[0]!r}", allowed)
    if missing := sorted(needed - names):
        allowed = "name it in `reads` or `with`"
        raise InputError(path, field, f"{function} needs {missing[0]!r}", allowed)
