"""Additions of a chapter to the page of the report: tiles of the first screen, and a section."""

from __future__ import annotations

from typing import NamedTuple


class Tile(NamedTuple):
    """The answer to one question: in large type, in one line, and as a small picture.

    ``figure``: the figure that shows it; without a figure there is no tile. Without an answer, the tile has
    the title of the figure.
    """

    figure: str
    question: str
    number: str = ""
    answer: str = ""
    spark: str = ""  # markup: an SVG of the class `spark`, bars `ranked`, and words `under` it


class Cell(NamedTuple):
    """Text of a cell, and the number for sorting."""

    text: str
    order: float | None = None


class Table(NamedTuple):
    """A table: its title, the meaning of a row, its columns, the columns with numbers, and its rows.

    ``folded``: hidden until the reader opens it, and then sortable.
    """

    title: str
    about: str
    columns: list[str]
    numbers: set[int]
    rows: list[list[Cell]]
    folded: bool = True


class Section(NamedTuple):
    """Statements of a chapter about its datasets: sentences, then tables."""

    sentences: list[str]
    tables: list[Table]
