"""config/published/<paper>.yaml, read and checked against datasets and functions of a chapter."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, partial
from pathlib import Path
from typing import Any

from riserstudy.errors import InputError
from riserstudy.files.chapters import chapter_modules
from riserstudy.files.digests import defining
from riserstudy.grading.models import Checked, Option, PrintedNumber, PublishedFile, WordName
from riserstudy.grading.words_of_size_file import WordsFile, read_words
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.validate import check, refuse_other_paper
from riserstudy.study.arguments import refuse_arguments


def published_path(config: Path, paper: str) -> Path:
    """The published file of a paper."""
    return config / "published" / f"{paper}.yaml"


def printed_of(config: Path, paper: str) -> PublishedFile:
    """The published values and claims of a paper.

    Raises InputError when its file is invalid, or names a word that is not in the table of words.
    """
    path = published_path(config, paper)
    file = check(PublishedFile, read_yaml(path, keep=True), path)
    refuse_other_paper(file.paper, path)
    _look_up_words(file, config)
    return file


def _look_up_words(file: PublishedFile, config: Path) -> None:
    """Replace names of words by their bounds."""
    words = cache(partial(read_words, config))
    for entry in (*file.items, *file.errata):
        entry.options.update(looked_up(entry.options, file, words))


def looked_up(
    options: Mapping[str, Option], file: PublishedFile, words: Callable[[], WordsFile]
) -> dict[str, Option]:
    """Options with published values and bounds in place of their names; ``words`` reads the table of words.

    Raises InputError when the table of words has no such word. Raises ValueError when the paper has no such
    published value.
    """
    found: dict[str, Option] = {}
    for name, option in options.items():
        if isinstance(option, WordName):
            option = words().word(option.word)
        elif isinstance(option, PrintedNumber):
            option = file.number(option.printed)
        found[name] = option
    return found


def read_published(config: Path, paper: str, known: Any) -> PublishedFile:
    """The checked file of a paper.

    Raises InputError when it is invalid, or needs a dataset that is not ``known``.
    """
    path = published_path(config, paper)
    file = printed_of(config, paper)
    for name in file.datasets:
        if name not in known:
            allowed = "use one of " + ", ".join(sorted(known))
            raise InputError(path, "reads", f"the study file has no dataset {name!r}", allowed)
    for entry in (*file.items, *file.errata):
        refuse_check(path, paper, entry)
    return file


def refuse_check(path: Path, paper: str, entry: Checked) -> None:
    """Refuse a check that the paper's chapter does not define, or that has other arguments.

    Raises InputError with the file ``path``.
    """
    if not entry.check:
        return
    if defining(chapter_modules(paper, "claims"), entry.check) is None:
        found = f"chapters/{paper}/claims.py defines no function {entry.check!r}"
        allowed = "define the function, or state with `impossible` why nothing is compared"
        raise InputError(path, "check", found, allowed)
    given = [*entry.reads, *entry.options]
    refuse_arguments(path, f"{entry.id}.with", paper, "claims", entry.check, given)
