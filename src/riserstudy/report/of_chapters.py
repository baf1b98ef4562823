"""Additions of chapters to the report by their own functions: tiles of the first screen, and sections."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from riserstudy.chapters import function_of
from riserstudy.records.page import Section, Tile
from riserstudy.records.words import sentence
from riserstudy.report.pictures import Figure

if TYPE_CHECKING:
    import xarray as xr

Datasets = Mapping[str, "xr.Dataset"]  # of a chapter, by name; opened, but not loaded


def tiles_of(paper: str, datasets: Datasets, figures: Iterable[Figure]) -> list[Tile]:
    """Return the tiles of a chapter whose figures are drawn, each with the anchor of its figure.

    A tile without an answer has the title of its figure instead.
    """
    drawn = {figure.name: figure for figure in figures if figure.paper == paper}
    made: list[Tile] = (_function(paper, "tiles") or _nothing)(datasets) or []
    return [
        tile._replace(
            figure=drawn[tile.figure].anchor, answer=tile.answer or sentence(drawn[tile.figure].picture.title)
        )
        for tile in made
        if tile.figure in drawn
    ]


def section_of(paper: str, datasets: Datasets) -> Section | None:
    """Return the section of a chapter; None if it has none."""
    made: Section | None = (_function(paper, "section") or _nothing)(datasets)
    return made


def _function(paper: str, name: str) -> Callable[[Datasets], Any] | None:
    try:
        return function_of(paper, "report", name)
    except LookupError:
        return None


def _nothing(_: Datasets) -> None:
    """Return None: the addition of a chapter without such a function."""
