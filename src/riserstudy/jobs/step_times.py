"""Steps of a run by rule and wildcards, and the times that earlier runs, or the project, have of them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any, NamedTuple, Self

from pydantic import Field, TypeAdapter

from riserstudy.files.whole import write_whole

DATA_FILES = ("first_times.json",)
FIRST = Path(__file__).with_name(DATA_FILES[0])  # times of steps and rules without an earlier run
SHARD, SIMULATE = "shard", "simulate"  # rules whose steps simulate points


class StepName(NamedTuple):
    """A step of a run: its rule, and its wildcards with their values, sorted by name."""

    rule: str
    wildcards: tuple[tuple[str, str], ...] = ()

    @classmethod
    def of(cls, rule: str, wildcards: Mapping[str, Any] | None = None) -> Self:
        """The step of a rule with these wildcards."""
        return cls(rule, tuple(sorted((str(k), str(v)) for k, v in (wildcards or {}).items())))

    @classmethod
    def of_study(cls, study: str, shard: int | None = None, shards: int = 1) -> Self:
        """The step that simulates a study (``paper/name``) or joins its shards; or, if given, one shard."""
        paper, _, name = study.partition("/")
        of = {"paper": paper, "study": name}
        if shard is None:
            return cls.of(SIMULATE, of)
        return cls.of(SHARD, of | {"shard": shard, "shards": shards})

    @property
    def study(self) -> str | None:
        """The study that the step simulates, as ``paper/name``; None for another step."""
        of = dict(self.wildcards)
        if self.rule not in (SHARD, SIMULATE) or not {"paper", "study"} <= of.keys():
            return None
        return f"{of['paper']}/{of['study']}"

    @property
    def share(self) -> float:
        """Share of the points of its study that the step simulates."""
        if self.rule != SHARD:
            return 1.0
        shards = dict(self.wildcards).get("shards", "1")
        return 1.0 / int(shards) if shards.isdecimal() and int(shards) else 1.0


class Taken(NamedTuple):
    """Time of a finished step: its part of the time (core seconds), and its points (1 if none)."""

    seconds: float
    points: float


#: times of steps
Times = dict[StepName, Taken]


class Line(NamedTuple):
    """Time of a step as files store it."""

    rule: str
    wildcards: dict[str, str]
    seconds: Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
    points: Annotated[float, Field(gt=0.0, allow_inf_nan=False)]


_MEMORY = TypeAdapter(dict[str, list[Line]])
_LINES = TypeAdapter(list[Line])


def remembered(memory: Path) -> dict[str, Times]:
    """Times of earlier runs by tier; none if the file cannot be read, or is from another version."""
    try:
        tiers = _MEMORY.validate_json(memory.read_bytes())
    except (OSError, ValueError):
        return {}
    return {tier: _times(lines) for tier, lines in tiers.items()}


def remember(memory: Path, tiers: Mapping[str, Times]) -> None:
    """Store times by tier for the next run, unless the disk is full or the folder read-only."""
    lines = {tier: lines_of(times) for tier, times in tiers.items()}
    with suppress(OSError):
        memory.parent.mkdir(mode=0o700, exist_ok=True)
        write_whole(memory, json.dumps(lines).encode())


def lines_of(times: Times) -> list[Line]:
    """Times as files store them."""
    return [Line(name.rule, dict(name.wildcards), *taken) for name, taken in times.items()]


class First(NamedTuple):
    """Times that come with the project (core seconds).

    ``a_step``, ``a_point``: by rule, of a step without its points, and of a point. ``steps``: of named steps.
    """

    a_step: dict[str, float]
    a_point: dict[str, float]
    steps: Times


def first_times(file: Path = FIRST) -> First:
    """Times that come with the project."""
    content = json.loads(file.read_text("utf-8"))
    return First(content["a_step"], content["a_point"], _times(_LINES.validate_python(content["steps"])))


def _times(lines: list[Line]) -> Times:
    return {StepName.of(of.rule, of.wildcards): Taken(of.seconds, of.points) for of in lines}
