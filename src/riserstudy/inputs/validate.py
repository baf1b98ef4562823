"""Validate data against a model; the first error becomes one readable message."""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from riserstudy.errors import InputError
from riserstudy.inputs.misfit import Misfit, joined

T = TypeVar("T", bound=BaseModel)
TYPES = frozenset(("bool", "float", "int", "str"))  # as pydantic names them, among alternatives


def check(model: type[T], tree: Any, source: object, field: str = "") -> T:
    """Validate data against a pydantic model; the first error becomes an InputError.

    ``field``: place of the data in the source; empty: the data are the whole source.
    """
    try:
        return model.model_validate(tree)
    except ValidationError as error:
        raise _readable(error, source, field) from None


def _readable(error: ValidationError, source: object, field: str) -> InputError:
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
    kind, found = first["type"], first["input"]
    value_text = repr(found) if not isinstance(found, dict | list) else "the value found"
    if kind == "extra_forbidden":
        return InputError(source, where, "unknown key", "see `riserstudy schema` for what is allowed")
    if kind == "missing":
        return InputError(source, where, "missing", "it has no default: add it")
    misfit = first.get("ctx", {}).get("error")
    if isinstance(misfit, Misfit):
        also = tuple(joined(where, path) for path in misfit.also)
        path = joined(where, misfit.path)
        return InputError(source, path, misfit.found, misfit.allowed, also)
    message = first["msg"].removeprefix("Value error, ")
    if kind == "value_error":
        return InputError(source, where, "is inconsistent", message)
    return InputError(source, where, value_text[:120], message[0].lower() + message[1:])


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
        allowed = f"allowed is {path.stem!r}, the name of the file"
        raise InputError(path, "paper", repr(paper), allowed)
