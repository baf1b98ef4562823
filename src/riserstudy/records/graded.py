"""Results of published values and claims, and the grounds of their verdicts, which are exchanged as JSON."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

from pydantic import ConfigDict, TypeAdapter

Kind = Literal["number", "claim"]
Verdict = Literal[
    "reproduced", "calibrated", "holds", "fails", "depends", "not comparable", "not reproducible"
]
#: reason why a verdict depends: unspecified inputs, a base case that is not among the samples, too few
#: samples, or cases without a result
Because = Literal["inputs", "base case", "too few samples", "missing values"]
Place = dict[str, Any]  # values by axis
#: answer of almost all samples of an interpretation; for a published value, whether it is met
ReadingAnswer = Literal["true", "no difference", "false", "depends"]


class Travelling:
    """Base of records that are exchanged as JSON, in which NaN and infinity are strings."""

    __pydantic_config__: ClassVar = ConfigDict(ser_json_inf_nan="strings", extra="forbid")


@dataclass(frozen=True)
class Case:
    """One line of margins.csv: one case of a published value or claim; the fields are its columns.

    Attributes
    ----------
    place : its sample and its cell on the judged axes, by axis.
    base, judged : whether it is the base case, and whether it counts in the share.
    met : whether the value is met, or the claim is true; None without a result, which is never judged.
    same : whether a claim is not true because the compared values do not differ.
    margin : distance from the change of ``met``, -1 to 1; None if not known.
    calibrated : whether it depends on an input fitted to a published value.
    rests_on : simulated studies (paper/name) with the axes by which ``place`` selects its points; all points
        of a study without axes.
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
    """Number of samples that meet a published value or claim, counted in every judged cell.

    ``same``: number of samples in which the compared values do not differ.
    ``draws``: number of draws, without cells; None if all combinations of interpretations are judged.
    ``low``, ``high``: 95 % confidence interval of the share, 0 to 1; None for few or no draws.
    """

    met: int
    samples: int
    draws: int | None = None
    low: float | None = None
    high: float | None = None
    same: int = 0


@dataclass(frozen=True)
class Reading(Travelling):
    """The result with one interpretation, at its place on the axes of interpretations.

    ``share``: share of its samples. ``decided_by``: names of the inputs on which it depends.
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
    """A deciding input."""

    input: str  # its path in a scene, or the name of its axis or interpretations
    name: str  # its name in a paper's file, or its standard name
    # share of the variance that remains when all other inputs are known, for a grid; else None
    total_effect: float | None = None
    # share of the samples that meet it for each option, in the notation of scenes; empty for ranges
    by_option: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Outcome(Travelling):
    """The result of the base case or a further case; ``low`` and ``high`` are equal for one cell.

    ``share``, ``decided_by`` (names of inputs): for a case with many cells. ``readings``: as in ``Grounds``,
    instead of these. ``same``: as in a ``Case``.
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
    """Number of samples that meet the premise of a claim; only these are judged."""

    judged: int
    samples: int


@dataclass(frozen=True)
class Missing(Travelling):
    """Number of cases without a result, which are excluded."""

    cases: int
    of: int


@dataclass(frozen=True)
class Together(Travelling):
    """IDs of values that are judged with one, in the same case; number of samples that meet it alone."""

    others: list[str]
    alone: Share


@dataclass(frozen=True)
class Chosen(Travelling):
    """Inputs of the base case that were chosen to meet this; whether samples vary them."""

    what: str
    varied: bool


@dataclass(frozen=True)
class Settled(Travelling):
    """Number of samples after which the verdict was certain, None if it is not; and the confidence."""

    after: int | None
    samples: int
    confidence: float


@dataclass(frozen=True)
class Grounds(Travelling):
    """The grounds of a verdict.

    Attributes
    ----------
    impossible : reason why no comparison is possible; "" if it is possible.
    not_comparable : difference of the definitions of published and computed quantity; "" if there is none.
    within : tolerance as a share of the published value, if stricter than 1 %.
    words : words of size in a claim.
    share : share of the samples that meet it, with the interpretation of the base case if there are several;
        None without samples, or if the base case has no interpretation.
    readings : results with each interpretation; empty if there is only one.
    because : reason why it depends; None if it does not.
    decided_by : the deciding inputs, the most important first.
    explained : share of the variance that these explain together, 0 if none exceeds chance; None if not
        computed, or if inputs have total effects.
    premise, settled : None without a premise, and for few samples.
    missing : None if every case has a result.
    together : None if it is judged alone. chosen : None if no input was chosen to meet it.
    outcomes : results of the base case, if reported, and of further cases.
    note : note of the paper's file.
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
        """JSON text for a cell of a table, with NaN and infinity as strings."""
        return _GROUNDS.dump_json(self).decode()

    @classmethod
    def from_json(cls, text: str | bytes) -> Grounds:
        """Grounds from such a cell. Raises ValueError when it is not valid."""
        return _GROUNDS.validate_json(text)


@dataclass(frozen=True)
class ItemResult:
    """A published value or claim and its result, as in tables, database and report.

    Attributes
    ----------
    published, simulated : published value, and value of the base case, in ``unit``.
    error : relative error; absolute if the published value is zero.
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
    """The result of a published value or claim, with its grounds.

    Attributes
    ----------
    margin : margin of the base case, -1 to 1; None if not known.
    margin_low, margin_high : range of the margins of nine in ten judged cases.
    cases : all cases, with the points that they use.
    """

    grounds: Grounds
    margin: float | None = None
    margin_low: float | None = None
    margin_high: float | None = None
    cases: list[Case] = field(default_factory=list)


_GROUNDS = TypeAdapter(Grounds)
