"""Ends of lines in a deck: connected objects, positions and stiffnesses."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from riserstudy.importers.orcaflex.deck import Part, q

PLACE = ("Connection", "ConnectionX", "ConnectionY", "ConnectionZ")
LEANS = ("ConnectionDeclination", "ConnectionzRelativeTo", "ConnectionReleaseStage")
ROUND_Z = ("ConnectionAzimuth", "ConnectionGamma")  # without effect on a vertical round pipe
BENDING = "ConnectionxBendingStiffness"
GROUND = ("Fixed", "Anchored")
UPRIGHT = (0, 180, None)  # deg
SAME = 1e-6  # largest distance of points that count as equal (m)


class End(NamedTuple):
    """One end of a line: connected object, position in the axes of that object (m), bending stiffness.

    ``of``: end of another line to which it is connected. ``stiffness`` in kN m/deg, None if free to turn.
    """

    to: str
    x: float
    y: float
    z: float
    of: str
    leaning: float | None  # declination (deg)
    stiffness: float | None

    @property
    def on_axis(self) -> bool:
        """Whether its horizontal position is the origin of the connected object."""
        return not (self.x or self.y)


class Line(NamedTuple):
    """A line of a deck with its ends."""

    part: Part
    upper: End
    lower: End

    @property
    def name(self) -> str:
        """Name of the line."""
        return self.part.name


def line_of(part: Part) -> Line:
    """Return a line with its ends. Raises InputError when it does not have two ends with stiffnesses."""
    rows = part.table(*PLACE, of=LEANS, idle=ROUND_Z)
    stiff = part.table(BENDING, of=("ConnectionyBendingStiffness",))
    if len(rows) != 2 or len(stiff) != 2:
        allowed = "give two rows of ends and two rows of their bending stiffness"
        found = f"the line has {len(rows)} ends and {len(stiff)} stiffnesses"
        raise part.refused(PLACE[0], found, allowed)
    ends = [_end(part, row, *bends) for row, bends in zip(rows, stiff, strict=True)]
    upper, lower = ends if part.text("TopEnd") == "End A" else ends[::-1]
    return Line(part, upper, lower)


def _end(part: Part, row: list[Any], along: Any, across: Any) -> End:
    to, *place, leaning, of, release = row
    if release is not None:
        allowed = "remove the release from the model, since lines of a scene stay connected"
        part.note(part.refused(LEANS[-1], f"the line is released in stage {release}", allowed))
    try:
        x, y, z = (float(value) for value in place)
        stiffness = None if along is None else float(str(along).replace("Infinity", "inf"))
    except (TypeError, ValueError):
        found = f"not all of {', '.join(map(str, row))}, stiffness {along} are numbers"
        allowed = "write numbers for position and stiffness of the line end"
        raise part.refused(PLACE[0], found, allowed) from None
    if across not in (None, along):
        found = f"the stiffnesses {along} and {across} differ"
        allowed = "a flex joint of a scene has one stiffness for both directions. Write equal values"
        part.note(part.refused(BENDING, found, allowed))
    return End(str(to), x, y, z, str(of or ""), leaning, stiffness or None)


def upright(line: Line, end: End) -> None:
    """Check that an end with rotational stiffness is vertical."""
    if end.stiffness and end.leaning not in UPRIGHT:
        found = f"the end resists turning at a declination of {end.leaning}"
        allowed = "write 0 or 180, since a clamp or flex joint at an end of a scene is vertical"
        line.part.note(line.part.refused(LEANS[0], found, allowed))


def rotation(stiffness: float | None) -> Any:
    """Return the rotation in a scene for the bending stiffness of an end (kN m/deg)."""
    if stiffness is None:
        return "free"
    return "fixed" if math.isinf(stiffness) else {"stiffness": q(stiffness, "kN*m/deg")}


def in_series(one: float | None, other: float | None) -> float | None:
    """Return the stiffness of two ends at one freely turning point (kN m/deg); None for a hinge."""
    if one is None or other is None:
        return None
    return 1.0 / (1.0 / one + 1.0 / other) if 1.0 / one + 1.0 / other else math.inf
