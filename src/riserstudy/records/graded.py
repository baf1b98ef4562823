"""How a printed number or claim came out, and the grounds of its verdict; the grounds travel as JSON."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

from pydantic import ConfigDict, TypeAdapter

Kind = Literal["number", "claim"]
Verdict = Literal[
    "reproduced", "calibrated", "holds", "fails", "depends", "not comparable", "not reproducible"
]
#: why a verdict depends: on open inputs, on a base case that is none of the many, on too few samples, or on
#: what cases would say in which nothing is found
Because = Literal["inputs", "base case", "too few samples", "missing values"]
Place = dict[str, Any]  # value by axis
#: what almost all samples of an interpretation say; of a number, whether it is met
ReadingAnswer = Literal["true", "no difference", "false", "depends"]


class Travelling:
    """Part of what travels as JSON, where what is no finite number is a string."""

    __pydantic_config__: ClassVar = ConfigDict(ser_json_inf_nan="strings", extra="forbid")


@dataclass(frozen=True)
class Case:
    """One line of margins.csv: one case of a number or claim; the fields are its columns.

    Attributes
    ----------
    place : its sample and its cell on the axes that are judged, by axis.
    base, judged : whether it is the base case, and whether it counts in the share.
    met : whether the number is met, or the claim true; None where nothing is found, which is never judged.
    same : whether a claim is not true because what it compares does not differ.
    margin : how far it is from where that would turn, -1 to 1; None where that is not known.
    calibrated : whether a value fitted to a printed number is behind it.
    rests_on : simulated studies (paper/name) with the axes by whose values, those of ``place``, its points
        are picked; all points of a study without axes.
    """

    paper: str
    id: str
    place: Place
    base: bool
    judged: bool
    met: bool | None
    same: bool
    margin: float | None
    calibrated: bool
    rests_on: dict[str, list[str]]


@dataclass(frozen=True)
class Share(Travelling):
    """How many samples meet a number or claim, counted in every cell that they are judged in.

    ``same``: of the samples, those in which what a claim compares does not differ.
    ``draws``: of what is open, without cells; None where all combinations of readings are judged.
    ``low``, ``high``: 95 % interval of the share, 0 to 1; None where draws are few, or none are.
    """

    met: int
    samples: int
    draws: int | None = None
    low: float | None = None
    high: float | None = None
    same: int = 0


@dataclass(frozen=True)
class Reading(Travelling):
    """What is found with one interpretation, at its place on the axes of interpretations.

    ``share``: of its samples. ``decided_by``: names of inputs, where it depends on these.
    """

    place: Place
    answer: ReadingAnswer
    share: Share
    decided_by: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Meaning(Travelling):
    """A word of size in a claim: its bound, an upper one (``most``) or a lower one, and its dead band."""

    word: str
    bound: float
    most: bool
    band: float


@dataclass(frozen=True)
class Influence(Travelling):
    """An input that decides.

    Attributes
    ----------
    input : its path in a scene, or the name of its axis or readings.
    name : what a paper's file or the house calls it.
    total_effect : share of the variance that remains when all others are known, over a grid; else None.
    by_option : share of the samples that meet it under each option, as scenes write them; empty for ranges.
    """

    input: str
    name: str
    total_effect: float | None = None
    by_option: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Outcome(Travelling):
    """What the base case or a further case finds; ``low`` and ``high`` are one value where it has one cell.

    ``share``, ``decided_by`` (names of inputs): of a case of many cells. ``readings``: as of ``Grounds``,
    in place of these. ``same``: as of a ``Case``.
    """

    name: str
    low: float
    high: float
    met: bool
    share: Share | None = None
    decided_by: list[str] = field(default_factory=list)
    same: bool = False
    readings: list[Reading] = field(default_factory=list)


@dataclass(frozen=True)
class Premise(Travelling):
    """In how many of the samples what a claim takes for granted is so: these are judged."""

    judged: int
    samples: int


@dataclass(frozen=True)
class Missing(Travelling):
    """In how many of the cases nothing is found, so that they are left out."""

    cases: int
    of: int


@dataclass(frozen=True)
class Together(Travelling):
    """IDs of numbers that are judged with one, in the same case; how often it is met alone."""

    others: list[str]
    alone: Share


@dataclass(frozen=True)
class Chosen(Travelling):
    """What of the base case was chosen because it gives this; whether samples vary it."""

    what: str
    varied: bool


@dataclass(frozen=True)
class Settled(Travelling):
    """After how many samples the verdict was certain, None where all leave it open; at which confidence."""

    after: int | None
    samples: int
    confidence: float


@dataclass(frozen=True)
class Grounds(Travelling):
    """What a verdict rests on.

    Attributes
    ----------
    impossible : why nothing is compared; "" where something is.
    not_comparable : how what is published is defined otherwise than what is computed; "" where it is not.
    within : share of the printed value to which it is to be met, where that is stricter than 1 %.
    words : words of size that a claim is judged by.
    share : of the samples that meet it, with the interpretation of the base case where there are several;
        None where nothing is sampled, or the base case is of none.
    readings : what is found with each interpretation; empty where there is one only.
    because : why it depends; None where it does not.
    decided_by : the inputs that decide, the most important first.
    explained : share of the variance that these explain together, 0 where none stands out from chance;
        None where that was not asked, or where inputs have total effects.
    premise, settled : None where there is no premise, and where samples are few.
    missing : None where something is found in every case.
    together : None where it is judged alone. chosen : None where nothing was chosen by it.
    outcomes : of the base case, where it is told, and of further cases.
    note : of the paper's file.
    """

    impossible: str = ""
    not_comparable: str = ""
    within: float | None = None
    words: list[Meaning] = field(default_factory=list)
    share: Share | None = None
    readings: list[Reading] = field(default_factory=list)
    because: Because | None = None
    decided_by: list[Influence] = field(default_factory=list)
    explained: float | None = None
    premise: Premise | None = None
    missing: Missing | None = None
    together: Together | None = None
    chosen: Chosen | None = None
    settled: Settled | None = None
    outcomes: list[Outcome] = field(default_factory=list)
    note: str = ""

    def to_json(self) -> str:
        """As the cell of a table; what is no finite number as a string."""
        return _GROUNDS.dump_json(self).decode()

    @classmethod
    def from_json(cls, text: str | bytes) -> Grounds:
        """Of such a cell.

        Raises
        ------
        ValueError
            When it is none.
        """
        return _GROUNDS.validate_json(text)


@dataclass(frozen=True)
class ItemResult:
    """A printed number or claim and how it came out: what tables, database and report tell alike.

    Attributes
    ----------
    published, simulated : as printed, and of the base case; in ``unit``.
    error : relative, absolute where zero is printed.
    """

    paper: str
    id: str
    figure: str
    kind: Kind
    statement: str
    published: float | None
    simulated: float | None
    unit: str
    error: float | None
    verdict: Verdict


@dataclass(frozen=True)
class Graded(ItemResult):
    """How a printed number or claim came out, and why.

    Attributes
    ----------
    margin : of the base case from where it would turn, -1 to 1; None where that is not known.
    margin_low, margin_high : between these in nine of ten cases that are judged.
    cases : all of it, with the points that they rest on.
    """

    grounds: Grounds
    margin: float | None = None
    margin_low: float | None = None
    margin_high: float | None = None
    cases: list[Case] = field(default_factory=list)


_GROUNDS = TypeAdapter(Grounds)
