"""Units: text such as ``21 in`` or ``27 kN*m/deg`` is converted to SI, or refused."""

from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.percent import NUMBER

if TYPE_CHECKING:
    import pint

GRAVITY = 9.80665  # m/s2, standard acceleration
ATMOSPHERE = 101325.0  # Pa, absolute pressure minus gauge pressure
DATA_FILES = ("usual_units.json",)
#: factors of usual units from pint, by SI unit and name. They are stored because pint needs 0.4 s to start,
#: longer than the rest of planning a study. Written by workflow/scripts/make_reference.py.
USUAL = Path(__file__).with_name(DATA_FILES[0])

CYCLES = (["hertz"], ["millihertz"])

# Names, products and small exponents only: pint would try to compute 9**9**9**9.
_EXPONENT = r"(?:\s*(?:\^|\*\*)\s*-?\d{1,2}(?!\d))?"
_UNIT = re.compile(rf"(?:[^\W\d]\w*+{_EXPONENT}|\){_EXPONENT}|[°%*/(\s]|1(?=\s*/))*+")
LONGEST_UNIT = 60  # characters
MOST = 1e30  # SI units: above any real value, and its fourth power is still a finite number
UNKNOWN = "is not known"


class UnitFault(ValueError):
    """A unit that cannot be used.

    ``found``: continues a sentence about the unit, such as "is not known". ``of_value``: continues one about
    a value with this unit; absent: as ``found``. ``remedy``: for an ambiguous unit; absent: none.
    """

    def __init__(self, found: str, of_value: str = "", remedy: str = ""):
        self.found, self.of_value, self.remedy = found, of_value or found, remedy
        super().__init__(found)


@lru_cache(4096)
def to_si(text: str, unit: str) -> float:
    """Value of ``text`` in the SI unit ``unit``.

    Raises ValueError when the text is no finite number with a unit of the same dimension; the message states
    what was found and what is allowed.
    """
    allowed = f"write a number with a unit, such as '1 {unit}'"
    plain, offset = text.strip(), 0.0
    if unit == "Pa":
        allowed = "write an absolute or a gauge pressure, such as '190.2 bar absolute' or '1 Pa gauge'"
        kind = re.search(r"\b(absolute|gauge)$", plain)
        if not kind:
            raise Misfit("", f"{text!r} is marked neither 'absolute' nor 'gauge'", allowed)
        plain = plain[: kind.start()].strip()
        offset = ATMOSPHERE if kind.group() == "gauge" else 0.0
    number = NUMBER.match(plain)
    if not number:
        raise Misfit("", f"{text!r} does not start with a number", allowed)
    name = plain[number.end() :].strip()
    if not name:
        remedy = allowed if unit == "Pa" else f"write, for example, '{plain} {unit}'"
        raise Misfit("", f"{text!r} has no unit", remedy)
    try:
        value = float(number.group()) * _factor(name, unit) + offset
    except UnitFault as fault:
        raise Misfit("", f"{text!r} {fault.of_value}", fault.remedy or allowed) from None
    if not math.isfinite(value):
        raise Misfit("", f"{text!r} is not finite", allowed)
    if abs(value) > MOST:
        raise Misfit("", f"{text!r} is too large, {value:.3g} {unit}", f"give at most {MOST:g} {unit}")
    return value


def unit_factor(name: str, unit: str) -> float:
    """Conversion factor of a unit, in the notation of scenes, to an SI unit.

    Raises UnitFault when it is not known, has the wrong dimension, or is too large.
    """
    value = _factor(name.strip(), unit)
    if not value <= MOST:
        raise UnitFault(f"is larger than {MOST:g} {unit}")
    return value


def _factor(name: str, unit: str) -> float:
    """Conversion factor of a unit to its SI unit, from the stored table or from pint."""
    if name == unit:
        return 1.0
    if not name or len(name) > LONGEST_UNIT or not _UNIT.fullmatch(name):
        raise _unknown()
    known = usual_units().get(unit, {}).get(name)
    return factor(name, unit) if known is None else known


def _unknown() -> UnitFault:
    return UnitFault(UNKNOWN, f"has a unit that {UNKNOWN}")


@cache
def usual_units() -> dict[str, dict[str, float]]:
    """Conversion factors of usual units to SI, by SI unit and name."""
    table: dict[str, dict[str, float]] = json.loads(USUAL.read_text("utf-8"))
    return table


