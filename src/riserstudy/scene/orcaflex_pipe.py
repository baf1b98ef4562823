"""Line types of an OrcaFlex text model as properties of sections.

What acts across a line is given as one entry a direction (``EIx``, ``EIy``) in decks of earlier versions, as
a list of both and of that along it (``EI``, ``Cd``, ``Ca``) or, for pipes, as one entry (``Cdn``, ``Can``)
in later ones.
"""

from __future__ import annotations

import math
from typing import Any

from riserstudy.scene.orcaflex_deck import Part


def properties(kind: Part, density: float, gravity: float) -> dict[str, Any]:
    """Fields of a section in water of a density (kg/m3)."""
    outer, inner = kind.number("OD"), kind.number("ID")
    area = 0.25 * math.pi * (outer**2 - inner**2)
    fields: dict[str, Any] = {"outer_diameter": _q(outer, "m"), "inner_diameter": _q(inner, "m")}
    if kind.text("Category") == "Homogeneous pipe":
        mass = 1000.0 * kind.number("MaterialDensity") * area
        fields["young_modulus"] = _q(kind.number("E"), "kN/m^2")
        fields["mass"] = {"derived": _q(mass, "kg/m"), "from": "MaterialDensity and diameters"}
    elif kind.text("Category") == "General":
        mass = 1000.0 * kind.number("MassPerUnitLength")
        fields["bending_stiffness"] = _q(bending_stiffness(kind), "kN*m^2")
        fields["axial_stiffness"] = _q(kind.number("EA"), "kN")
        fields["mass"] = _q(mass, "kg/m")
    else:
        allowed = "allowed are General, Homogeneous pipe"
        raise kind.refused("Category", kind.text("Category"), allowed)
    wet = (mass - density * 0.25 * math.pi * outer**2) * gravity
    fields["submerged_weight"] = {
        "derived": _q(wet, "N/m"), "from": "mass per length less the water that OD displaces",
    }  # fmt: skip
    drag, added = _across(kind, "Cd"), _across(kind, "Ca")
    wide = kind.optional("NormalDragLiftDiameter")
    if drag:
        fields["drag"] = {"coefficient": drag, "diameter": _q(float(wide or outer), "m")}
    if added:
        fields["added_mass"] = {"coefficient": added, "diameter": _q(outer, "m")}
    return fields


def bending_stiffness(kind: Part) -> float:
    """Bending stiffness (kN m2), the same in both directions."""
    stiff = _across(kind, "EI")
    if stiff is None:
        raise kind.refused("EIx", "missing, as EI is", "nothing is guessed; write it into the deck")
    return stiff


def _across(kind: Part, name: str) -> float | None:
    """What acts across the line, the same in both directions; None where the deck does not give it."""
    kind.alike(f"{name}x", f"{name}y")
    whole = kind.optional(name)
    if isinstance(whole, list):
        _alike(kind, name, whole)
        if len(whole) > 2 and whole[2] not in (None, "~", 0):
            kind.otherwise[name] = f"{whole[2]} along the line is left out"
        whole = whole[0]
    given = [kind.optional(f"{name}x"), kind.optional(f"{name}n"), whole]
    values = [value for value in given if value not in (None, "~")]
    if len(values) > 1:
        raise kind.refused(name, "given twice", f"allowed is one of {name}, {name}x, {name}n")
    if values and (isinstance(values[0], bool) or not isinstance(values[0], int | float)):
        raise kind.refused(name, repr(values[0]), "allowed is a number")
    return float(values[0]) if values else None


def _alike(kind: Part, name: str, whole: list[Any]) -> None:
    if len(whole) < 2 or whole[1] not in (None, "~", whole[0]):
        found = ", ".join(map(str, whole))
        raise kind.refused(name, found, "allowed is one value for both directions across the line")


def _q(value: float, unit: str) -> str:
    return f"{value:.10g} {unit}"
