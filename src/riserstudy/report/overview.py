"""The first screen: what was studied, how it came out, and what was found."""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.report.claims import Claim, counted_verdicts
from riserstudy.report.pictures import Figure
from riserstudy.report.wording import counted, listed, sentence
from riserstudy.study.models import StudyFile

WORDS = ("No", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine")
#: what is said of so many verdicts, singular and plural
PLURALS = {
    "reproduced": ("is reproduced", "are reproduced"),
    "calibrated": ("is met with a calibrated input", "are met with a calibrated input"),
    "holds": ("holds", "hold"),
    "depends": (
        "depends on inputs that the papers omit",
        "depend on inputs that the papers omit",
    ),
    "fails": ("fails", "fail"),
    "not comparable": (
        "is defined differently in the paper",
        "are defined differently in the papers",
    ),
    "not reproducible": ("cannot be checked", "cannot be checked"),
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
    sentences: str  # "" where no figure says anything
    figure: str  # anchor, "" where none is linked
    short: str  # name of the figure


def subject(files: dict[str, StudyFile], claims: list[Claim]) -> tuple[str, str]:
    """Title of the page, and one sentence that says what it is about.

    A paper is simulated again where its values or claims are graded: a study of one's own may have a
    reference, too.
    """
    graded = {claim.paper for claim in claims}
    papers = [paper for paper, file in files.items() if file.reference and paper in graded]
    if not papers:
        names = [file.title or paper for paper, file in files.items()]
        done = "simulated, drawn and graded" if graded else "simulated and drawn"
        return ", ".join(names), f"Parameter studies of drilling risers, {done}."
    count = WORDS[len(papers)] if len(papers) < len(WORDS) else str(len(papers))
    things = "riser paper" if len(papers) == 1 else "riser papers"
    plain = "paper" if len(papers) == 1 else "papers"
    return (
        f"{count} {things}, simulated again",
        f"riserstudy repeats the simulations of {count.lower()} published {plain} on deepwater drilling "
        "risers, and checks every published value and claim. Inputs that a paper omits are varied.",
    )


def bars(claims: list[Claim], files: dict[str, StudyFile]) -> list[Bar]:
    """One bar per paper that has numbers or claims."""
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


def totals(claims: list[Claim]) -> str:
    """How all numbers and claims came out, in one sentence; "" where none is graded."""
    if not claims:
        return ""
    parts = [
        f"{count} {PLURALS[verdict][count > 1] if verdict in PLURALS else verdict}"
        for verdict, count in counted_verdicts(claims)
    ]
    return sentence(f"Of {len(claims)} published values and claims, {listed(parts)}")


def title_of(files: dict[str, StudyFile], paper: str) -> str:
    """A chapter's name for people."""
    return (files[paper].title if paper in files else "") or paper


def short_of(files: dict[str, StudyFile], paper: str) -> str:
    """A chapter's name in tables: what stands before its colon."""
    return title_of(files, paper).partition(":")[0]


def findings(
    claims: list[Claim], files: dict[str, StudyFile], figures: list[Figure]
) -> list[Finding]:
    """The number or claim that each study file names, with what a figure of it shows."""
    rows = []
    for paper, file in files.items():
        for claim in (c for c in claims if c.paper == paper and c.id == file.finding):
            chosen = _figure_with_title(
                [f for f in figures if f.paper == paper and claim in f.claims]
            )
            sentences = sentence(chosen.picture.title) if chosen and chosen.picture.title else ""
            anchor, short = (chosen.anchor, chosen.label) if chosen else ("", "")
            rows.append(Finding(claim, short_of(files, paper), sentences, anchor, short))
    return rows


def _figure_with_title(own: list[Figure]) -> Figure | None:
    """Of a claim's figures one that says a number, of these the one that shows the fewest other claims."""
    numbers = [figure for figure in own if any(map(str.isdigit, figure.picture.title))]
    return min(reversed(numbers or own), key=lambda figure: len(figure.claims), default=None)


def amounts(claims: list[Claim], datasets: int, figures: int, points: int) -> str:
    """How much there is, in one line."""
    things = [
        counted(len(claims), "published value or claim").replace(
            "value or claims", "values and claims"
        ),
        counted(figures, "figure"),
        counted(datasets, "dataset"),
        counted(points, "grid point"),
    ]
    return ", ".join(things)
