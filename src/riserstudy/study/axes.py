"""Axes of studies: numbers with a unit, samples of assumptions, labels, and interpretations (readings)."""

from __future__ import annotations

import math
from decimal import Decimal
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene.replaced_values import check_sets

MOST_VALUES = 1_000_000  # largest number of values of an axis, and of points of a study
#: names of axes, which become names of dimensions and variables of datasets
AxisName = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,99}$")]
TIERS = ("preview", "standard", "reference")
Tier = Literal["preview", "standard", "reference"]


class Steps(Strict):
    """Equally spaced values, both ends included."""

    start: float
    stop: float
    step: Annotated[float, Field(gt=0)]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if not 0.0 <= self.stop - self.start <= MOST_VALUES * self.step:
            raise Misfit(
                "",
                f"stop {self.stop:g} is below start {self.start:g} or too far above it",
                f"give a stop above start, by at most {MOST_VALUES} steps",
            )
        last = self._at(self._count)
        if abs(self.stop - last) > 1e-6 * self.step + 1e-15 * abs(self.stop):
            found = f"{self.stop:g} is not a whole number of steps from start"
            allowed = f"give {last:g} or {self._at(self._count + 1):g}, or another step"
            raise Misfit("stop", found, allowed)
        return self

    @property
    def values(self) -> list[float]:
        """The values in the axis's unit, summed as decimal numbers, without binary rounding errors."""
        return [self._at(k) for k in range(self._count + 1)]

    @property
    def _count(self) -> int:
        return math.floor((self.stop - self.start) / self.step + 1e-9)

    def _at(self, k: int) -> float:
        return float(Decimal(repr(self.start)) + k * Decimal(repr(self.step)))


class Numbers(Strict):
    """An axis of numbers that are set at one or several paths of the scene, with a unit ("1": none).

    A number is multiplied by ``factor``, and ``offset`` is added, before it is set. They are for axes with
    another direction or another origin than the value in the scene. Absent: the number is not changed.
    """

    path: str | Annotated[list[str], Field(min_length=1)]
    unit: str
    factor: float | None = None
    offset: float | None = None
    values: list[float] | Steps
    preview: list[float] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.factor == 0.0:
            raise Misfit(
                "factor", "with 0 all values of the axis are equal", "remove it, or give another factor"
            )
        numbers = self.numbers("standard")
        if not numbers or len(set(numbers)) != len(numbers):
            raise Misfit(
                "values", "the list is empty or repeats a value", "give different values, one or more"
            )
        if self.preview is not None:
            some = set(self.preview)
            if not some <= set(numbers):
                found = "the list has a value that is not in values"
                raise Misfit("preview", found, "list only values of this axis")
            if not some or len(some) != len(self.preview):
                found = "the list is empty or repeats a value"
                raise Misfit("preview", found, "list some of the values, each once")
        return self

    def numbers(self, tier: Tier) -> list[float]:
        """Values for a tier, in the axis's unit."""
        every = self.values.values if isinstance(self.values, Steps) else self.values
        return self.preview if tier == "preview" and self.preview is not None else every

    @property
    def paths(self) -> list[str]:
        """Paths at which its numbers are set."""
        return [self.path] if isinstance(self.path, str) else self.path

    def overrides(self, number: float) -> dict[str, Any]:
        """Values that a number, in the axis's unit, sets, by path of the scene."""
        value = number if self.factor is None else number * self.factor
        value += self.offset or 0.0
        text = value if self.unit == "1" else f"{value!r} {self.unit}"
        return dict.fromkeys(self.paths, text)


class Samples(Strict):
    """An axis of samples: all assumptions of the scene are varied together over their ranges or options.

    ``readings`` names interpretations of the study file that are also varied, with equal probability.
    """

    count: dict[Tier, Annotated[int, Field(ge=2, le=MOST_VALUES)]]
    seed: Annotated[int, Field(ge=0)]
    leave: list[str] = Field(default_factory=list)
    readings: list[str] = Field(default_factory=list)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if missing := [tier for tier in TIERS if tier not in self.count]:
            found = f"the number of samples for the tier {missing[0]!r} is missing"
            raise Misfit("count", found, f"add '{missing[0]}: 20' or another number")
        return self


#: values of the scene by path, in the order in which they are set
Sets = Annotated[dict[str, Any], AfterValidator(check_sets)]
Labels = Annotated[dict[str, Sets], Field(min_length=1)]
#: an axis over all interpretations with the axis's name in the study file
Reading = Literal["readings"]
#: any kind of axis
Axis = Numbers | Samples | Labels | Reading
