"""What a chapter adds to the page of the report: tiles of the first screen, and a section of its own."""

from __future__ import annotations

from typing import NamedTuple


class Tile(NamedTuple):
    """The answer to one question: in large type, in a line, and as a small picture.

    ``figure``: the figure that shows it; without it there is no tile. Without an answer the title of the
    figure stands there.
    """

    figure: str
    question: str
    number: str = ""
    answer: str = ""
    spark: str = ""  # markup: an SVG of the class `spark`, bars `ranked`, and words `under` it


class Cell(NamedTuple):
    """What a cell states, and the number that it sorts by."""

    text: str
    order: float | None = None


class Table(NamedTuple):
    """A table: its title, what a row is, its columns, which of them are numbers, and its rows.

    ``folded``: shown when it is asked for, and then sortable.
    """

    title: str
    about: str
    columns: list[str]
    numbers: set[int]
    rows: list[list[Cell]]
    folded: bool = True


class Section(NamedTuple):
    """What a chapter states of its datasets: sentences, then tables."""

    sentences: list[str]
    tables: list[Table]
