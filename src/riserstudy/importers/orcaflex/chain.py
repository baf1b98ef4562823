"""Find the lines of a deck that are the riser, its joint, the lines along it, or something else.

The riser is the path along lines from the object that tensioners pull, from a vessel or from a fixed point,
down to the ground. Its lines are joined at buoys without inertia, or at each other's ends.
"""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.importers.orcaflex.deck import Part
from riserstudy.importers.orcaflex.ends import GROUND, End, Line, line_of
from riserstudy.importers.orcaflex.pipe import greatest_diameter, lengths_of

BETWEEN = 0.01  # largest mass of a point between two lines that is left out (t)


class Roles(NamedTuple):
    """Lines by their role in a scene.

    ``riser`` and ``nodes`` are in order from the top. The nodes are the points at the ends of the lines, one
    more than there are lines.
    """

    riser: list[Line]
    nodes: list[str]
    joint: Line | None
    alongside: list[Line]


class Bearings(NamedTuple):
    """Names of a deck's objects: those that are fixed, that move as prescribed, and that are pulled."""

    ground: set[str]
    vessels: set[str]
    pulled: set[str]  # objects that links and winches are attached to
    sliding: dict[str, str]  # sliding constraints, and the objects in which they slide


def roles(deck: Part, on: Bearings) -> Roles:
    """Return the lines of a deck by their role.

    Raises InputError when no line is a riser, or more than one may be.
    """
    parts = deck.parts("Lines")
    lines: list[Line] = []
    for part in parts:
        with deck.noting():
            lines.append(line_of(part))
    if len(lines) < len(parts):
        raise deck.faults[-1]
    riser = _riser(deck, lines, on)
    nodes = [_top(line, lines) for line in riser] + [_node(riser[-1].lower, lines)]
    joint, alongside = None, []
    for line in [line for line in lines if line not in riser]:
        upper, lower = _top(line, lines), _node(line.lower, lines)
        # a line that slides in the ring may hang off the axis, where hoses and drape lines hang, too
        may_hang = line.upper.on_axis or (lower in on.sliding and not line.upper.y)
        hangs = upper in on.vessels | set(GROUND) and may_hang
        if hangs and on.sliding.get(lower, lower) == nodes[0] and joint is None:
            joint = line
        elif upper in nodes[:-1] and lower in {*nodes, *on.ground}:
            alongside.append(line)
        else:
            touches = [name for name in (upper, lower) if name in nodes and name not in on.ground]
            pulls = f"; its pull at {touches[0]!r} is left out too" if touches else ""
            line.part.apart = f"a line from {upper!r} to {lower!r} that is not part of the riser{pulls}"
    return Roles(riser, nodes, joint, alongside)


def _top(line: Line, lines: list[Line]) -> str:
    """Return the name of the point at a line's upper end; the name of the line if this end is free."""
    return line.name if line.upper.to == "Free" else _node(line.upper, lines)


def _node(end: End, lines: list[Line]) -> str:
    """Return the name of the point at an end: an object, or a line whose free upper end is there."""
    by_name = {line.name: line for line in lines}
    for _ in lines:
        if end.to not in by_name:
            break
        other = by_name[end.to]
        upper = end.of == other.part.text("TopEnd")
        if upper and other.upper.to == "Free":
            return other.name
        end = other.upper if upper else other.lower
    return end.to


def _riser(deck: Part, lines: list[Line], on: Bearings) -> list[Line]:
    """Return the lines of the riser, from the top."""
    found: list[tuple[int, list[Line]]] = []
    for line in lines:
        top = _top(line, lines)
        if top in on.pulled and line.upper.on_axis:
            rank = 0
        elif top in on.vessels:
            rank = 1
        elif line.upper.to in ("Free", *GROUND):
            rank = 2
        else:
            continue
        if way := _down(line, lines, on):
            found.append((rank, way))
    if not found:
        allowed = (
            "connect one line, or several end to end, from tensioners or a vessel to the ground "
            "(Fixed or Anchored), and give the upper end of each as TopEnd"
        )
        ends = [f"{line.name!r} from {line.upper.to!r} to {line.lower.to!r}" for line in lines]
        raise deck.refused("Lines", f"no line is a riser: {', '.join(ends)}", allowed)
    best = min(rank for rank, _ in found)
    ways = [way for rank, way in found if rank == best]
    widest = max(greatest_diameter(deck, way) for way in ways)
    ways = [way for way in ways if greatest_diameter(deck, way) == widest]
    if len(ways) > 1:
        names = " and ".join(repr(way[0].name) for way in ways)
        found_ = f"{len(ways)} of them may be the riser: {names}"
        allowed = "delete the others from a copy of the model, since a scene has one riser"
        raise deck.refused("Lines", found_, allowed)
    return ways[0]


def _down(line: Line, lines: list[Line], on: Bearings) -> list[Line]:
    """Return the longest path from a line down to the ground; empty if no path leads there."""
    lower = _node(line.lower, lines)
    if lower in on.ground:
        return [line]
    if lower in on.vessels or not line.lower.on_axis:
        return []
    others = [other for other in lines if other is not line]
    ways = [
        [line, *way]
        for other in others
        if other.upper.on_axis and _top(other, lines) == lower and (way := _down(other, others, on))
    ]
    return max(ways, key=lambda way: sum(map(depth, way)), default=[])


def depth(line: Line) -> float:
    """Return the unstretched length of a line (m)."""
    return sum(length for _, length in lengths_of(line.part))


def leave_out_points(deck: Part, names: list[str]) -> None:
    """Leave out the points between lines of the riser, which may have no mass to speak of."""
    buoys = deck.named("6DBuoys")
    for buoy in [buoys[name] for name in names if name in buoys]:
        mass = buoy.number("Mass")
        if mass > BETWEEN:
            allowed = (
                f"add this mass to a line type, or give at most {BETWEEN:g} t, since a scene has bodies only "
                "at the ends of the riser"
            )
            buoy.note(buoy.refused("Mass", f"{mass:g} t is a body within the riser", allowed))
        buoy.apart = f"a point between two lines of the riser; its mass of {mass:g} t is left out"
