"""The field of a scene at a dotted path: how its models read a value there, and in which SI unit."""

from __future__ import annotations

import types
from collections.abc import Iterator
from functools import cache, lru_cache
from inspect import isclass
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from riserstudy.inputs.percent import Percent
from riserstudy.scene.models import Scene
from riserstudy.scene.paths import is_path, steps
from riserstudy.scene.units import Unit


# typed: True is not 1; large: the samples of many studies pass through here
@lru_cache(100_000, typed=True)
def in_si(path: str, value: Any) -> tuple[float | None, str | None]:
    """The SI value of a scene's value at a path, and its SI unit; (None, None) for text and booleans."""
    if isinstance(value, bool):
        return None, None
    if isinstance(value, int | float):
        return float(value), "1"
    for reader, unit in _readers(path):
        try:
            return reader(value), unit
        except ValueError:
            continue
    return None, None


@cache
def _readers(path: str) -> list[tuple[Any, str]]:
    """Functions by which a scene's models read text at a path, with SI units; one per possible type."""
    if not is_path(path):
        return []
    kinds: list[tuple[Any, list[Any]]] = [(Scene, [])]
    for step in steps(path):
        kinds = [inner for kind, _ in kinds for inner in _into(kind, step)]
    marks = [mark for _, metadata in kinds for mark in metadata]
    readers = [(mark.read, mark.name) for mark in marks if isinstance(mark, Unit)]
    percent = get_args(Percent)[1]
    return [*readers, *((mark.func, "1") for mark in marks if mark is percent)]


def _into(kind: Any, step: str | int) -> Iterator[tuple[Any, list[Any]]]:
    """Types one step of a path below a type, with their metadata."""
    if isclass(kind) and issubclass(kind, BaseModel) and step in kind.model_fields:
        field = kind.model_fields[str(step)]
        yield from _apart(field.annotation, field.metadata)
    elif isinstance(step, int) and get_origin(kind) in (list, tuple):
        for item in get_args(kind):
            yield from _apart(item, [])
    elif get_origin(kind) is dict:
        yield from _apart(get_args(kind)[1], [])


def _apart(kind: Any, marks: list[Any]) -> Iterator[tuple[Any, list[Any]]]:
    """The types inside a union or an annotated type, each with its metadata."""
    if get_origin(kind) is Annotated:
        inner, *more = get_args(kind)
        for extra in more:
            marks = [*marks, *(extra.metadata if isinstance(extra, FieldInfo) else [extra])]
        yield from _apart(inner, marks)
    elif get_origin(kind) in (Union, types.UnionType):
        for one in get_args(kind):
            yield from _apart(one, marks)
    else:
        yield kind, marks
