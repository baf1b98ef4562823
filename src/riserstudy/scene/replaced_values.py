"""Values that a later value replaces, and that would therefore have no effect."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.paths import within, within_any


def replaced(paths: Iterable[str]) -> tuple[str, str] | None:
    """The first path that a later path contains, and this later path; None if every value has an effect.

    ``paths``: paths of a scene in the order in which their values are set. A path below an earlier path is
    set in the new value of the earlier path, so both values have an effect.
    """
    before: list[str] = []
    for later in paths:
        for path in before:
            if within(path, later):
                return path, later
        before.append(later)
    return None


def set_later(sets: dict[str, Any], later: dict[str, Any]) -> dict[str, Any]:
    """Values by path, with later values in place of those at and below their paths."""
    return {path: v for path, v in sets.items() if not within_any(path, later)} | later


def check_sets(sets: dict[str, Any]) -> dict[str, Any]:
    """Check that each value, by path, has an effect; returns the values.

    Raises Misfit with the path of a value that a later value replaces.
    """
    if lost := replaced(sets):
        path, later = lost
        raise Misfit(path, f"{later!r}, which is set after it, replaces it", "remove one of the two")
    return sets
