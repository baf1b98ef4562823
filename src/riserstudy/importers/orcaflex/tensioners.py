"""Tensioners of a deck: links that are linear or tabulated springs, or winches with constant tension.

All must be equal and evenly arranged around the riser, from points of a deck or vessel to the tension ring.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from riserstudy.importers.orcaflex.deck import CHANGE, Part, q
from riserstudy.importers.orcaflex.ends import PLACE, SAME

ALONG = "ConnectionzRelativeTo"


class Anchorage(NamedTuple):
    """Objects that tensioners may be attached to, and the unstretched upper end of the riser."""

    at_ring: set[str]  # names of the line and of the ring
    line: str  # name of the uppermost line of the riser
    decks: dict[str, float]  # elevation of the origin of deck points (m), by the object's name
    ring: float  # elevation of the upper end, unstretched (m)
    top_end: str  # end of the line that is the upper one
    aside: float = 0.0  # x of the vertical axis for bearings and radii of deck points (m)
    level: float = 0.0  # z of the upper end of the riser in the axes of the ring (m)


class Pull(NamedTuple):
    """One tensioner: its deck point (m, m, deg), radius of its ring point (m), its law and damping."""

    deck: tuple[float, float, float]  # radius, elevation, bearing
    ring_radius: float
    law: tuple[tuple[float, float], ...]  # reach (m) and pull (kN); one point: constant
    damping: float  # kN s/m

    @property
    def idle(self) -> bool:
        """Whether it never pulls, like a failed cylinder."""
        return not self.damping and all(force == 0.0 for _, force in self.law)


def fastened(part: Part) -> list[str]:
    """Return the objects that a link or winch is attached to.

    Raises InputError when it does not have two ends.
    """
    rows = part.table(*PLACE, of=(ALONG,))
    if len(rows) < 2:
        raise part.refused(PLACE[0], f"the link or winch has {len(rows)} ends", "give two ends")
    return [str(row[0]) for row in rows]


def tensioners(parts: list[Part], of: Anchorage) -> dict[str, Any]:
    """Return the tensioners of a scene from links or winches.

    Raises InputError when they are not equal, or not evenly arranged.
    """
    pulls = []
    for part in parts:
        with part.noting():
            pulls.append(_winch(part, of) if part.path.startswith("Winches") else _link(part, of))
    if len(pulls) < len(parts):
        raise parts[0].faults[-1]
    count = len(pulls)
    if not _evenly(pulls):
        pulls.sort(key=lambda pull: pull.deck[2])
    failed = [k for k, pull in enumerate(pulls) if pull.idle]
    first = next((pull for pull in pulls if not pull.idle), pulls[0])
    alike = {(pull.law, pull.damping) for pull in pulls if not pull.idle}
    places = {(*pull.deck[:2], pull.ring_radius) for pull in pulls}
    if max(len(alike), len(places)) > 1 or ((first.deck[0] or first.ring_radius) and not _evenly(pulls)):
        found = "the links differ, or are not spaced evenly around the line"
        allowed = "give equal links, spaced evenly on a circle, or " + CHANGE
        raise parts[0].refused("Connection", found, allowed)
    damping = {"damping": q(first.damping, "kN*s/m")} if first.damping else {}
    made = {
        "count": count,
        "mid_stroke": "riser unstretched",
        **_law(first.law),
        **damping,
        **({"failed": failed} if failed else {}),
    }
    return made | {
        "arrangement": {
            "ring_radius": q(first.ring_radius, "m"),
            "deck_radius": q(first.deck[0], "m"),
            "deck_elevation": q(first.deck[1], "m"),
            "first_bearing": q(pulls[0].deck[2], "deg"),
        }
    }


def _evenly(pulls: list[Pull]) -> bool:
    """Return whether each tensioner is one equal spacing further round than the previous one."""
    bearings = [pull.deck[2] for pull in pulls]
    steps = [b - bearings[0] - 360.0 * k / len(pulls) for k, b in enumerate(bearings)]
    return all(abs(math.remainder(step, 360.0)) < 1e-3 for step in steps)


class Constant(NamedTuple):
    """A constant vertical pull (kN), from an elevation (m)."""

    force: float
    height: float


def constant(parts: list[Part], of: Anchorage) -> Constant | None:
    """Return the pull of a single winch vertically above its object; None for anything else."""
    if len(parts) != 1 or not parts[0].path.startswith("Winches"):
        return None
    pull = _winch(parts[0], of)
    return None if pull.deck[0] else Constant(pull.law[0][1], pull.deck[1])


def _law(law: tuple[tuple[float, float], ...]) -> dict[str, Any]:
    """Return the law for a scene: a straight line or a table."""
    if len(law) == 1:
        return {"linear": {"tension": q(law[0][1], "kN"), "stiffness": "0 kN/m"}}
    if len(law) > 2:
        rows = [{"reach": q(reach, "m"), "force": q(force, "kN")} for reach, force in law]
        return {"table": rows, "interpolation": "linear"}
    (low, at_low), (high, at_high) = law
    stiffness = (at_high - at_low) / (high - low)
    tension = at_low - stiffness * low
    derived = {"derived": q(tension, "kN"), "from": "stretch of a link while the riser is unstretched"}
    return {"linear": {"tension": derived, "stiffness": q(stiffness, "kN/m")}}


def _between(part: Part, of: Anchorage) -> tuple[tuple[float, float, float], float, float]:
    """Return deck point, radius of the ring point (m), and their distance with an unstretched riser (m)."""
    names = fastened(part)
    points = part.figures(*PLACE[1:], idle=(PLACE[0], ALONG))
    ends = list(zip(names, points, strict=True))[:2]
    (deck, (x, y, z)), (ring, (a, b, c)) = ends if names[0] in of.decks else ends[::-1]
    if deck not in of.decks or ring not in of.at_ring:
        found = f"the link or winch is connected from {deck!r} to {ring!r}"
        allowed = f"connect it from {' or '.join(of.decks)} to the upper end of the riser"
        raise part.refused(PLACE[0], found, allowed)
    if abs(above := c - (0.0 if ring == of.line else of.level)) > SAME:
        found = f"the link or winch ends {above:+.6g} m above the upper end of the riser"
        allowed = "connect both at one z, since cylinders of a scene pull at the upper end of the riser"
        raise part.refused(PLACE[3], found, allowed)
    _at_the_top(part, of)
    x -= of.aside
    inner, outer = (round(math.hypot(*place), 6) for place in ((a, b), (x, y)))
    bearing = math.degrees(math.atan2(y, x) if outer else math.atan2(b, a)) % 360.0
    if inner and abs(math.remainder(math.degrees(math.atan2(b, a)) - bearing, 360.0)) > 1e-3:
        allowed = "place both ends of a tensioner at one bearing around the riser"
        raise part.refused(PLACE[0], "the two ends have different bearings around the riser", allowed)
    if part.optional("ReleaseStage") is not None:
        found = f"the tensioner is released in stage {part.optional('ReleaseStage')}"
        allowed = "remove the release from the model, since the import keeps tensioners connected"
        part.note(part.refused("ReleaseStage", found, allowed))
    height = z + of.decks[deck]
    length = math.hypot(outer - inner, height - of.ring)
    return (outer, round(height, 6), bearing), inner, length


def _at_the_top(part: Part, of: Anchorage) -> None:
    """Record an error where a tensioner is at the lower end of the riser's line."""
    for name, end in part.table(PLACE[0], of=(ALONG,), idle=PLACE):
        if str(name) == of.line and end not in (None, of.top_end):
            allowed = f"write {of.top_end}, the upper end of {of.line!r}"
            part.note(part.refused(ALONG, f"the tensioner is connected at {end}", allowed))


