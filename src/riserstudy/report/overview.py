"""The first screen: subject, verdicts and findings."""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.records.numerals import spaced
from riserstudy.records.words import sentence
from riserstudy.report.claims import Claim, counted_verdicts
from riserstudy.report.formats import counted
from riserstudy.report.pictures import Figure
from riserstudy.study.models import StudyFile

WORDS = ("No", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine")


class Bar(NamedTuple):
    """Verdicts about a paper as parts of a bar."""

    paper: str
    title: str
    short: str
    parts: list[tuple[str, int]]

    @property
    def total(self) -> int:
        """Number of all numbers and claims."""
        return sum(count for _, count in self.parts)


class Finding(NamedTuple):
    """Finding about one number or claim: the words of its figure, and the anchor of the figure."""

    claim: Claim
    paper: str
    sentences: str  # "" if no figure has words
    figure: str  # anchor, "" if no figure is linked
    short: str  # name of the figure


def subject(files: dict[str, StudyFile], claims: list[Claim]) -> tuple[str, str]:
    """Return the title of the page, and one sentence about its subject.

    A chapter counts as a reproduced paper if its values or claims are graded: a user's own study may have a
    reference, too.
    """
    graded = {claim.paper for claim in claims}
    papers = [paper for paper, file in files.items() if file.reference and paper in graded]
    if not papers:
        names = [file.title or paper for paper, file in files.items()]
        done = "simulated, drawn and graded" if graded else "simulated and drawn"
        return ", ".join(names), f"Parameter studies of drilling risers, {done}."
    count = WORDS[len(papers)] if len(papers) < len(WORDS) else str(len(papers))
    plain = "paper" if len(papers) == 1 else "papers"
    return (
        f"{count} {plain} on drilling risers, simulated again",
        "riserstudy is a simulation program for drilling risers, the pipes between a floating platform and a "
        "well on the seabed. This report contains simulations of "
        f"{count.lower()} published {plain}, and a check of every published value and claim. "
        "Inputs that a paper omits are assumed, and varied in random samples.",
    )


def bars(claims: list[Claim], files: dict[str, StudyFile]) -> list[Bar]:
    """Return one bar per paper that has numbers or claims."""
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
    """Return the title of a chapter."""
    return (files[paper].title if paper in files else "") or paper


def short_of(files: dict[str, StudyFile], paper: str) -> str:
    """Return the short name of a chapter for tables: as its file gives it, else its title."""
    return (files[paper].short if paper in files else "") or title_of(files, paper)


def findings(claims: list[Claim], files: dict[str, StudyFile], figures: list[Figure]) -> list[Finding]:
    """Return the number or claim that each study file selects, with the words of one of its figures."""
    rows = []
    for paper, file in files.items():
        for claim in (c for c in claims if c.paper == paper and c.id == file.finding):
            chosen = _figure_with_title([f for f in figures if f.paper == paper and claim in f.claims])
            sentences = sentence(chosen.picture.title) if chosen and chosen.picture.title else ""
            anchor, short = (chosen.anchor, chosen.label) if chosen else ("", "")
            rows.append(Finding(claim, short_of(files, paper), sentences, anchor, short))
    return rows


def _figure_with_title(own: list[Figure]) -> Figure | None:
    """Return a claim's figure, if possible with a number in its title; of several, with fewest claims."""
    numbers = [figure for figure in own if any(map(str.isdigit, figure.picture.title))]
    return min(reversed(numbers or own), key=lambda figure: len(figure.claims), default=None)


def amounts(claims: list[Claim], datasets: int, figures: int, points: int) -> str:
    """Return the amounts of claims, datasets, figures and points in one line."""
    several = f"{spaced(len(claims))} published values and claims"
    things = [
        "1 published value or claim" if len(claims) == 1 else several,
        counted(figures, "figure"),
        counted(datasets, "dataset"),
        counted(points, "grid point"),
    ]
    return ", ".join(things)
