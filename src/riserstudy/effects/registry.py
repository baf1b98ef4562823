"""Which function of an effect does what in a simulation."""

from __future__ import annotations

from collections.abc import Callable

from riserstudy.solve.evaluate import Programs

ROLES: dict[type, dict[str, Callable]] = {}


def register(record: type, **functions: Callable) -> None:
    """Say what the functions of an effect are for; the roles are the fields of ``Programs``."""
    if unknown := set(functions) - set(Programs._fields):
        raise TypeError(f"{record.__name__}: no such role: {', '.join(sorted(unknown))}")
    if ("mass" in functions) != ("lump" in functions):
        raise TypeError(f"{record.__name__}: mass and lump come together")
    ROLES[record] = functions
