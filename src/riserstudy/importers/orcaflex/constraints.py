"""Constraints of a deck that are parts of a riser: a telescopic joint or a flex joint."""

from __future__ import annotations

from typing import Any

from riserstudy.importers.orcaflex.deck import Part
from riserstudy.importers.orcaflex.ends import rotation


def slides_in(constraint: Part, ring: str) -> None:
    """Check that a constraint is a telescopic joint: in the ring, free only along z, without stiffness.

    Raises InputError when it is something else.
    """
    if constraint.text("InFrameConnection") != ring:
        found = f"the constraint is connected to {constraint.text('InFrameConnection')!r}"
        allowed = f"connect it to {ring!r}, since the telescopic joint of a scene slides in the tension ring"
        raise constraint.refused("InFrameConnection", found, allowed)
    if _freedoms(constraint) != [2]:
        allowed = "free z alone, since a telescopic joint slides along its axis and does not turn"
        raise constraint.refused("DOFFree", _named(constraint), allowed)
    x, y, _ = constraint.components("InFrameInitialPosition")
    if x or y:
        allowed = "write x = y = 0, since a telescopic joint slides on the axis of the riser"
        raise constraint.refused("InFrameInitialPosition", f"x, y = {x:g}, {y:g} m", allowed)
    stiffness = constraint.optional("TranslationalStiffness")
    if stiffness:
        allowed = "write 0, since a telescopic joint of a scene slides freely"
        raise constraint.refused("TranslationalStiffness", f"the stiffness is {stiffness}", allowed)


def guided_by(constraint: Part) -> tuple[str, float]:
    """Return the parent of a constraint that leaves an end free vertically, and its x in the parent (m).

    Raises InputError where it moves otherwise.
    """
    if _freedoms(constraint) != [2]:
        allowed = "free z alone, since the upper end of a riser below a vessel moves vertically"
        raise constraint.refused("DOFFree", _named(constraint), allowed)
    constraint.idle("TranslationalStiffness")
    constraint.idle("TranslationalDamping")
    x, y, _ = constraint.vector("InFrameInitialPosition")
    if y:
        allowed = "write y = 0, since the offset of an upper end in a scene is along x"
        raise constraint.refused("InFrameInitialPosition", f"y = {y:g} m", allowed)
    return constraint.text("InFrameConnection"), x


def turns_in(constraint: Part) -> tuple[str, float, Any]:
    """Return the parent of a constraint that is a flex joint, its height above it (m), and its rotation.

    Raises InputError where it moves otherwise.
    """
    if _freedoms(constraint) != [3, 4]:
        allowed = "free Rx and Ry alone, since this constraint becomes the lower flex joint"
        raise constraint.refused("DOFFree", _named(constraint), allowed)
    x, y, z = constraint.vector("InFrameInitialPosition")
    if x or y:
        allowed = "write x = y = 0, since the lower end of the riser of a scene is on the z axis"
        raise constraint.refused("InFrameInitialPosition", f"x, y = {x:g}, {y:g} m", allowed)
    constraint.idle("StiffnessAndDampingMethod", "Coefficients")
    stiffness = constraint.number("RotationalStiffness", endless=True)
    return constraint.text("InFrameConnection"), z, rotation(stiffness or None)


def _named(constraint: Part) -> str:
    """Return the names of the free directions of a constraint."""
    names = ("x", "y", "z", "Rx", "Ry", "Rz")
    return f"free: {', '.join(names[k] for k in _freedoms(constraint)) or 'none'}"


def _freedoms(constraint: Part) -> list[int]:
    """Return which of x, y, z, Rx, Ry, Rz are free, counted from 0."""
    constraint.demand("ConstraintType", "Calculated DOFs")
    rows = constraint.table("DOFFree", idle=("DOFInitialValue",))
    return [k for k, row in enumerate(rows) if str(row[0]) in ("True", "Yes")]
