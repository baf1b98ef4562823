"""Headings of OrcaFlex's text results: the variable of a run for each, and the origin of arc length.

A result has a heading with variable and unit, ``Effective tension (kN)``. A range graph has minimum, maximum
and mean over ``Arc length (m)``, which is measured from end A of the line. A file does not state the position
of end A. Bend moment and shear force are magnitudes, without a sign.

References
----------
Orcina, OrcaFlex help: Line results; Results: Producing results; Line data: Structure.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

from riserstudy.dataset.external.columns import Heading
from riserstudy.errors import InputError

#: variables of lines, the corresponding variables of a run, and whether OrcaFlex's variable has no sign
VARIABLES = {
    "effective tension": ("effective_tension", False),
    "wall tension": ("wall_tension", False),
    "bend moment": ("bending_moment", True),
    "shear force": ("shear_force", True),
    "x": ("x", False),
    "y": ("y", False),
    "z": ("z", False),
}
#: variables that no run has in the same definition
OTHERWISE = {
    "end force": "compare the effective tension at that end instead of this force in space",
    "max von mises stress": "remove the column, since it includes shear and torsion",
    "x bend moment": "compare Bend moment instead of one component",
    "y bend moment": "compare Bend moment instead of one component",
}
STATISTICS = {
    "min": "min", "minimum": "min", "max": "max", "maximum": "max", "mean": "mean",
    "std dev": "std", "standard deviation": "std",
}  # fmt: skip
AXES = {"time": "time", "arc length": "s"}
_NAMES = sorted([*VARIABLES, *OTHERWISE], key=len, reverse=True)
_RESULT = re.compile(
    rf"(?:(?P<before>.*?)\W+)??(?P<name>{'|'.join(_NAMES)})\s*\((?P<unit>[^()]+)\)(?P<after>.*)",
    re.IGNORECASE,
)
_PLACE = re.compile(
    r"\W*(?:at )?(?:(?P<end>end [ab])|arc length:?\s*(?P<arc>\d+\.?\d*)\s*m?)\W*", re.IGNORECASE
)
END_A = (
    "give `top`, `bottom`, or the distance of end A from the riser's lower end with the direction in which "
    "arc length increases, such as `872 m down`"
)


class EndA(NamedTuple):
    """Origin of arc length: distance from the lower end (m), and 1 if it increases upwards, else -1."""

    s: float
    way: int

    def place(self, arc: float) -> float:
        """Arclength from the lower end (m) for an arc length of OrcaFlex (m)."""
        return self.s + self.way * arc


def end_a(text: str, length: float) -> EndA:
    """End A from the text of an option, for a riser of a length (m).

    Raises InputError when the text is neither an end nor a place with a direction.
    """
    if text in ("top", "bottom"):
        return EndA(length, -1) if text == "top" else EndA(0.0, 1)
    found = re.fullmatch(r"(\d+\.?\d*) m (up|down)", text.strip())
    if not found or not 0.0 <= float(found[1]) <= length:
        raise InputError("--end-a", text, "this is not a place on the riser", END_A)
    return EndA(float(found[1]), 1 if found[2] == "up" else -1)


def axis_of(title: str) -> tuple[str, str] | None:
    """Axis of a run and unit, from a first heading in OrcaFlex's terms."""
    found = re.fullmatch(r"(time|arc length)\s*[(\[](\w+)[)\]]", title.strip(), re.IGNORECASE)
    return (AXES[found[1].lower()], found[2]) if found else None


def heading_of(path: Path, title: str, above: list[str], end: EndA | None, length: float) -> Heading | None:
    """Content of a heading in OrcaFlex's terms; None if it is not in these terms.

    Raises InputError when its definition differs from that of a run, or its place is not given.

    Parameters
    ----------
    above : lines above the headings, which may contain the variable of a range graph.
    length : length of the riser (m).
    """
    statistic = STATISTICS.get(re.sub(r"[^a-z]+", " ", title.lower()).strip())
    texts = above if statistic else [title]
    found = [m for m in (_RESULT.fullmatch(text.strip()) for text in texts) if m]
    if not found:
        return None
    if len({(m["name"].lower(), m["unit"]) for m in found}) > 1:
        allowed = "state with --column which variable this column is"
        raise InputError(path, title, "several variables are named above the headings", allowed)
    name = found[0]["name"].lower()
    if name in OTHERWISE:
        raise InputError(path, title, "a run defines this quantity differently", OTHERWISE[name])
    ours, size = VARIABLES[name]
    after = found[0]["after"] or ""
    suffix = STATISTICS.get(re.sub(r"[^a-z]+", " ", after.lower()).strip(), statistic)
    if suffix in ("mean", "std"):
        raise InputError(
            path, title, "a run has no means or standard deviations along the riser", "remove this column"
        )
    if suffix:
        return Heading(f"{ours}_{suffix}", None, found[0]["unit"], size)
    return Heading(ours, _place(path, title, after, end, length), found[0]["unit"], size)


def _place(path: Path, title: str, after: str, end: EndA | None, length: float) -> float | None:
    """Arclength from the lower end (m) at the end of a heading; None if it ends with the unit."""
    if not after.strip():
        return None
    found = _PLACE.fullmatch(after)
    if not found:
        allowed = f"give the place with --column '{title}=effective_tension at 300 m (kN)'"
        raise InputError(path, title, f"{after.strip()!r} is not a place on a line", allowed)
    if end is None:
        raise InputError(path, title, "the file does not state which end is end A", f"add --end-a: {END_A}")
    if found["arc"]:
        return end.place(float(found["arc"]))
    if found["end"].lower() == "end a":
        return end.s
    if end.s not in (0.0, length):
        allowed = "give the place with --column"
        why = "the place of end B is unknown, since the line is only a part of the riser"
        raise InputError(path, title, why, allowed)
    return length - end.s
