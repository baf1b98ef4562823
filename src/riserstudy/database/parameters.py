"""Parameters of the points of a study: every value of their scenes by path, in SI and as written.

What an axis sets wins over the scene and over earlier axes, as in ``SceneFile.with_values``; here for all
points of a grid at once.
"""

from __future__ import annotations

import json
import types
from collections.abc import Iterator, Mapping
from functools import cache, lru_cache
from inspect import isclass
from typing import Annotated, Any, NamedTuple, Union, get_args, get_origin

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from riserstudy.database.read_dataset import Grid
from riserstudy.scene.models import Scene
from riserstudy.scene.origin import leaves, unwrap
from riserstudy.scene.units import Percent, Unit

TITLES = ("title", "note", "paper")


class Parameter(NamedTuple):
    """A value of a scene; ``value`` is None where it is text."""

    path: str
    value: float | None
    unit: str | None
    as_written: str
    origin: str
    because: str


class Varied(NamedTuple):
    """Values of one path, numbered, and their numbers over the points of a study; -1 where it is absent."""

    values: dict[Parameter, int]
    at: NDArray[np.int64]


def parameters_of(
    attributes: Mapping[str, Any], grid: Grid
) -> tuple[list[Parameter], list[Varied]]:
    """What is the same at all points of a study, and what differs."""
    tree = json.loads(attributes["scene"])
    origins = json.loads(attributes["origins"])
    evidence = json.loads(attributes["evidence"])
    plain = "published" if tree.get("paper") else "given"
    tree = {name: value for name, value in tree.items() if name not in TITLES}
    base = {
        path: parameter(path, value, *_origin(path, origins, evidence, plain))
        for path, value in leaves(tree)
    }
    varied: dict[str, Varied] = {}
    below = Below([*base])
    for number, axis in enumerate(grid.axes):
        by_value = json.loads(axis.sets or "{}")
        for position, value in enumerate(axis.values):
            here = (*(slice(None),) * number, position)
            for path, sets in by_value.get(str(value), {}).items():
                _lay(varied, base, below, grid.shape, here, path, sets)
    same = [parameter for path, parameter in base.items() if path not in varied]
    return same, [*varied.values()]


def _origin(
    path: str, origins: Mapping[str, str], evidence: Mapping[str, str], plain: str
) -> tuple[str, str]:
    """Where a value of a scene comes from: as its own origin is given, or that of what it is a part of."""
    for part in _above(path):
        if part in origins:
            return origins[part], evidence.get(part, "")
    return plain, ""


def _above(path: str) -> Iterator[str]:
    """A path and all that it is below."""
    yield path
    for k in range(len(path) - 1, 0, -1):
        if path[k] in ".[":
            yield path[:k]


class Below:
    """Known paths by what they are below; looked for once, as long as no path is new."""

    def __init__(self, paths: list[str]) -> None:
        self._paths = dict.fromkeys(paths)
        self._found: dict[str, list[str]] = {}

    def of(self, path: str) -> list[str]:
        """The path itself, where it is known, and all known paths below it."""
        if path not in self._found:
            parts = (f"{path}.", f"{path}[")
            self._found[path] = [p for p in self._paths if p == path or p.startswith(parts)]
        return self._found[path]

    def add(self, path: str) -> None:
        """Know a path."""
        if path not in self._paths:
            self._paths[path] = None
            self._found.clear()


def _lay(
    varied: dict[str, Varied],
    base: Mapping[str, Parameter],
    below: Below,
    shape: tuple[int, ...],
    here: tuple[Any, ...],
    path: str,
    sets: Any,
) -> None:
    """What one value of an axis sets takes the place of all that was there."""
    plain, origins, _ = unwrap(sets, path)
    status = {path: origin.status for path, origin in origins.items()}
    why = {path: origin.why for path, origin in origins.items()}
    new = dict(leaves(plain, path))
    for leaf in {**dict.fromkeys(below.of(path)), **new}:
        if leaf not in varied:
            first = {base[leaf]: 0} if leaf in base else {}
            below.add(leaf)
            varied[leaf] = Varied(first, np.full(shape, len(first) - 1))
        values, at = varied[leaf]
        if leaf not in new:
            at[here] = -1
            continue
        row = parameter(leaf, new[leaf], *_origin(leaf, status, why, "varied"))
        at[here] = values.setdefault(row, len(values))


def parameter(path: str, value: Any, origin: str, because: str) -> Parameter:
    """A value in SI, read as a scene reads it, and as it is written."""
    number, unit = in_si(path, value)
    return Parameter(path, number, unit, _written(value), origin, because)


def _written(value: Any) -> str:
    return value if isinstance(value, str) else json.dumps(value)


@lru_cache(100_000, typed=True)  # True is not 1; samples are those of many studies
def in_si(path: str, value: Any) -> tuple[float | None, str | None]:
    """The SI value of what stands at a path of a scene, and its unit; None for text."""
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
    """How a scene reads text at a path, as its models say; several where it may be one of several."""
    kinds: list[tuple[Any, list[Any]]] = [(Scene, [])]
    for step in _steps(path):
        kinds = [inner for kind, _ in kinds for inner in _into(kind, step)]
    marks = [mark for _, metadata in kinds for mark in metadata]
    readers = [(mark.read, mark.name) for mark in marks if isinstance(mark, Unit)]
    percent = get_args(Percent)[1]
    return [*readers, *((mark.func, "1") for mark in marks if mark is percent)]


def _steps(path: str) -> Iterator[str | int]:
    """Names and indices of a dotted path."""
    for part in path.split("."):
        name, *indices = part.replace("]", "").split("[")
        yield name
        yield from map(int, indices)


def _into(kind: Any, step: str | int) -> Iterator[tuple[Any, list[Any]]]:
    """Types that stand one step below a type, with their metadata."""
    if isclass(kind) and issubclass(kind, BaseModel) and step in kind.model_fields:
        field = kind.model_fields[str(step)]
        yield from _apart(field.annotation, field.metadata)
    elif isinstance(step, int) and get_origin(kind) in (list, tuple):
        for item in get_args(kind):
            yield from _apart(item, [])
    elif get_origin(kind) is dict:
        yield from _apart(get_args(kind)[1], [])


def _apart(kind: Any, marks: list[Any]) -> Iterator[tuple[Any, list[Any]]]:
    """The types of a union, and of what is annotated, with the metadata of each."""
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
