"""Check that the ends of lines that meet in one point of a scene meet in one point of the deck.

A line may be connected anywhere to an object, and at any angle; the riser of a scene is straight and whole.
"""

from __future__ import annotations

from itertools import pairwise

from riserstudy.importers.orcaflex.chain import Roles
from riserstudy.importers.orcaflex.ends import PLACE, SAME, End, Line, upright

ONE_POINT = "since they are one point in a scene"


def meet(cast: Roles) -> None:
    """Record an error where ends of the riser, or of the joint above it, have a distance or an angle."""
    for upper, lower in pairwise(cast.riser):
        for line, end, other in ((upper, upper.lower, lower.upper), (lower, lower.upper, upper.lower)):
            upright(line, end)
            _at_one_height(line, end, other, {upper.name, lower.name})
    joint, top = cast.joint, cast.riser[0]
    if joint is not None:
        upright(joint, joint.lower)
        _at_one_height(joint, joint.lower, top.upper, {top.name})
        _at_one_height(top, top.upper, joint.lower, {joint.name})
        if not joint.lower.on_axis:
            x, y = joint.lower.x, joint.lower.y
            found = f"the lower end is at x, y = {x:g}, {y:g} m of {joint.lower.to!r}"
            allowed = f"write x = y = 0 for this end and for the upper end of {top.name!r}, {ONE_POINT}"
            joint.part.note(joint.part.refused(PLACE[1], found, allowed))


def _at_one_height(line: Line, end: End, other: End, lines: set[str]) -> None:
    """Record an error where an end is above or below another one, to which it or both are connected.

    ``lines``: names of lines at whose ends an end may be.
    """
    if end.to in lines:
        apart, place = end.z, f"the end of {end.to!r}"
    elif end.to == other.to != "Free":
        apart, place = end.z - other.z, "the end of the other line there"
    else:
        return
    if abs(apart) > SAME:
        found = f"the end at {end.to!r} is {apart:+.6g} m above {place}"
        line.part.note(line.part.refused(PLACE[3], found, f"connect both ends at one z, {ONE_POINT}"))


def heights(cast: Roles) -> dict[str, float]:
    """Return the z of the riser in the axes of the objects at the ends of its lines (m), by their names."""
    ends = [(line.upper, line.lower) for line in cast.riser]
    found: dict[str, float] = {}
    for name, end in zip(cast.nodes[1:], [lower for _, lower in ends], strict=True):
        found[name] = end.z if end.to == name else 0.0
    for name, end in zip(cast.nodes, [upper for upper, _ in ends], strict=False):
        if end.to == name:
            found[name] = end.z
    return found
