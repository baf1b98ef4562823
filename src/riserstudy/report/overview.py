"""The first screen: what was studied, how it came out, what was found, and where the demands are answered."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from riserstudy.report.claims import Claim, counted_verdicts
from riserstudy.report.pictures import Figure, called
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
    """What was found of one number or claim: what its figure says, and where that stands."""

    claim: Claim
    paper: str
    said: str  # "" where no figure says anything
    figure: str  # anchor, "" where none is linked
    short: str  # name of the figure


class Tile(NamedTuple):
    """The answer to one demand, and its figure's anchor."""

    demand: str
    answer: str
    figure: str


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
        "simulated anew and graded over the inputs that they do not specify.",
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
    claims: list[Claim], files: dict[str, StudyFile], figures: list[Figure]
) -> list[Finding]:
    """The number or claim that each study file names, by what a figure of it says."""
    rows = []
    for paper, file in files.items():
        for claim in (c for c in claims if c.paper == paper and c.id == file.finding):
            shown = _telling([f for f in figures if f.paper == paper and claim in f.claims])
            said = sentence(shown.picture.title) if shown and shown.picture.title else ""
            anchor, short = (shown.anchor, called(shown.name)) if shown else ("", "")
            rows.append(Finding(claim, short_of(files, paper), said, anchor, short))
    return rows


def _telling(own: list[Figure]) -> Figure | None:
    """Of a claim's figures one that says a number, of these the one that shows the fewest other claims."""
    numbers = [figure for figure in own if any(map(str.isdigit, figure.picture.title))]
    return min(reversed(numbers or own), key=lambda figure: len(figure.claims), default=None)


def tiles(figures: Iterable[Figure]) -> list[Tile]:
    """The answers that the figures of the demands carry as titles; of several sentences the first."""
    return [
        Tile(
            DEMANDS[figure.paper, figure.name],
            sentence(figure.picture.title.partition(". ")[0]),
            figure.anchor,
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
