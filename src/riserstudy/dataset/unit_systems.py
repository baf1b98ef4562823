"""Units in which results are shown: SI as stored, kN and MPa as on a rig, or feet and kips."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from enum import StrEnum
from functools import cache
from pathlib import Path
from typing import NamedTuple

DATA_FILES = ("unit_systems.yaml",)


class UnitSystem(StrEnum):
    """Systems of units."""

    SI = "si"
    FIELD = "field"
    US = "us"


class Reading(NamedTuple):
    """Conversion of a value: its factor, and the resulting unit."""

    factor: float
    unit: str


_SYSTEM: ContextVar[UnitSystem] = ContextVar("system of units", default=UnitSystem.FIELD)
#: units in limits, with the corresponding units in datasets
AS_STORED = {"N*m": "N m", "N/m^2": "Pa", "m/s": "m s-1", "kg/m": "kg m-1", "kg/m^3": "kg m-3"}


@contextmanager
def reading_in(system: UnitSystem) -> Iterator[None]:
    """Show values in a system of units within this context."""
    token = _SYSTEM.set(system)
    try:
        yield
    finally:
        _SYSTEM.reset(token)


def read_in(unit: str, system: UnitSystem | None = None) -> Reading:
    """Conversion of a unit of a dataset to a system of units, by default that of :func:`reading_in`."""
    known = systems()[system or _SYSTEM.get()]
    stored = AS_STORED.get(unit, unit)
    if density := re.fullmatch(r"(.+) Hz-1", stored):
        return _of_a_density(density[1], stored, known)
    entry = known.get(stored)
    return Reading(1.0 / entry[1], entry[0]) if entry else Reading(1.0, unit)


def _of_a_density(squared: str, stored: str, known: dict[str, tuple[str, float]]) -> Reading:
    """Conversion of a spectral density, whose unit is the quantity's unit squared / Hz: ``N2 m2 Hz-1``."""
    parts = [re.fullmatch(r"(\D+?)(-?\d+)?", part) for part in squared.split()]
    powers = [(p[1], int(p[2] or 1) // 2) for p in parts if p]
    plain = " ".join(name + (str(power) if power != 1 else "") for name, power in powers)
    entry = known.get(AS_STORED.get(plain, plain))
    return Reading(1.0 / entry[1] ** 2, f"({entry[0]})²/Hz") if entry else Reading(1.0, stored)


@cache
def systems() -> dict[str, dict[str, tuple[str, float]]]:
    """For each system and stored unit, the unit that is shown, and its size in stored units."""
    from riserstudy.inputs.plain_yaml import read_yaml  # slow to load

    tables = read_yaml(Path(__file__).with_name(DATA_FILES[0]), keep=True)
    return {
        name: {unit: (entry["unit"], float(entry["is"])) for unit, entry in table.items()}
        for name, table in tables.items()
    }
