"""Dotted paths in a scene, such as ``riser[0].drag.coefficient``: names, and indices in brackets."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import Any

Step = str | int
_STEP = re.compile(r"[A-Za-z_]\w*(\[(0|[1-9]\d{0,5})\])*")
_INDEX = re.compile(r"\[\d+\]")


@lru_cache(1024)
def steps(path: str) -> tuple[Step, ...]:
    """Names and indices of a path.

    Raises ValueError with the part of the text that is neither a name nor an index.
    """
    found: list[Step] = []
    for part in path.split("."):
        if not _STEP.fullmatch(part):
            raise ValueError(part)
        name, *indices = part.replace("]", "").split("[")
        found += [name, *map(int, indices)]
    return tuple(found)


def is_path(path: str) -> bool:
    """Whether a text has the form of a path, whether or not a scene has it."""
    return all(map(_STEP.fullmatch, path.split(".")))


def value_at(tree: Any, path: str) -> Any:
    """The value at a path; None where there is none, or where the text is not a path."""
    if not is_path(path):
        return None
    here = tree
    for step in steps(path):
        if isinstance(here, dict):
            here = here.get(step)
        elif isinstance(here, list) and isinstance(step, int) and step < len(here):
            here = here[step]
        else:
            return None
    return here


def put(tree: dict[str, Any], path: str, value: Any) -> None:
    """Put a value at a path; None removes the present value.

    Raises LookupError with the step of the path that does not exist.
    """
    *way, last = steps(path)
    here: Any = tree
    for step in way:
        if isinstance(here, dict) and step not in here and isinstance(step, str):
            here[step] = {}
        try:
            here = here[step]
        except (KeyError, IndexError, TypeError):
            raise LookupError(step) from None
    try:
        if value is None and isinstance(here, dict):
            here.pop(last, None)
        else:
            here[last] = value
    except (IndexError, TypeError):
        raise LookupError(last) from None


def leaves(tree: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Values of a tree by path; absent and empty parts have none."""
    if isinstance(tree, dict):
        for key, value in tree.items():
            yield from leaves(value, f"{path}.{key}" if path else str(key))
    elif isinstance(tree, list):
        for k, value in enumerate(tree):
            yield from leaves(value, f"{path}[{k}]")
    elif tree is not None:
        yield path, tree


def within(path: str, place: str) -> bool:
    """Whether a path is ``place`` or is below it."""
    return path == place or path.startswith((f"{place}.", f"{place}["))


def within_any(path: str, places: Iterable[str]) -> bool:
    """Whether a path is one of some places or is below it."""
    return any(within(path, place) for place in places)


def meets(one: str, other: str) -> bool:
    """Whether two paths are equal, or one is below the other."""
    return within(one, other) or within(other, one)


def and_above(path: str) -> Iterator[str]:
    """A path and all paths above it, the nearest first."""
    yield path
    for k in range(len(path) - 1, 0, -1):
        if path[k] in ".[":
            yield path[:k]


def parent(path: str) -> str:
    """The path without its last name; empty for a path of one name."""
    return path.rpartition(".")[0]


def last_name(path: str) -> str:
    """The last name of a path, with its indices."""
    return path.rpartition(".")[2]


def without_indices(path: str) -> str:
    """A path without its indices, the same for all sections, rows or cylinders."""
    return _INDEX.sub("", path)


def matches(path: str, pattern: str) -> bool:
    """Whether a path matches a pattern, in which ``[*]`` is any index."""
    return re.fullmatch(re.escape(pattern).replace(r"\[\*\]", r"\[\d+\]"), path) is not None


def as_name(path: str) -> str:
    """A path as the name of a variable or dimension: ``riser[0].mass`` is ``riser_0_mass``."""
    return re.sub(r"\W+", "_", path).strip("_")