@cache
def factor(name: str, unit: str) -> float:
    """Conversion factor of a named unit to an SI unit, from pint.

    Raises UnitFault when pint does not know the unit, or the unit has the wrong dimension.
    """
    import pint

    for unclear, (meaning, remedy) in UNCLEAR.items():
        if found := re.search(unclear, name):
            which = f"{found.group()!r}, which means {meaning}"
            raise UnitFault(f"contains {which}", f"has the unit {which}", remedy)
    name = BARREL.sub("oil_barrel", name)
    try:
        given, wanted = _registry().parse_units(name), _registry().parse_units(unit)
        same = _angle_power(given._units) == _angle_power(wanted._units)
        value = _registry().Quantity(1.0, given).to(wanted).magnitude
        if unit == "rad/s" and list(given._units) in CYCLES:  # to pint a cycle is no angle
            same, value = True, value * math.tau
    except pint.DimensionalityError:
        raise UnitFault(f"has the wrong dimension{HINTS.get((name, unit), '')}") from None
    except Exception:
        raise _unknown() from None
    if odd := [name for name in given._units if _is_no_quantity(name)]:
        raise UnitFault(f"contains {odd[0]!r}, which is not a unit of a quantity")
    if not same:
        needed = "must contain" if _angle_power(wanted._units) else "must not contain"
        raise UnitFault(f"{needed} an angle, deg or rad")
    return float(value)


HINTS = {
    ("t", "N"): " (for a force write tf)",
    ("kip", "kg"): " (for a mass write lb)",
    ("lbf", "kg"): " (for a mass write lb)",
    ("lb", "N"): " (for a force write lbf)",
}
#: units of drilling and soils that pint does not have
OILFIELD = ("ppg = pound / US_liquid_gallon", "psf = force_pound / foot ** 2")
#: names of a barrel of 42 US gallons; to pint alone it has 31.5 gallons
BARREL = re.compile(r"\b(bbls?|barrels?)\b")
#: names that are easily taken for another unit: their meaning, and the remedy
UNCLEAR = {
    r"\bmt\b": ("a thousandth of a tonne", "write t or kg"),
    r"\btons?\b": ("1000 kg, 2000 lb or 2240 lb", "write t, short_ton or long_ton"),
    r"\b(ton_force|force_ton)s?\b": ("the weight of 1000 kg or of 2000 lb", "write tf or kip"),
}
#: dimensionless units that a scene may have
PLAIN = ("degree", "radian", "percent", "permille", "ppm")


@cache
def _registry() -> pint.UnitRegistry[float]:
    import pint

    registry: pint.UnitRegistry[float] = pint.UnitRegistry(on_redefinition="ignore")
    for definition in OILFIELD:
        registry.define(definition)
    return registry


def _is_no_quantity(name: str) -> bool:
    """Whether a dimensionless unit is neither angle nor share, such as pint's turn, pi or decibel."""
    return name not in PLAIN and not _registry().get_dimensionality(name)


def _angle_power(units: Any) -> int:
    """Power of plane angle in a unit; pint counts angles as dimensionless."""
    return int(sum(units.get(name, 0) for name in ("degree", "radian")))


@dataclass(frozen=True)
class Unit:
    """Marks a field whose input is text with a unit of this dimension; the field holds the SI value."""

    name: str

    def read(self, value: object) -> float:
        """The value of a field in its SI unit."""
        if isinstance(value, str):
            return to_si(value, self.name)
        number = value if isinstance(value, int | float) and not isinstance(value, bool) else 1
        raise Misfit("", f"{value!r} has no unit", f"write, for example, '{number} {self.name}'")

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_before_validator_function(self.read, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return {"type": "string", "description": f"number with a unit, such as '1 {self.name}'"}


Length = Annotated[float, Unit("m")]
Area = Annotated[float, Unit("m^2")]
Volume = Annotated[float, Unit("m^3")]
Mass = Annotated[float, Unit("kg")]
MomentOfInertia = Annotated[float, Unit("kg*m^2")]
MassPerLength = Annotated[float, Unit("kg/m")]
Density = Annotated[float, Unit("kg/m^3")]
Force = Annotated[float, Unit("N")]
ForcePerLength = Annotated[float, Unit("N/m")]
Stiffness = Annotated[float, Unit("N/m")]
ForcePerVolume = Annotated[float, Unit("N/m^3")]
QuadraticDrag = Annotated[float, Unit("N*s^2/m^2")]
Damping = Annotated[float, Unit("N*s/m")]
BendingStiffness = Annotated[float, Unit("N*m^2")]
RotationalDamping = Annotated[float, Unit("N*m*s/rad")]
RotationalDrag = Annotated[float, Unit("N*m*s^2/rad^2")]
Moment = Annotated[float, Unit("N*m")]
RotationalStiffness = Annotated[float, Unit("N*m/rad")]
Modulus = Annotated[float, Unit("N/m^2")]
Pressure = Annotated[float, Unit("Pa")]
Time = Annotated[float, Unit("s")]
Speed = Annotated[float, Unit("m/s")]
Acceleration = Annotated[float, Unit("m/s^2")]
Angle = Annotated[float, Unit("rad")]
Frequency = Annotated[float, Unit("rad/s")]
Ratio = Annotated[float, Unit("m/m")]
StressPerMoment = Annotated[float, Unit("Pa/N/m")]
AnglePerLength = Annotated[float, Unit("rad/m")]
