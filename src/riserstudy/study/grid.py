"""The scenes of a grid, each with its key in the store.

A part of a scene is checked and converted to text once for all points that share it. For each point, only the
check of its parts together and a hash remain.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import islice, product
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import create_model

from riserstudy.errors import InputError
from riserstudy.inputs.strict import Strict
from riserstudy.scene.load import SceneFile, first_step
from riserstudy.scene.parts import Parts
from riserstudy.scene.resolve import resolve
from riserstudy.scene.rules import check_rules
from riserstudy.scene.tables import fill_in_tables
from riserstudy.study.store import COUNTS, key_of, key_of_texts, text_of

Index = tuple[int, ...]
#: values that one value of an axis sets, by path
Sets = dict[str, Any]

REMEMBERED = 10_000  # number of cached parts, about 5 kB each

_FIELDS = Parts.model_fields
# for each part of a scene, a model that has only this part
_FIELD: dict[str, Any] = {name: (about.annotation, about) for name, about in _FIELDS.items()}
_ALONE = {name: create_model(name, __base__=Strict, **{name: _FIELD[name]}) for name in _FIELD}
_NOTHING: dict[str, Any] = dict.fromkeys(_FIELDS)
_EMPTY = Parts.model_construct(None, **_NOTHING)


@dataclass(frozen=True, slots=True)
class Point:
    """One point of a grid: its indices on the axes, and the key of its scene."""

    index: Index
    key: str


class Part(NamedTuple):
    """A checked part of a scene and its canonical text; None and "null" when it is absent."""

    value: Any
    text: str


@dataclass(frozen=True)
class Grid:
    """A scene varied along axes; later axes override earlier ones. ``layer`` names the grid in errors."""

    base: SceneFile
    axes: list[list[Sets]]
    layer: str

    def file(self, index: Index) -> SceneFile:
        """The scene at a point."""
        file = self.base
        for axis, k in zip(self.axes, index, strict=True):
            file = file.with_values(axis[k], self.layer)
        return file

    def __len__(self) -> int:
        return math.prod(len(axis) for axis in self.axes)

    @property
    def ends(self) -> tuple[Index, Index]:
        """Indices of the first and the last point."""
        lengths = [len(axis) for axis in self.axes]
        return tuple(0 for _ in lengths), tuple(length - 1 for length in lengths)

    def near_first(self, steps: Sequence[Iterable[int]]) -> list[Index]:
        """The first point, and the points that differ from it on one axis by the indices for that axis."""
        first = self.ends[0]
        moved = ((*first[:a], k, *first[a + 1 :]) for a, of in enumerate(steps) for k in of)
        return list(dict.fromkeys((first, *moved)))

    def points(self, first: int = 0, stride: int = 1) -> Iterator[Point]:
        """All points with the last axis varying fastest; or every ``stride``-th point from ``first`` on.

        Raises InputError when a point's scene is invalid.
        """
        part = lru_cache(REMEMBERED)(self._part)
        axes_of = {
            name: [number for number, axis in enumerate(self._sets) if any(name in v for v in axis)]
            for name in {*_FIELDS, *self.base.tree, *(n for a in self._sets for v in a for n in v)}
        }
        every = product(*(range(len(axis)) for axis in self.axes))
        for index in islice(every, first, None, stride):
            try:
                parts = {
                    name: part(name, tuple([(axis, index[axis]) for axis in axes]))
                    for name, axes in axes_of.items()
                }
                key = _key(parts)
            # the check of the whole scene has the best message
            except (ValueError, KeyError, InputError):
                key = key_of(self.file(index).resolved())
            yield Point(index, key)

    @cached_property
    def _sets(self) -> list[list[dict[str, Sets]]]:
        """Values that each value of each axis sets, by part of the scene."""
        return [[self._by_part(sets) for sets in axis] for axis in self.axes]

    def _by_part(self, sets: Sets) -> dict[str, Sets]:
        by_part: dict[str, Sets] = {}
        for path, value in sets.items():
            by_part.setdefault(first_step(path, self.layer), {})[path] = value
        return by_part

    @cached_property
    def _folder(self) -> Path:
        return Path(self.base.source).parent

    def _part(self, name: str, place: tuple[tuple[int, int], ...]) -> Part:
        """A part of the scene, checked alone, for some values of the axes."""
        file = SceneFile(self.base.source, {k: v for k, v in self.base.tree.items() if k == name})
        for axis, k in place:
            file = file.with_values(self._sets[axis][k].get(name, {}), self.layer)
        tree = file.tree
        if name not in tree and not _FIELDS[name].is_required():
            return Part(None, "null")
        value = getattr(_ALONE[name].model_validate(fill_in_tables(tree, self._folder, self.base.held)), name)
        return Part(value, text_of(value))


def _key(parts: dict[str, Part]) -> str:
    """Key of a scene of checked parts; ValueError when they do not fit together."""
    scene = _EMPTY.replaced(**{name: part.value for name, part in parts.items()})
    check_rules(scene)
    resolved = resolve(scene)  # may replace parts by derived ones
    replaced = [name for name in COUNTS if getattr(resolved, name) is not parts[name].value]
    texts = {name: parts[name].text for name in COUNTS}
    return key_of_texts(texts | {name: text_of(getattr(resolved, name)) for name in replaced})