def _link(link: Part, of: Anchorage) -> Pull:
    kind = link.text("LinkType").lower()
    if kind not in ("spring/damper", "tether"):
        allowed = f"write Spring/Damper or Tether, or {CHANGE}"
        found = f"the import cannot convert the type {link.text('LinkType')}"
        raise link.refused("LinkType", found, allowed)
    deck, ring, length = _between(link, of)
    if kind == "tether" or _is_given(link.value("LinearSpring")):
        unstretched = link.number("UnstretchedLength")
        if kind == "tether" and not unstretched > 0.0:
            found = f"{unstretched:g} m is not the length of a tether"
            raise link.refused("UnstretchedLength", found, "give a length above 0 m")
        stiffness = link.number("Stiffness")
        pull = stiffness * (length - unstretched)
        law: tuple[tuple[float, float], ...] = ((0.0, round(pull, 6)), (1.0, round(pull + stiffness, 6)))
        if kind == "tether":
            law = _tether(stiffness, unstretched, length)
    else:
        rows = link.figures("SpringLength", "SpringTension")
        law = tuple((round(reach - length, 6), force) for reach, force in rows)
    return Pull(deck, ring, law, _damping(link) if kind == "spring/damper" else 0.0)


def _tether(stiffness: float, unstretched: float, length: float) -> tuple[tuple[float, float], ...]:
    """Return the law of a tether, which is slack up to its unstretched length and does not push.

    Parameters
    ----------
    stiffness : force at twice the unstretched length (kN).
    unstretched, length : unstretched length, and length with an unstretched riser (m).
    """
    longest = 2.0 * max(unstretched, length)  # where the law ends
    return (
        (round(-length, 6), 0.0),
        (round(unstretched - length, 6), 0.0),
        (round(longest - length, 6), round(stiffness * (longest / unstretched - 1.0), 6)),
    )


def _damping(link: Part) -> float:
    """Return the damping of a link (kN s/m); 0 without damping."""
    link.idle("Damping")
    if link.data.get("LinearDamper") is None and link.data.get("DampingConstant") is None:
        return 0.0
    if not _is_given(link.value("LinearDamper")):
        allowed = "write Yes and give a DampingConstant, since damping of a scene is linear"
        found = f"{link.value('LinearDamper')} is a damper that is not linear"
        raise link.refused("LinearDamper", found, allowed)
    return link.number("DampingConstant")


def _is_given(value: Any) -> bool:
    """Return whether a value of a deck means yes."""
    return str(value) in ("True", "Yes")


def _winch(winch: Part, of: Anchorage) -> Pull:
    """Return the pull of a winch with constant tension."""
    winch.demand("WinchType", "Simple")
    winch.demand("WinchControlType", "By stage")
    winch.idle("Damping")
    winch.optional("Stiffness")  # of the wire; irrelevant with a constant tension
    deck, ring, _ = _between(winch, of)
    modes = [str(mode) for (mode,) in winch.table("StageMode", idle=("StageValue",))]
    stages = set(
        zip(modes, [value for (value,) in winch.figures("StageValue", idle=("StageMode",))], strict=True)
    )
    if len(stages) > 1 or next(iter(stages))[0] != "Specified tension":
        found = ", ".join(f"{mode} {value:g}" for mode, value in sorted(stages))
        allowed = "use one Specified tension at all stages, since a winch becomes a constant tension"
        raise winch.refused("StageMode, StageValue", found, allowed)
    return Pull(deck, ring, ((0.0, next(iter(stages))[1]),), 0.0)
