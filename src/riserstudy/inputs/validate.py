"""Validate data against a model; the first error becomes one readable message."""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from riserstudy.errors import InputError
from riserstudy.inputs.misfit import Misfit, joined
from riserstudy.inputs.unknown_key import unknown_key

T = TypeVar("T", bound=BaseModel)
TYPES = frozenset(("bool", "float", "int", "str"))  # as pydantic names them, among alternatives
_GROUP = ("{value} is not a group of fields", "write fields, each as 'name: value'")
_LIST = ("{value} is not a list", "write a list, such as '[first, second]'")
#: value found and remedy of faults, by pydantic's name of the fault
WORDS = {
    "greater_than": ("{value} is too small", "give a value greater than {gt}"),
    "greater_than_equal": ("{value} is too small", "give a value greater than or equal to {ge}"),
    "less_than": ("{value} is too large", "give a value less than {lt}"),
    "less_than_equal": ("{value} is too large", "give a value less than or equal to {le}"),
    "literal_error": ("{value} is not one of the choices", "write {expected}"),
    "float_type": ("{value} is not a plain number", "write a number without a unit and without quotes"),
    "int_type": ("{value} is not a whole number", "write a whole number, such as 3"),
    "bool_type": ("{value} is neither true nor false", "write true or false"),
    "string_type": ("{value} is not text", "write text, in quotes if it looks like a number"),
    "list_type": _LIST,
    "tuple_type": _LIST,
    "dict_type": _GROUP,
    "model_type": _GROUP,
    "too_short": ("the number of items is {actual_length}", "give at least {min_length}"),
    "too_long": ("the number of items is {actual_length}", "give at most {max_length}"),
}


def check(model: type[T], tree: Any, source: object, field: str = "") -> T:
    """Validate data against a pydantic model; the first error becomes an InputError.

    ``field``: place of the data in the source; empty: the data are the whole source.
    """
    try:
        return model.model_validate(tree)
    except ValidationError as error:
        raise _readable(model, error, source, field) from None


def _readable(model: type[BaseModel], error: ValidationError, source: object, field: str) -> InputError:
    """Return the most informative error; of a field with alternatives, one of the nearest alternative."""
    alternatives: dict[tuple[str, ...], list[Any]] = {}
    for fault in error.errors():
        chosen = tuple(str(step) for step in fault["loc"] if _names_alternative(step))
        alternatives.setdefault(chosen, []).append(fault)

    def distance(faults: list[Any]) -> tuple[bool, int, int]:
        another_kind = any(
            fault["type"].endswith(("_type", "literal_error")) and _names_alternative(fault["loc"][-1])
            for fault in faults
        )
        other_keys = sum(fault["type"] in ("extra_forbidden", "missing") for fault in faults)
        return another_kind, other_keys, len(faults)

    faults = alternatives.get(()) or min(alternatives.values(), key=distance)
    first = max(faults, key=lambda fault: (fault["type"] == "extra_forbidden", len(fault["loc"])))
    where = field
    for step in first["loc"]:
        if isinstance(step, int):
            where += f"[{step}]"
        elif not _names_alternative(step):
            where += f".{step}" if where else step
    kind = first["type"]
    if kind == "extra_forbidden":
        return unknown_key(source, where, model, first["loc"])
    if kind == "missing":
        return InputError(source, where, "missing", "add it, since it has no default")
    misfit = first.get("ctx", {}).get("error")
    if isinstance(misfit, Misfit):
        also = tuple(joined(where, path) for path in misfit.also)
        path = joined(where, misfit.path)
        return InputError(source, path, misfit.found, misfit.allowed, also)
    return InputError(source, where, *_in_words(first))


def _in_words(fault: Any) -> tuple[str, str]:
    """Return the value found and the remedy of an error that pydantic describes."""
    message, given = fault["msg"].removeprefix("Value error, "), fault["input"]
    if fault["type"] == "value_error":
        return "the fields of this part contradict each other", message
    value = "the value" if isinstance(given, dict | list) else repr(given)[:120]
    if fault["type"] in WORDS:
        found, remedy = WORDS[fault["type"]]
        facts = {"value": value, **fault.get("ctx", {})}
        return found.format(**facts), remedy.format(**facts)
    return f"{value} is not allowed", message[0].lower() + message[1:]


def _names_alternative(step: object) -> bool:
    """Return whether a step of an error's place names one of several models or types, and not a field."""
    if not isinstance(step, str):
        return False
    return step in TYPES or step[:1].isupper() or "[" in step or "-" in step


def refuse_other_paper(paper: str, path: Path) -> None:
    """Refuse a file of a paper that has another paper's name, under which its results would be stored.

    Raises InputError if it does.
    """
    if paper != path.stem:
        found = f"{paper!r} differs from the name of the file, {path.stem!r}"
        raise InputError(path, "paper", found, f"write 'paper: {path.stem}', or rename the file")
