"""A file of published values and claims about any model, with its specified and unspecified inputs.

This module does not depend on risers, scenes or datasets of runs.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator
from pydantic.json_schema import GenerateJsonSchema

from riserstudy.grading.models import ChosenBy, InWords, Item, WordName
from riserstudy.grading.word_of_size import Word
from riserstudy.grading.words_of_size_file import WordsFile
from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.percent import Percent
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.strict import Strict
from riserstudy.inputs.validate import check

Value = float | str
MOST_SAMPLES = 100_000
BASE, SAMPLES = "base", "samples"  # datasets of answers
#: names of inputs, which become arguments
Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,99}$")]


class Given(Strict):
    """An input that the source gives."""

    given: Value
    unit: str = "1"


class Calibrated(Strict):
    """An input that was fitted to a published value, whose ID is ``to``."""

    calibrated: Value
    to: str
    unit: str = "1"


class Assumed(Strict):
    """An input that the source does not give: its value in the base case, and its range or options."""

    assumed: Value
    range: Annotated[list[float], Field(min_length=2, max_length=2)] | None = None
    options: Annotated[list[Value], Field(min_length=2)] | None = None
    because: InWords
    unit: str = "1"

    @model_validator(mode="after")
    def _base_is_inside(self) -> Self:
        if (self.range is None) == (self.options is None):
            raise Misfit("", "range or options is required, not both", "give either range or options")
        if self.options is not None and len({*self.options}) < len(self.options):
            raise Misfit(
                "options",
                "an option occurs twice and would be sampled twice as often",
                "give each option once",
            )
        if self.options is not None and self.assumed not in self.options:
            found = f"{self.assumed!r} is not one of the options"
            raise Misfit("assumed", found, "assume one of the options, or add this option")
        if self.range is not None:
            low, high = self.range
            if isinstance(self.assumed, str) or not low <= self.assumed <= high or low == high:
                found = f"{self.assumed!r} is outside the range"
                raise Misfit("assumed", found, "assume a value within the range, or extend the range")
        return self


Input = Given | Calibrated | Assumed


class OpenClaim(Strict):
    """A published value or claim, and the function that computes it; fields as in ``Item``."""

    id: str
    kind: Literal["number", "claim"]
    statement: InWords
    check: str | None = None
    options: dict[str, WordName | float | str] = Field(default_factory=dict, alias="with")
    published: float | None = None
    unit: str = "1"
    rounding: float | None = Field(default=None, gt=0)
    within: Percent | None = None
    chosen: ChosenBy | None = None
    impossible: str = ""
    not_comparable: str = ""
    note: str = ""


class ClaimsFile(Strict):
    """Inputs, and published values and claims that are graded over the unspecified inputs.

    ``study`` is the name of the file in tables. ``samples``: number of joint draws of all assumed inputs,
    with ``seed``. ``words``: bounds of words of size, as in ``config/published/words.yaml``; absent: no claim
    has one.
    """

    study: InWords
    inputs: dict[Name, Input]
    samples: Annotated[int, Field(ge=2, le=MOST_SAMPLES)]
    seed: Annotated[int, Field(ge=0)]
    words: WordsFile | None = None
    items: list[OpenClaim] = Field(min_length=1)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        ids = [item.id for item in self.items]
        if twice := sorted({name for name in ids if ids.count(name) > 1}):
            raise Misfit("", f"the id {twice[0]!r} occurs twice", "give each item a different id")
        for name, one in self.inputs.items():
            if isinstance(one, Calibrated) and one.to not in ids:
                raise Misfit(
                    "", f"inputs.{name}.to: the file has no number {one.to!r}", "give the id of a number"
                )
        for item in self.items:
            self.item(item)  # applies the rules of Item
        return self

    @property
    def open(self) -> dict[str, Assumed]:
        """Inputs that the source does not give."""
        return {name: one for name, one in self.inputs.items() if isinstance(one, Assumed)}

    @property
    def fitted(self) -> bool:
        """Whether any input was fitted to a published value."""
        return any(isinstance(one, Calibrated) for one in self.inputs.values())

    @property
    def base(self) -> dict[str, Value]:
        """Inputs of the base case."""
        return {name: _value(one) for name, one in self.inputs.items()}

    def item(self, claim: OpenClaim) -> Item:
        """A published value or claim in the form of the grader."""
        same = claim.model_dump(exclude={"options", "within", "chosen"})
        reads = {"answers": f"{claim.id} {BASE}"} if claim.check else {}
        over = {"answers": f"{claim.id} {SAMPLES}"} if claim.check and self.open else {}
        return Item(**same, figure="", reads=reads, over=over).replaced(
            within=claim.within,
            chosen=claim.chosen,
            options={name: self._word(of) for name, of in claim.options.items()},
        )

    def _word(self, option: Any) -> Any:
        if not isinstance(option, WordName):
            return option
        if self.words is None:
            raise Misfit("", f"the word {option.word!r} is used, but the file has no words", "add words")
        found: Word = self.words.word(option.word)
        return found


def _value(one: Input) -> Value:
    if isinstance(one, Given):
        return one.given
    return one.calibrated if isinstance(one, Calibrated) else one.assumed


def read_claims(path: str | Path) -> ClaimsFile:
    """A file of published values and claims. Raises InputError when it cannot be read, or is invalid."""
    return check(ClaimsFile, read_yaml(Path(path)), path)


def claims_schema() -> dict[str, Any]:
    """JSON schema of the file."""
    return {"$schema": GenerateJsonSchema.schema_dialect, **ClaimsFile.model_json_schema()}
