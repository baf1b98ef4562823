"""The upper end of a deck's riser: tension ring, tensioners to deck or vessel, telescopic joint.

Tensioners are links (springs, straight or by a table) or winches of constant tension, all alike and evenly
around; the ring is a lumped buoy; the joint is a second line, on a constraint that slides along the ring.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from riserstudy.scene.orcaflex_deck import Part

LINKED = "Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionzRelativeTo"
WINCHED = "Connection, ConnectionX, ConnectionY, ConnectionZ"
SPRING = "SpringLength, SpringTension"
STAGES = "StageMode, StageValue"
FREEDOMS = "DOFFree, DOFInitialValue"


class Anchorage(NamedTuple):
    """What tensioners may be fastened to, and where the riser ends unstretched."""

    at_ring: set[str]  # names of the line, or of the ring
    decks: dict[str, float]  # elevation of what deck points count from (m), by its name
    ring: float  # elevation of the upper end, unstretched (m)


class Pull(NamedTuple):
    """One tensioner: its deck point (m, m, deg), radius of its ring point (m), and its law."""

    deck: tuple[float, float, float]  # radius, elevation, bearing
    ring_radius: float
    law: tuple[tuple[float, float], ...]  # reach (m) and pull (kN); one point: constant


def tensioners(parts: list[Part], of: Anchorage) -> dict[str, Any]:
    """Tensioners of a scene from links or winches.

    Raises
    ------
    InputError
        Where they are not alike, or not evenly around.
    """
    pulls = [
        _winch(part, of) if part.path.startswith("Winches") else _link(part, of) for part in parts
    ]
    count = len(pulls)
    first = pulls[0]
    bearings = sorted(pull.deck[2] for pull in pulls)
    even = all(abs(b - bearings[0] - 360.0 * k / count) < 1e-3 for k, b in enumerate(bearings))
    alike = {(*pull.deck[:2], pull.ring_radius, pull.law) for pull in pulls}
    if len(alike) > 1 or (first.deck[0] and not even):
        found = "links that differ, or are not evenly around the line"
        raise parts[0].refused("Connection", found, "allowed are equal ones, evenly on a circle")
    return {
        "count": count,
        "mid_stroke": "riser unstretched",
        **_law(first.law),
        "arrangement": {
            "ring_radius": _q(first.ring_radius, "m"),
            "deck_radius": _q(first.deck[0], "m"),
            "deck_elevation": _q(first.deck[1], "m"),
            "first_bearing": _q(bearings[0], "deg"),
        },
    }


def _law(law: tuple[tuple[float, float], ...]) -> dict[str, Any]:
    """A law of a scene: a straight line, or a table."""
    if len(law) == 1:
        return {"linear": {"tension": _q(law[0][1], "kN"), "stiffness": "0 kN/m"}}
    if len(law) > 2:
        rows = [{"reach": _q(reach, "m"), "force": _q(force, "kN")} for reach, force in law]
        return {"table": rows, "interpolation": "linear"}
    (low, at_low), (high, at_high) = law
    stiffness = (at_high - at_low) / (high - low)
    tension = at_low - stiffness * low
    derived = {"derived": _q(tension, "kN"), "from": "stretch of a link, the riser unstretched"}
    return {"linear": {"tension": derived, "stiffness": _q(stiffness, "kN/m")}}


def _between(
    part: Part, key: str, of: Anchorage
) -> tuple[tuple[float, float, float], float, float]:
    """Deck point, radius of the ring point (m) and the length between them, the riser unstretched (m)."""
    deck, ring = part.rows(key, 4)[:2]
    x, y, z = (float(v) for v in deck[1:4])
    a, b, c = (float(v) for v in ring[1:4])
    if str(deck[0]) not in of.decks or str(ring[0]) not in of.at_ring or c:
        found = f"from {deck[0]!r} to {ring[0]!r}"
        allowed = f"allowed is from {' or '.join(of.decks)} to the line's upper end"
        raise part.refused(key, found, allowed)
    bearing = math.degrees(math.atan2(y, x)) % 360.0
    inner, outer = math.hypot(a, b), math.hypot(x, y)
    if inner and abs(math.degrees(math.atan2(b, a)) % 360.0 - bearing) > 1e-3:
        raise part.refused(key, "points at other bearings", "allowed is that both are at one")
    height = z + of.decks[str(deck[0])]
    length = math.hypot(outer - inner, height - of.ring)
    return (round(outer, 6), round(height, 6), bearing), round(inner, 6), length


def _link(link: Part, of: Anchorage) -> Pull:
    kind = link.text("LinkType")
    if kind.lower() != "spring/damper":
        raise link.refused("LinkType", kind, "allowed is Spring/Damper")
    deck, ring, length = _between(link, LINKED if LINKED in link.data else WINCHED, of)
    if link.optional("Damping"):
        raise link.refused("Damping", str(link.optional("Damping")), "allowed is 0")
    if str(link.value("LinearSpring")) in ("True", "Yes"):
        stiffness = link.number("Stiffness")
        pull = stiffness * (length - link.number("UnstretchedLength"))
        law: tuple[tuple[float, float], ...] = (
            (0.0, round(pull, 6)),
            (1.0, round(pull + stiffness, 6)),
        )
    else:
        rows = [[float(v) for v in row[:2]] for row in link.rows(SPRING, 2)]
        law = tuple((round(reach - length, 6), force) for reach, force in rows)
    return Pull(deck, ring, law)


def _winch(winch: Part, of: Anchorage) -> Pull:
    """A winch that holds its tension."""
    winch.demand("WinchType", "Simple")
    winch.demand("WinchControlType", "By stage")
    if winch.optional("Damping"):
        raise winch.refused("Damping", str(winch.optional("Damping")), "allowed is 0")
    winch.optional("Stiffness")  # of the wire, whose tension is held
    deck, ring, _ = _between(winch, WINCHED, of)
    stages = {(str(mode), float(value)) for mode, value, *_ in winch.rows(STAGES, 2)}
    if len(stages) > 1 or next(iter(stages))[0] != "Specified tension":
        found = ", ".join(f"{mode} {value:g}" for mode, value in sorted(stages))
        raise winch.refused(STAGES, found, "allowed is one Specified tension at all stages")
    return Pull(deck, ring, ((0.0, next(iter(stages))[1]),))


def ring_of(buoy: Part, gravity: float, surface: float) -> dict[str, Any]:
    """The tension ring as a body at the riser's end: a lumped buoy by its mass, volume and drag.

    Gravity in m/s2, the water's surface an elevation (m).
    """
    buoy.demand("BuoyType", "Lumped buoy")
    buoy.demand("Connection", "Free")
    mass, volume = buoy.number("Mass"), buoy.number("Volume")
    *_, height = (float(v) for v in buoy.values("InitialPosition", 3))
    body: dict[str, Any] = {"name": buoy.text("Name"), "mass": _q(mass, "t")}
    if height >= surface:
        weight = _q(mass * gravity, "kN")
        body["submerged_weight"] = {"derived": weight, "from": "its mass: it is above the water"}
        return body
    body["displaced_volume"] = _q(volume, "m^3")
    area = [float(v) for v in buoy.optional("DragArea") or []]
    factor = [float(v) for v in buoy.optional("DragForceCoefficient") or []]
    drag = [a * c for a, c in zip(area, factor, strict=False)]
    if any(drag):
        if drag[0] != drag[1]:
            raise buoy.refused("DragArea", f"{area}", "allowed is the same along x and y")
        body["drag_area"] = {"horizontal": _q(drag[0], "m^2"), "vertical": _q(drag[2], "m^2")}
    return body


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
        raise constraint.refused(FREEDOMS, f"{_freedoms(constraint)}", "allowed is z alone")
    if constraint.optional("TranslationalStiffness"):
        found = str(constraint.optional("TranslationalStiffness"))
        raise constraint.refused("TranslationalStiffness", found, "allowed is 0: it slides freely")


def turns_in(constraint: Part) -> tuple[str, float, Any]:
    """A constraint that is a flex joint: what it stands on, its height over that (m), and its rotation.

    Raises
    ------
    InputError
        Where it moves otherwise.
    """
    if _freedoms(constraint) != [3, 4]:
        raise constraint.refused(
            FREEDOMS, f"{_freedoms(constraint)}", "allowed are Rx and Ry alone"
        )
    x, y, z = (float(v) for v in constraint.values("InFrameInitialPosition", 3))
    if x or y:
        raise constraint.refused("InFrameInitialPosition", f"{x}, {y}", "allowed is x = y = 0")
    constraint.demand("StiffnessAndDampingMethod", "Coefficients")
    stiffness = constraint.number("RotationalStiffness")
    rotation = {"stiffness": _q(stiffness, "kN*m/deg")} if stiffness else "free"
    return constraint.text("InFrameConnection"), z, rotation


def _freedoms(constraint: Part) -> list[int]:
    """Which of x, y, z, Rx, Ry, Rz are free, counted from 0."""
    constraint.demand("ConstraintType", "Calculated DOFs")
    rows = constraint.rows(FREEDOMS, 1)
    return [k for k, row in enumerate(rows) if str(row[0]) in ("True", "Yes")]


def _q(value: float, unit: str) -> str:
    return f"{value:.10g} {unit}"
