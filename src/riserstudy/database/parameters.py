"""Parameters of the points of a study: every value of their scenes by path, in SI and as written.

A value that an axis sets replaces the value of the scene and of earlier axes, as in
``SceneFile.with_values``; here for all points of a grid at once.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.database.read_dataset import Grid
from riserstudy.scene.fields import in_si
from riserstudy.scene.origin import unwrap
from riserstudy.scene.paths import and_above, leaves, within

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
    """Numbered values of one path, and their numbers at the points of a study; -1 where it is absent."""

    values: dict[Parameter, int]
    at: NDArray[np.int64]


def parameters_of(attributes: Mapping[str, Any], grid: Grid) -> tuple[list[Parameter], list[Varied]]:
    """Return the parameters that are equal at all points of a study, and those that vary."""
    tree = json.loads(attributes["scene"])
    origins = json.loads(attributes["origins"])
    evidence = json.loads(attributes["evidence"])
    plain = "published" if tree.get("paper") else "given"
    tree = {name: value for name, value in tree.items() if name not in TITLES}
    base = {
        path: parameter(path, value, *_origin(path, origins, evidence, plain)) for path, value in leaves(tree)
    }
    varied: dict[str, Varied] = {}
    known = PathIndex([*base])
    for number, axis in enumerate(grid.axes):
        by_value = json.loads(axis.sets or "{}")
        for position, value in enumerate(axis.values):
            here = (*(slice(None),) * number, position)
            for path, sets in by_value.get(str(value), {}).items():
                _override(varied, base, known, grid.shape, here, path, sets)
    by_request = [v.values.reshape(grid.shape) for v in grid.variables if v.name == "by_request"]
    for where in by_request:
        for path, sets in json.loads(attributes["request"]).items():
            _override(varied, base, known, grid.shape, np.nonzero(where), path, sets)
    same = [parameter for path, parameter in base.items() if path not in varied]
    return same, [*varied.values()]


def _origin(
    path: str, origins: Mapping[str, str], evidence: Mapping[str, str], plain: str
) -> tuple[str, str]:
    """Return origin and evidence of a value: its own, or those of the nearest part that contains it."""
    for part in and_above(path):
        if part in origins:
            return origins[part], evidence.get(part, "")
    return plain, ""


class PathIndex:
    """All known paths below a path; the answers are cached until a new path is added."""

    def __init__(self, paths: list[str]) -> None:
        self._paths = dict.fromkeys(paths)
        self._found: dict[str, list[str]] = {}

    def below(self, path: str) -> list[str]:
        """Return the path itself, if known, and all known paths below it."""
        if path not in self._found:
            self._found[path] = [p for p in self._paths if within(p, path)]
        return self._found[path]

    def add(self, path: str) -> None:
        """Add a path."""
        if path not in self._paths:
            self._paths[path] = None
            self._found.clear()


def _override(
    varied: dict[str, Varied],
    base: Mapping[str, Parameter],
    known: PathIndex,
    shape: tuple[int, ...],
    here: tuple[Any, ...],
    path: str,
    sets: Any,
) -> None:
    """Replace all values at and below a path by those that one value of an axis sets."""
    plain, origins, _ = unwrap(sets, path)
    status = {path: origin.status for path, origin in origins.items()}
    why = {path: origin.why for path, origin in origins.items()}
    new = dict(leaves(plain, path))
    for leaf in {**dict.fromkeys(known.below(path)), **new}:
        if leaf not in varied:
            first = {base[leaf]: 0} if leaf in base else {}
            known.add(leaf)
            varied[leaf] = Varied(first, np.full(shape, len(first) - 1))
        values, at = varied[leaf]
        if leaf not in new:
            at[here] = -1
            continue
        row = parameter(leaf, new[leaf], *_origin(leaf, status, why, "varied"))
        at[here] = values.setdefault(row, len(values))


def parameter(path: str, value: Any, origin: str, because: str) -> Parameter:
    """Return a value both in SI, parsed as in a scene, and as written."""
    number, unit = in_si(path, value)
    written = value if isinstance(value, str) else json.dumps(value)
    return Parameter(path, number, unit, written, origin, because)
