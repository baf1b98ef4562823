"""Names, units and labels that a chapter gives its own variables and axes, in a file of its folder."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Annotated

from pydantic import Field, RootModel

from riserstudy.dataset.unit_names import UnitName
from riserstudy.errors import InputError
from riserstudy.files.chapters import variables_of_chapter
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.strict import Strict
from riserstudy.inputs.validate import check

Text = Annotated[str, Field(min_length=1)]
Table = dict[str, dict[str, str]]


class _About(Strict):
    """CF attributes of a variable; ``label`` is what axes of figures say in place of the long name."""

    long_name: Text
    units: UnitName | None = None
    label: Text | None = None
    comment: Text | None = None
    standard_name: Text | None = None
    positive: Text | None = None


class _Variables(RootModel[dict[str, _About]]):
    """The variables of a chapter, by name."""


def chapter_table(paper: str) -> Table:
    """CF attributes of the variables that a chapter of the folder where one works names, if it names any.

    Raises InputError when the file is no table of names with their attributes.
    """
    file = variables_of_chapter(paper)
    return _read(file.absolute()) if file.exists() else {}


@cache
def _read(file: Path) -> Table:
    found = check(_Variables, read_yaml(file, keep=True) or {}, file)
    return {name: about.model_dump(exclude_none=True) for name, about in found.root.items()}


def joined_tables(papers: list[str], known: Table) -> Table:
    """The variables of some chapters.

    ``known``: those that the package names. Raises InputError when a name has other attributes elsewhere:
    file and name.
    """
    joined: Table = {}
    for paper in papers:
        for name, about in chapter_table(paper).items():
            if (elsewhere := joined.get(name) or known.get(name, about)) != about:
                found = f"this variable is also defined elsewhere, as {elsewhere['long_name']!r}"
                raise InputError(variables_of_chapter(paper), name, found, "give it another name")
            joined[name] = about
    return joined
