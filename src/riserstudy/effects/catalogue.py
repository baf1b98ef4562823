"""The list of all effects, read from the files in this folder."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pkgutil import iter_modules

import riserstudy.effects
from riserstudy.effects.registry import CALLED, Called, Change


@cache
def catalogue() -> dict[str, Called]:
    """Every effect by name, in alphabetical order."""
    for module in iter_modules(riserstudy.effects.__path__):
        import_module(f"{riserstudy.effects.__name__}.{module.name}")
    return {name: CALLED[name] for name in sorted(CALLED, key=str.lower)}


def changes() -> Iterator[Change]:
    """All changes that remove an effect from a scene, then all changes that add one."""
    every = [change for effect in catalogue().values() for change in effect.changes]
    yield from (change for change in every if change.kind == "removed")
    yield from (change for change in every if change.kind == "added")
