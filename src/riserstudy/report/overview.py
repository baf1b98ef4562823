"""The first screen: what was studied, how it came out, what was found, and where the demands are answered."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from riserstudy.report.claims import Claim, counted_verdicts
from riserstudy.report.pictures import SMALL, Figure, Picture, picture_of
from riserstudy.report.wording import counted, sentence
from riserstudy.study.models import StudyFile

WORDS = ("No", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine")
#: figures that answer what is asked of an engine: chapter and name, and the demand
DEMANDS = {
    ("numerics", "cost"): "What accuracy costs",
    ("numerics", "stability"): "What stays stable",
    ("numerics", "effects"): "Only the effects called for",
}


class Bar(NamedTuple):
    """Verdicts of a paper as parts of a bar."""

    paper: str
    title: str
    short: str
    parts: list[tuple[str, int]]

    @property
    def total(self) -> int:
        """Numbers and claims in all."""
        return sum(count for _, count in self.parts)


class Finding(NamedTuple):
    """One claim in words with its figure."""

    claim: Claim
    title: str
    figure: str  # anchor, "" where none is linked
    picture: Picture | None


class Tile(NamedTuple):
    """The answer to one demand, with its figure."""

    demand: str
    answer: str
    figure: str
    picture: Picture


def subject(files: dict[str, StudyFile]) -> tuple[str, str]:
    """Title of the page, and one sentence that says what it is about."""
    papers = [file for file in files.values() if file.reference]
    if not papers:
        names = [file.title or paper for paper, file in files.items()]
        return ", ".join(names), "Parameter studies of drilling risers: simulated, drawn, graded."
    count = WORDS[len(papers)] if len(papers) < len(WORDS) else str(len(papers))
    things = "riser paper" if len(papers) == 1 else "riser papers"
    plain = "paper" if len(papers) == 1 else "papers"
    return (
        f"{count} {things}, simulated again",
        f"{count} published {plain} on deepwater drilling risers: every printed number, claim and figure, "
        "simulated anew and graded over what the papers leave unspecified.",
    )


def bars(claims: list[Claim], files: dict[str, StudyFile]) -> list[Bar]:
    """A bar a paper that has numbers or claims."""
    papers = dict.fromkeys(claim.paper for claim in claims)
    return [
        Bar(
            paper,
            title_of(files, paper),
            short_of(files, paper),
            counted_verdicts([c for c in claims if c.paper == paper]),
        )
        for paper in papers
    ]


def title_of(files: dict[str, StudyFile], paper: str) -> str:
    """A chapter's name for people."""
    return (files[paper].title if paper in files else "") or paper


def short_of(files: dict[str, StudyFile], paper: str) -> str:
    """A chapter's name in tables: what stands before its colon."""
    return title_of(files, paper).partition(":")[0]


def findings(
    claims: list[Claim], files: dict[str, StudyFile], figures: list[Figure], images: dict[str, Path]
) -> list[Finding]:
    """The number or claim that each study file names first, with the last of its figures.

    Those that the paper does not print come last, and show the claim itself.
    """
    rows = []
    for paper, file in files.items():
        for claim in (c for c in claims if c.paper == paper and c.id == file.finding):
            own = [f for f in figures if f.paper == paper and claim in f.claims]
            shown = own[-1] if own else None
            small = picture_of(images[shown.anchor], SMALL) if shown else None
            rows.append(
                Finding(claim, title_of(files, paper), shown.anchor if shown else "", small)
            )
    return rows


def tiles(figures: Iterable[Figure], images: dict[str, Path]) -> list[Tile]:
    """The answers that the figures of the demands carry as titles."""
    return [
        Tile(
            DEMANDS[figure.paper, figure.name],
            sentence(figure.picture.title),
            figure.anchor,
            picture_of(images[figure.anchor], SMALL),
        )
        for figure in figures
        if (figure.paper, figure.name) in DEMANDS
    ]


def amounts(claims: list[Claim], datasets: int, figures: int, points: int) -> str:
    """How much there is, in one line."""
    things = [
        counted(len(claims), "number and claim").replace("number and claims", "numbers and claims"),
        counted(figures, "figure"),
        counted(datasets, "dataset"),
        counted(points, "grid point"),
    ]
    return ", ".join(things)
