"""Units at the door: text such as ``21 in`` or ``27 kN*m/deg`` becomes SI, or is refused."""

from __future__ import annotations

import math
import re
from functools import cache
from typing import Annotated, Any

import pint
from pydantic import BeforeValidator, WithJsonSchema

ATMOSPHERE = 101325.0  # Pa, what a gauge pressure leaves out

_NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


@cache
def _registry() -> pint.UnitRegistry:
    return pint.UnitRegistry()


def _angle_power(units: Any) -> int:
    """Power of plane angle in a unit, which pint itself counts as dimensionless."""
    return int(sum(units.get(name, 0) for name in ("degree", "radian")))


@cache
def to_si(text: str, unit: str) -> float:
    """Value of ``text`` in the SI unit ``unit``.

    Raises
    ------
    ValueError
        When the text is no finite number with a unit of the same dimension; the message says what
        was found and what is allowed.
    """
    allowed = f"allowed is a number with a unit such as '1 {unit}'"
    plain, offset = text.strip(), 0.0
    if unit == "Pa":
        allowed = "allowed is a pressure that says which, such as '190.2 bar absolute' or '1 Pa gauge'"
        kind = re.search(r"\b(absolute|gauge)$", plain)
        if not kind:
            raise ValueError(f"{text!r} says neither absolute nor gauge; {allowed}")
        plain = plain[: kind.start()].strip()
        offset = ATMOSPHERE if kind.group() == "gauge" else 0.0
    number = _NUMBER.match(plain)
    if not number:
        raise ValueError(f"{text!r} does not start with a number; {allowed}")
    name = plain[number.end() :].strip()
    if not name:
        raise ValueError(f"{text!r} has no unit; {allowed}")
    try:
        given = _registry().parse_units(name)
        wanted = _registry().parse_units(unit)
        same = _angle_power(given._units) == _angle_power(wanted._units)
        value = _registry().Quantity(float(number.group()), given).to(wanted).magnitude + offset
    except pint.DimensionalityError:
        hint = " (for a force write tf)" if name == "t" and unit == "N" else ""
        raise ValueError(f"{text!r} has another dimension{hint}; {allowed}") from None
    except Exception:
        raise ValueError(f"{text!r} has a unit that is not known; {allowed}") from None
    if not same:
        raise ValueError(f"{text!r} must say '/deg' or '/rad', deg or rad; {allowed}")
    if not math.isfinite(value):
        raise ValueError(f"{text!r} is not finite; {allowed}")
    return float(value)


def quantity(unit: str) -> Any:
    """Type of a field that takes text with a unit and holds the SI value."""

    def read(value: object) -> float:
        if isinstance(value, str):
            return to_si(value, unit)
        if isinstance(value, _Si):
            return float(value)
        raise ValueError(f"{value!r} has no unit; allowed is text such as '1 {unit}'")

    schema = {"type": "string", "description": f"number with a unit, such as '1 {unit}'"}
    return Annotated[float, BeforeValidator(read), WithJsonSchema(schema)]


class _Si(float):
    """A number known to be SI already: how a checked scene is read back."""


def _percent(value: object) -> float:
    if isinstance(value, str) and (m := re.fullmatch(r"\s*([0-9.eE+-]+)\s*%\s*", value)):
        return float(m.group(1)) / 100.0
    raise ValueError(f"{value!r} is no percentage; allowed is text such as '1 %'")


Percent = Annotated[float, BeforeValidator(_percent), WithJsonSchema({"type": "string"})]
Length = quantity("m")
Area = quantity("m^2")
Volume = quantity("m^3")
Mass = quantity("kg")
MassPerLength = quantity("kg/m")
Density = quantity("kg/m^3")
Force = quantity("N")
ForcePerLength = quantity("N/m")
Stiffness = quantity("N/m")
Damping = quantity("N*s/m")
BendingStiffness = quantity("N*m^2")
RotationalStiffness = quantity("N*m/rad")
Modulus = quantity("N/m^2")
Pressure = quantity("Pa")
Time = quantity("s")
Speed = quantity("m/s")
Acceleration = quantity("m/s^2")
Angle = quantity("rad")
