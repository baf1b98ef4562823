"""Names of units of results, in the notation of CF (``kN s2 m-2``) or of scenes (``kN*s^2/m^2``)."""

from __future__ import annotations

import math
import re
from functools import cache
from typing import Annotated

from pydantic import AfterValidator

from riserstudy.inputs.misfit import Misfit

PLAIN = ("", "1", "%")
_CF = re.compile(r"(?<=[A-Za-z])(-?\d{1,2})\b")  # an exponent without a sign of power
_NAMES = re.compile(r"[A-Za-z%°/*^()\s\d-]+")
#: units that need no library to be known; others are looked up in pint, which takes half a second to start
USUAL = "N|kN|MN|m|kg|t|s|h|min|year|Hz|Pa|kPa|MPa|bar|rad|deg|degree"
_USUAL = re.compile(rf"(1/)?(?:{USUAL})(?:\^-?\d)?(?:[*/](?:{USUAL})(?:\^-?\d)?)*")


def scene_notation(name: str) -> str:
    """A unit in the notation of scenes: ``kN s2 m-2`` becomes ``kN*s^2*m^-2``, ``m2/s`` becomes ``m^2/s``."""
    return "*".join(_CF.sub(r"^\1", name).split()).replace("*/*", "/")


def known_unit(name: str) -> str:
    """A unit of a published value or of a variable.

    Raises Misfit when the unit is not known, or has two meanings.
    """
    text = scene_notation(name)
    if name not in PLAIN and not _USUAL.fullmatch(text):
        _look_up(name, text)
    return name


def factor_between(one: str, other: str) -> float:
    """Number of the unit ``other`` in the unit ``one``, which are known; NaN if their dimensions differ."""
    if one == other:
        return 1.0
    from riserstudy.scene.units import UnitFault, factor

    one, other = ({"": "1", "%": "percent"}.get(name) or scene_notation(name) for name in (one, other))
    try:
        return factor("dimensionless" if one == "1" else one, "dimensionless" if other == "1" else other)
    except UnitFault:
        return math.nan


@cache
def _look_up(name: str, text: str) -> None:
    """Look a unit up in pint, by the conversion to itself; raises Misfit when it is not there."""
    # the grader loads no scenes unless it must
    from riserstudy.scene.units import LONGEST_UNIT, UnitFault, factor, usual_units

    allowed = "write a unit such as 'kN m' or 'm/s', or '1' for a number without a unit"
    if any(text in names for names in usual_units().values()):
        return
    if len(text) > LONGEST_UNIT or "//" in text or not _NAMES.fullmatch(text):
        raise Misfit("", f"{name!r} is not a known unit", allowed)
    try:
        factor(text, text)
    except UnitFault as fault:
        found = f"{name!r} {fault.found if fault.remedy else 'is not a known unit'}"
        raise Misfit("", found, fault.remedy or allowed) from None


UnitName = Annotated[str, AfterValidator(known_unit)]
