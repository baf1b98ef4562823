"""A warning of a run: a sentence with named places, and the values for these places.

A report can therefore join the warnings of many runs to one sentence with the range of each value.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from string import Formatter
from typing import Any, TypedDict

from riserstudy.records.numerals import at_most, newtons, percent, plain
from riserstudy.records.words import counted

Value = float | str | dict[str, float]
#: ways to write a number, beside those of Python, by the name that a place gives after its colon
FORMATS: dict[str, Callable[[Any], str]] = {
    "at_most": partial(at_most, digits=2),
    "newtons": newtons,
    "percent": percent,
    "plain": plain,
    "plain4": partial(plain, digits=4),
    "run": partial(counted, thing="run"),
}
#: kinds about the estimated error, which a study leaves out if it does not request an estimate
NOT_ESTIMATED, UNKNOWN, UNKNOWN_OVER_TIME = "not_estimated", "unknown_result", "unknown_result_over_time"
OF_ESTIMATE = (NOT_ESTIMATED, UNKNOWN, UNKNOWN_OVER_TIME)
MANY = 3  # number of different texts from which on a joint sentence does not list further ones


class RunWarning(TypedDict):
    """A warning as JSON: its kind, to which exactly one text belongs, and the values of the text's places."""

    kind: str
    text: str
    values: dict[str, Value]


def warning(kind: str, text: str, values: Mapping[str, Any] | None = None) -> RunWarning:
    """Return a warning with the values of its places: numbers, texts, or numbers by name."""
    return {"kind": kind, "text": text, "values": {name: _plain(v) for name, v in (values or {}).items()}}


def _plain(value: Any) -> Value:
    """Return a value as JSON has it: a number of Python, or a mapping that later changes leave alone."""
    if isinstance(value, dict):
        return {name: float(one) for name, one in value.items()}
    return value if isinstance(value, str | int) else float(value)


def sentence(one: RunWarning) -> str:
    """Return a warning in words."""
    return filled(one["text"], one["values"])


def sentences(warnings: Iterable[RunWarning]) -> list[str]:
    """Return each warning in words."""
    return [sentence(one) for one in warnings]


def filled(text: str, values: Mapping[str, Value]) -> str:
    """Return a text with values in its places."""
    return _Words().vformat(text, (), values)


def joint_sentence(warnings: Iterable[RunWarning]) -> str:
    """Return warnings of one kind as one sentence, with the range of each number and the different texts."""
    first, *others = warnings
    values = {
        name: [value, *(one["values"][name] for one in others)] for name, value in first["values"].items()
    }
    return _Ranges(" … " if " to {" in first["text"] else " to ").vformat(first["text"], (), values)


class _Words(Formatter):
    """Fills places with one value each."""

    def format_field(self, value: Any, spec: str) -> str:
        if isinstance(value, Mapping):
            return ", ".join(
                f"{name.replace('_', ' ')} {self.format_field(value[name], spec)}" for name in value
            )
        return FORMATS[spec](value) if spec in FORMATS else format(value, spec)


class _Ranges(_Words):
    """Fills places with the values of several warnings each."""

    def __init__(self, to: str) -> None:
        self.to = to

    def format_field(self, value: Any, spec: str) -> str:
        if not isinstance(value, list):
            return super().format_field(value, spec)
        if isinstance(value[0], dict):
            names = dict.fromkeys(name for one in value for name in one)
            return super().format_field({n: [one[n] for one in value if n in one] for n in names}, spec)
        if isinstance(value[0], str):
            texts = list(dict.fromkeys(value))
            return " or ".join([*texts[:MANY], *(["others"] if len(texts) > MANY else [])])
        ends = [super().format_field(min(value), spec), super().format_field(max(value), spec)]
        return self.to.join(dict.fromkeys(ends))
