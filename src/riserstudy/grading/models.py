"""Models of published values, claims and errata of a paper, each with an ID."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, field_validator, model_validator

from riserstudy.dataset.unit_names import UnitName
from riserstudy.grading.verdict import RELATIVE
from riserstudy.grading.word_of_size import Word
from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.percent import Percent
from riserstudy.inputs.strict import Strict
from riserstudy.records.printed_figures import figures_in


class PrintedNumber(Strict):
    """Represents a published value of the paper, by its ID."""

    printed: str


class WordName(Strict):
    """Represents a word of size, whose bound is in `config/published/words.yaml`."""

    word: str


InWords = Annotated[str, Field(min_length=1)]
Option = str | float | list[float] | list[str] | PrintedNumber | WordName | Word


class Checked(Strict):
    """An item that a function of the paper's module computes from datasets.

    ``reads`` names a dataset for each dataset argument of the function ``check``, ``with`` its options.
    """

    id: str
    check: str | None = None
    reads: dict[str, str] = Field(default_factory=dict)
    options: dict[str, Option] = Field(default_factory=dict, alias="with")

    @model_validator(mode="after")
    def _reads_for_a_check(self) -> Self:
        if bool(self.check) != bool(self.reads):
            raise Misfit("", "only one of check and reads is given", "give both check and reads, or neither")
        return self

    @property
    def datasets(self) -> set[str]:
        """Names of all datasets needed."""
        return set(self.reads.values())

    @property
    def words(self) -> list[Word]:
        """Words of size in its options."""
        return [option for option in self.options.values() if isinstance(option, Word)]


class ChosenBy(Strict):
    """Inputs of the base case that were chosen because they give a published value or meet a claim.

    ``varied``: whether samples vary them. If they do not, agreement with the value or claim is no evidence.
    """

    what: InWords
    varied: bool


class Item(Checked):
    """A published value or claim.

    ``over`` names the datasets that replace ``reads`` when the check is run over the unspecified inputs of
    the paper. Without ``over``, the dimensions of the check's result are these inputs, and ``base`` selects
    the cell of the simulated value. ``further_cases`` names their datasets, for the note: one cell, or many
    cells with their range and the share of hits. ``figure``: the published figures that contain it, or
    another place: `4a, 6 to 8, section 6.2`. ``impossible``: reason why no comparison is possible.
    ``not_comparable``: difference between the definitions of the published and the computed quantity.
    ``within``: tolerance as a share of the published value, such as `0.15 %`. Absent: 1 %. ``together``: IDs
    of published values that the same case must meet, because the paper gives them for one case.
    """

    figure: str
    kind: Literal["number", "claim"]
    statement: str
    published: float | None = None
    unit: UnitName = ""
    rounding: float | None = Field(default=None, gt=0)
    within: Percent | None = None
    over: dict[str, str] = Field(default_factory=dict)
    base: dict[str, str | float] = Field(default_factory=dict)
    further_cases: dict[str, dict[str, str]] = Field(default_factory=dict)
    together: list[str] = Field(default_factory=list)
    chosen: ChosenBy | None = None
    impossible: str = ""
    not_comparable: str = ""
    note: str = ""

    @field_validator("figure")
    @classmethod
    def _names_figures(cls, text: str) -> str:
        try:
            figures_in(text)
        except ValueError as error:
            raise Misfit("", *error.args) from None
        return text

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.kind == "number") != (self.published is not None):
            raise Misfit(
                "published",
                "a number has a published value, but a claim has none",
                "add published for 'kind: number', or remove published for a claim",
            )
        if (self.published is None) != (self.rounding is None):
            found = "only one of published and rounding is given"
            raise Misfit("rounding", found, "give both published and rounding, or neither")
        if self.rounding and self.published and self.rounding > abs(self.published):
            raise Misfit(
                "rounding",
                f"{self.rounding:g} is coarser than the number {self.published:g}",
                "give the unit of the last printed digit, for example 0.1 for 24.4",
            )
        if self.within is not None and not (self.published and 0.0 < self.within <= RELATIVE):
            raise Misfit(
                "within",
                f"{100 * self.within:g} % is too large, or the published number is zero",
                f"give at most {100 * RELATIVE:g} %, for a published number other than zero",
            )
        if sum(map(bool, (self.check, self.impossible, self.not_comparable))) != 1:
            raise Misfit(
                "",
                "an item has exactly one of check, impossible and not_comparable",
                "give one of the three keys",
            )
        for name, reads in {"over": self.over, **self.further_cases}.items():
            if reads and set(reads) != set(self.reads):
                raise Misfit(
                    "",
                    f"{name} has other arguments than reads",
                    "give the same names on the left of the colons",
                )
        return self

    @property
    def datasets(self) -> set[str]:
        """Names of all datasets needed."""
        more = {name for reads in self.further_cases.values() for name in reads.values()}
        return {*self.reads.values(), *self.over.values(), *more}


class Erratum(Checked):
    """An error or gap of a paper: the printed text, the interpretation used instead, the simulated result.

    ``simulation`` may contain fields such as ``{swing:.0%}``, which are replaced by results of ``check``.
    """

    where: str
    printed: str
    reading: str
    simulation: str = ""


class PrintedInput(Strict):
    """An input that a paper publishes, in the notation of its scenes, and its place in the paper.

    ``at``: paths of scenes that have this value, with ``riser[*]`` for any section. Absent: scenes have
    values that are derived from it, or do not use it.
    """

    what: str
    value: str | int | float
    where: str
    at: str | list[str] = Field(default_factory=list)

    @property
    def paths(self) -> list[str]:
        """Paths of scenes that have it."""
        return [self.at] if isinstance(self.at, str) else self.at


class PublishedFile(Strict):
    """A paper's published inputs, values, claims and errata. Without ``inputs``, these are not yet listed.

    ``called``: names of unspecified inputs in verdicts, by path in a scene, or by name of their axis or
    interpretations. Absent: from ``riserstudy.grading.names.input_name``.
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
            raise Misfit("", f"the id {twice[0]!r} occurs twice", "give each item a different id")
        return self

    @model_validator(mode="after")
    def _together_with_numbers(self) -> Self:
        numbers = {item.id: item for item in self.items if item.published is not None}
        for item in self.items:
            for other in item.together:
                if item.id not in numbers or other not in numbers or other == item.id:
                    found = f"{other!r} is not the id of another number"
                    raise Misfit(f"{item.id}.together", found, f"use one of {', '.join(numbers)}")
                if set(numbers[other].reads) != set(item.reads):
                    found = f"the number {other!r} has different names in reads"
                    raise Misfit(f"{item.id}.together", found, "give both the same names in reads")
        return self

    @model_validator(mode="after")
    def _options_name_numbers(self) -> Self:
        for entry in (*self.items, *self.errata):
            for name, option in entry.options.items():
                if isinstance(option, PrintedNumber):
                    entry.options[name] = self.number(option.printed)
        return self

    def number(self, of: str) -> float:
        """The published value with an ID. Raises Misfit when there is none."""
        numbers = {item.id: item.published for item in self.items if item.published is not None}
        if of not in numbers:
            found = f"the file has no number {of!r}"
            raise Misfit("printed", found, f"use one of {', '.join(numbers)}")
        return numbers[of]

    @property
    def datasets(self) -> list[str]:
        """Names of all datasets needed."""
        return sorted(set().union(*(entry.datasets for entry in (*self.items, *self.errata))))

    @property
    def checks(self) -> set[str]:
        """Names of the functions that check them."""
        return {entry.check for entry in (*self.items, *self.errata) if entry.check}
