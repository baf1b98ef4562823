"""Line types of an OrcaFlex text model as properties of sections.

Decks of earlier versions give properties across a line as one entry per direction (``EIx``, ``EIy``). Later
decks give a list of three values, two across the line and one along it (``EI``, ``Cd``, ``Ca``), or for pipes
one entry (``Cdn``, ``Can``). The value along the line is the third of the list, or ``Cdz``, ``Caz``.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from riserstudy.importers.orcaflex.deck import CHANGE, GUESS, Part, q
from riserstudy.scene.modules_and_lines import disc

if TYPE_CHECKING:
    from riserstudy.importers.orcaflex.ends import Line

SAME = 1e-6  # m


def lengths_of(line: Part) -> list[tuple[str, float]]:
    """Return line types and lengths (m) of the sections of a line, from its end A.

    Raises InputError when there are none, or a length is invalid.
    """
    if line.has("LineType", "Length"):
        segments = ("TargetSegmentLength", "NumberOfSegments")
        rows = line.table("LineType", "Length", idle=segments)
    else:
        line.value("Sections")
        rows = []
        for part in line.parts("Sections"):
            rows.append([part.text("LineType"), part.number("Length")])
            part.optional("NumberOfSegments"), part.optional("TargetSegmentLength")
    for kind, length in rows:
        if isinstance(length, bool) or not isinstance(length, int | float) or not length > 0.0:
            found = f"the length {length!r} of {kind!r} is not above 0"
            raise line.refused("Length", found, "write lengths above 0")
    if not rows:
        raise line.refused("LineType, Length", "the line has no sections", "give one section or more")
    return [(str(kind), float(length)) for kind, length in rows]


def kind_of(deck: Part, line: Part, name: str) -> Part:
    """Return a line type by its name. Raises InputError where there is none."""
    types = deck.named("LineTypes")
    if name not in types:
        found = f"the model has no line type {name!r}"
        raise line.refused("LineType", found, f"use one of {', '.join(types)}")
    return types[name]


def greatest_diameter(deck: Part, way: list[Line]) -> float:
    """Return the largest outer diameter of the given lines (m)."""
    names = {name for line in way for name, _ in lengths_of(line.part)}
    types = deck.named("LineTypes")
    wide = [types[name].number("OD") for name in names if name in types]
    return max((diameter for diameter in wide if not math.isnan(diameter)), default=0.0)


def wall(kind: Part) -> dict[str, Any]:
    """Return diameters, stiffness and mass of a line type as fields of a section.

    Raises InputError when it has another category.
    """
    outer, inner = kind.number("OD"), kind.number("ID")
    fields: dict[str, Any] = {"outer_diameter": q(outer, "m"), "inner_diameter": q(inner, "m")}
    if kind.text("Category") == "Homogeneous pipe":
        fields["young_modulus"] = q(kind.number("E"), "kN/m^2")
        for key in ("CoatingThickness", "LiningThickness", "AdditionalEI"):
            kind.idle(key)
        mass: Any = {"derived": q(mass_of(kind), "kg/m"), "from": "MaterialDensity and diameters"}
    elif kind.text("Category") == "General":
        if stiff := bending_stiffness(kind):
            fields["bending_stiffness"] = q(stiff, "kN*m^2")
        fields["axial_stiffness"] = q(kind.number("EA"), "kN")
        mass = q(mass_of(kind), "kg/m")
    else:
        allowed = f"write General or Homogeneous pipe, or {CHANGE}"
        found = f"the import cannot convert the category {kind.text('Category')}"
        raise kind.refused("Category", found, allowed)
    return fields | {"mass": mass}


def stressed(kind: Part, filled: bool) -> dict[str, Any]:
    """Return the diameters of the load-bearing wall, if a line type gives one of them besides OD and ID.

    An empty diameter of the wall equals OD or ID. ``filled``: whether contents fill ID, which is then the
    inner diameter.
    """
    outer, inner = kind.given("StressOD"), kind.given("StressID")
    if not (outer or inner):
        return {}
    outer, inner = outer or kind.number("OD"), inner or kind.number("ID")
    if filled and abs(inner - kind.number("ID")) > SAME:
        words = f"the wall from {inner:g} to {outer:g} m is left out, because the contents fill ID"
        kind.otherwise["StressID"] = words
        return {}
    return {"outer_diameter": q(outer, "m"), "inner_diameter": q(inner, "m")}


def contents_of(line: Part) -> float:
    """Return the density of the contents of a line (t/m3); 0 if it has none.

    Contents that are not uniform, such as sea water in a free-flooding line, are recorded as an error.
    """
    if line.optional("ContentsMethod") is None and line.optional("ContentsDensity") is None:
        return 0.0
    line.demand("ContentsMethod", "Uniform")
    return line.given("ContentsDensity")


def mass_of(kind: Part) -> float:
    """Return the mass of a line type without contents (kg/m)."""
    if kind.data.get("Category") == "Homogeneous pipe":
        area = disc(kind.number("OD")) - disc(kind.number("ID"))
        return 1000.0 * kind.number("MaterialDensity") * area
    return 1000.0 * kind.number("MassPerUnitLength")


def submerged(kind: Part, density: float, gravity: float) -> dict[str, Any]:
    """Return the weight of a line type without contents in water of a density (kg/m3; 0 above water)."""
    weight = (mass_of(kind) - density * disc(kind.number("OD"))) * gravity
    less = "mass per length less the water that OD displaces" if density else "mass, in air"
    return {"derived": q(weight, "N/m"), "from": less}


def bending_stiffness(kind: Part) -> float:
    """Return the bending stiffness of a general line type (kN m2), equal in both directions.

    Raises InputError where there is none.
    """
    stiff = across(kind, "EI")
    if stiff is None:
        raise kind.refused("EIx", "EIx and EI are missing", GUESS)
    return stiff


def flexural(kind: Part) -> float:
    """Return the bending stiffness of any line type (kN m2). Raises InputError where there is none."""
    if kind.data.get("Category") != "Homogeneous pipe":
        return bending_stiffness(kind)
    second = math.pi / 64.0 * (kind.number("OD") ** 4 - kind.number("ID") ** 4)
    return kind.number("E") * second


def across(kind: Part, name: str) -> float | None:
    """Return a property across the line (EI in kN m2), equal in both directions; None if not given.

    Raises InputError when it is given twice, differs between the directions, or is not a number.
    """
    kind.alike(f"{name}x", f"{name}y")
    whole = kind.optional(name)
    if isinstance(whole, list):
        if len(whole) < 2 or whole[1] not in (None, "~", whole[0]):
            found = f"the list {', '.join(map(str, whole))} does not have two equal values"
            allowed = "write equal values, since a scene has one value for both directions across the line"
            raise kind.refused(name, found, allowed)
        whole = whole[0]
    given = [kind.optional(f"{name}x"), kind.optional(f"{name}n"), whole]
    return _one(kind, name, given, f"{name}, {name}x, {name}n")


def along(kind: Part, name: str) -> float:
    """Return a coefficient (1) along the line; 0 if the deck does not give it.

    Raises InputError when it is given twice, or is not a number.
    """
    whole = kind.optional(name)
    third = whole[2] if isinstance(whole, list) and len(whole) > 2 else None
    return _one(kind, f"{name}z", [kind.optional(f"{name}z"), third], f"{name}, {name}z") or 0.0


def _one(kind: Part, name: str, given: list[Any], names: str) -> float | None:
    """Return the only given number of a property that has several possible names."""
    values = [value for value in given if value not in (None, "~")]
    if len(values) > 1:
        allowed = f"keep only one of the names {names}"
        raise kind.refused(name, "the value is given twice", allowed)
    if values and (isinstance(values[0], bool) or not isinstance(values[0], int | float)):
        raise kind.refused(name, f"{values[0]!r} is not a number", "write a number")
    return float(values[0]) if values else None


def axial(kind: Part) -> float:
    """Return the axial stiffness of a line type (kN), as given or from modulus and wall."""
    if kind.data.get("Category") != "Homogeneous pipe":
        return kind.number("EA")
    return kind.number("E") * (disc(kind.number("OD")) - disc(kind.number("ID")))
