"""Constraints of a deck that are parts of a riser: a joint that slides, a flex joint that turns."""

from __future__ import annotations

from typing import Any

from riserstudy.importers.orcaflex.deck import Part
from riserstudy.importers.orcaflex.ends import rotation


def slides_in(constraint: Part, ring: str) -> None:
    """See that a constraint is a telescopic joint: in the ring, free along z alone, without stiffness.

    Raises
    ------
    InputError
        Where it is something else.
    """
    if constraint.text("InFrameConnection") != ring:
        found = f"in {constraint.text('InFrameConnection')!r}"
        raise constraint.refused("InFrameConnection", found, f"allowed is the ring, {ring!r}")
    if _freedoms(constraint) != [2]:
        raise constraint.refused("DOFFree", f"{_freedoms(constraint)}", "allowed is z alone")
    stiffness = constraint.optional("TranslationalStiffness")
    if stiffness:
        allowed = "allowed is 0: it slides freely"
        raise constraint.refused("TranslationalStiffness", str(stiffness), allowed)


def guided_by(constraint: Part) -> tuple[str, float]:
    """A constraint that lets an end go up and down: what it is in, and its place along x there (m).

    Raises
    ------
    InputError
        Where it moves otherwise.
    """
    if _freedoms(constraint) != [2]:
        raise constraint.refused("DOFFree", f"{_freedoms(constraint)}", "allowed is z alone")
    constraint.idle("TranslationalStiffness")
    constraint.idle("TranslationalDamping")
    x, y, _ = constraint.vector("InFrameInitialPosition")
    if y:
        raise constraint.refused("InFrameInitialPosition", f"y = {y:g}", "allowed is y = 0")
    return constraint.text("InFrameConnection"), x


def turns_in(constraint: Part) -> tuple[str, float, Any]:
    """A constraint that is a flex joint: what it stands on, its height over that (m), and its rotation.

    Raises
    ------
    InputError
        Where it moves otherwise.
    """
    if _freedoms(constraint) != [3, 4]:
        raise constraint.refused(
            "DOFFree", f"{_freedoms(constraint)}", "allowed are Rx and Ry alone"
        )
    x, y, z = constraint.vector("InFrameInitialPosition")
    if x or y:
        raise constraint.refused("InFrameInitialPosition", f"{x}, {y}", "allowed is x = y = 0")
    constraint.idle("StiffnessAndDampingMethod", "Coefficients")
    stiffness = constraint.number("RotationalStiffness")
    return constraint.text("InFrameConnection"), z, rotation(stiffness or None)


def _freedoms(constraint: Part) -> list[int]:
    """Which of x, y, z, Rx, Ry, Rz are free, counted from 0."""
    constraint.demand("ConstraintType", "Calculated DOFs")
    rows = constraint.table("DOFFree", idle=("DOFInitialValue",))
    return [k for k, row in enumerate(rows) if str(row[0]) in ("True", "Yes")]
