"""Models of numbers, claims and errata of a paper, each with an ID."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, field_validator, model_validator

from riserstudy.grading.verdict import RELATIVE
from riserstudy.grading.word import Word
from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.percent import Percent
from riserstudy.inputs.strict import Strict
from riserstudy.records.printed_figures import figures_in


class PrintedNumber(Strict):
    """Stands for a printed number of the paper, by its ID."""

    printed: str


class WordName(Strict):
    """Stands for a word of size, whose bound `config/published/words.yaml` has."""

    word: str


InWords = Annotated[str, Field(min_length=1)]
Option = str | float | list[float] | list[str] | PrintedNumber | WordName | Word


class Checked(Strict):
    """Something that a function of the paper's module looks up in datasets.

    ``reads`` names a dataset for each dataset argument of the function ``check``, ``with`` its options.
    """

    id: str
    check: str | None = None
    reads: dict[str, str] = Field(default_factory=dict)
    options: dict[str, Option] = Field(default_factory=dict, alias="with")

    @model_validator(mode="after")
    def _reads_for_a_check(self) -> Self:
        if bool(self.check) != bool(self.reads):
            raise ValueError("check and reads go together")
        return self

    @property
    def datasets(self) -> set[str]:
        """Names of all datasets needed."""
        return set(self.reads.values())

    @property
    def words(self) -> list[Word]:
        """Words of size that it is judged by."""
        return [option for option in self.options.values() if isinstance(option, Word)]


class ChosenBy(Strict):
    """What of the base case was chosen because it gives a number or shows a claim.

    ``varied``: whether samples vary it. Where they do not, meeting the number or claim is no evidence.
    """

    what: InWords
    varied: bool


class Item(Checked):
    """A printed number or claim.

    ``over`` names the datasets that take the place of ``reads`` where the check runs over what the
    paper leaves open; without it the check's own dimensions are that space, and ``base`` picks the cell
    that counts as the simulated value. ``beside`` names datasets of further cases, told in the note:
    one cell, or many with their range and the share of hits.
    ``figure``: the printed figures that it stands in, or another place: `4a, 6 to 8, section 6.2`.
    ``impossible`` says why nothing can be compared, ``not_comparable`` how what is published is defined
    otherwise than what is computed.
    ``within``: share of the printed value that a number is to be met to, as `0.15 %`. Absent: 1 %.
    ``together``: IDs of numbers that the same case is to meet, since the paper has them of one case.
    """

    figure: str
    kind: Literal["number", "claim"]
    statement: str
    published: float | None = None
    unit: str = ""
    rounding: float | None = Field(default=None, gt=0)
    within: Percent | None = None
    over: dict[str, str] = Field(default_factory=dict)
    base: dict[str, str | float] = Field(default_factory=dict)
    beside: dict[str, dict[str, str]] = Field(default_factory=dict)
    together: list[str] = Field(default_factory=list)
    chosen: ChosenBy | None = None
    impossible: str = ""
    not_comparable: str = ""
    note: str = ""

    @field_validator("figure")
    @classmethod
    def _names_figures(cls, text: str) -> str:
        figures_in(text)
        return text

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.kind == "number") != (self.published is not None):
            raise Misfit(
                "published",
                "is inconsistent",
                "every number has a printed value, and no claim has one",
            )
        if (self.published is None) != (self.rounding is None):
            raise Misfit(
                "rounding",
                "is inconsistent",
                "the unit of the last printed digit needs a printed value",
            )
        if self.rounding and self.published and self.rounding > abs(self.published):
            raise Misfit(
                "rounding",
                f"{self.rounding:g} is coarser than the number {self.published:g}",
                "rounding is the unit of the last printed digit, for example 0.1 for 24.4",
            )
        if self.within is not None and not (self.published and 0.0 < self.within <= RELATIVE):
            raise Misfit(
                "within",
                f"{100 * self.within:g} %",
                "allowed is a share of a number other than zero, up to 1 %",
            )
        if sum(map(bool, (self.check, self.impossible, self.not_comparable))) != 1:
            raise ValueError("needs one of check, impossible and not_comparable")
        for name, reads in {"over": self.over, **self.beside}.items():
            if reads and set(reads) != set(self.reads):
                raise ValueError(f"{name}: needs the same arguments as reads")
        return self

    @property
    def datasets(self) -> set[str]:
        """Names of all datasets needed."""
        more = {name for reads in self.beside.values() for name in reads.values()}
        return {*self.reads.values(), *self.over.values(), *more}


class Erratum(Checked):
    """An error or gap of a paper: what is printed, what is read instead, what the simulation says.

    ``simulation`` may hold fields such as ``{swing:.0%}``, filled with what ``check`` returns.
    """

    where: str
    printed: str
    reading: str
    simulation: str = ""


class PrintedInput(Strict):
    """An input that a paper prints, as its scenes write it, and where it is printed.

    ``at`` says where scenes hold it as it stands, ``riser[*]`` for any section. Absent: what they hold is
    derived from it, or it is used nowhere.
    """

    what: str
    value: str | int | float
    where: str
    at: str | list[str] = Field(default_factory=list)

    @property
    def paths(self) -> list[str]:
        """Where scenes hold it."""
        return [self.at] if isinstance(self.at, str) else self.at


class PublishedFile(Strict):
    """All that a paper printed: its inputs, and what is graded of it. Absent inputs: not yet listed.

    ``called``: what verdicts call an unspecified input, by its path in a scene, or the name of its axis or
    readings. Absent: as ``riserstudy.grading.names.input_name`` says it.
    """

    paper: str
    called: dict[str, InWords] = Field(default_factory=dict)
    inputs: list[PrintedInput] = Field(default_factory=list)
    items: list[Item] = Field(min_length=1)
    errata: list[Erratum] = Field(default_factory=list)

    @model_validator(mode="after")
    def _each_id_once(self) -> Self:
        entries: list[Checked] = [*self.items, *self.errata]
        ids = [entry.id for entry in entries]
        twice = sorted({name for name in ids if ids.count(name) > 1})
        if twice:
            raise ValueError(f"id {twice[0]!r} occurs twice")
        return self

    @model_validator(mode="after")
    def _together_with_numbers(self) -> Self:
        numbers = {item.id: item for item in self.items if item.published is not None}
        for item in self.items:
            for other in item.together:
                if item.id not in numbers or other not in numbers or other == item.id:
                    found = f"{other!r} is no other number"
                    raise Misfit(f"{item.id}.together", found, f"allowed are {', '.join(numbers)}")
                if set(numbers[other].reads) != set(item.reads):
                    found, allowed = f"{other!r} reads by other names", "allowed are the same"
                    raise Misfit(f"{item.id}.together", found, allowed)
        return self

    @model_validator(mode="after")
    def _options_name_numbers(self) -> Self:
        for entry in (*self.items, *self.errata):
            for name, option in entry.options.items():
                if isinstance(option, PrintedNumber):
                    entry.options[name] = self.number(option.printed)
        return self

    def number(self, of: str) -> float:
        """The printed number of an ID.

        Raises
        ------
        Misfit
            When there is none.
        """
        numbers = {item.id: item.published for item in self.items if item.published is not None}
        if of not in numbers:
            raise Misfit("printed", f"no number {of!r}", f"allowed are {', '.join(numbers)}")
        return numbers[of]

    @property
    def datasets(self) -> list[str]:
        """Names of all datasets needed."""
        return sorted(set().union(*(entry.datasets for entry in (*self.items, *self.errata))))

    @property
    def checks(self) -> set[str]:
        """Names of the functions that they are checked by."""
        return {entry.check for entry in (*self.items, *self.errata) if entry.check}
