"""Demand against allowable: how much of each limit a run uses, where and when."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

from riserstudy.scene.limit_inputs import lacks
from riserstudy.scene.limits import ALONG, ANGLES, OF_THE_RISER, UNITS, Limit
from riserstudy.scene.load import SceneFile
from riserstudy.scene.pressures import not_in_tension
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import Section

#: outputs whose sign is a convention
SIGNED = ("bending_moment", "shear_force", "x", "y", "ufj_angle", "lfj_angle")
#: outputs whose error is estimated but bounded by no accuracy, by the name of the error, and that of one
UNBOUNDED = {"angle": ("angle", ANGLES), "shear": ("shear force", ("shear_force",))}
#: estimated errors of other outputs, which an accuracy bounds and a mesh of the scene does not
BOUNDED = {
    "bending_moment": ("moment",),
    "effective_tension": ("tension",),
    "von_mises_stress": ("moment", "tension"),
    "x": ("displacement",),
    "y": ("displacement",),
}
LEAST_LEFT = 0.1  # of a value, after an error relative to a larger one: beyond it nothing is known
WITHIN, EXCEEDED, UNKNOWN = "within", "exceeded", "not evaluated"


class Checked(NamedTuple):
    """One limit of a run, in SI units. None where there is none, or it is not evaluated."""

    output: str
    at: str
    mode: str
    side: str
    allowable: float
    demand: float | None
    utilisation: float | None
    s: float | None  # m
    time: float | None  # s
    verdict: str
    missing: str
    origin: str
    unit: str
    takes: str = ""  # what it looks at, where its name does not tell


def checked(file: SceneFile, scene: Resolved, facts: Mapping[str, Any]) -> list[Checked]:
    """Every limit of a scene against the extremes of its run.

    Nothing is within a limit that is known no better than by an error larger than itself. No accuracy bounds
    the error of angles and of shear, and a mesh of the scene bounds no error; so an output is within a limit
    if it is with its own estimated error on top.

    Parameters
    ----------
    facts : of the run: its extremes, a row an output and place, and its estimated errors.
    """
    rows = facts.get("extremes", [])
    estimated = facts.get("error_estimate", {})
    errors = {k: v for k, v in estimated.items() if k not in UNBOUNDED and v > 1.0}
    unknown = ", ".join(f"{name} {100.0 * value:.2g} %" for name, value in errors.items())
    plain = "published" if scene.paper else "given"
    each = []
    for k, limit in enumerate(scene.limits or []):
        origin = file.origins.get(f"limits[{k}].{limit.side}") or file.origins.get(f"limits[{k}]")
        one = _one(scene, limit, rows, origin.status if origin else plain)
        one = _with_error(one, facts, scene.analysis.mesh is not None)
        if limit.output == "effective_tension":
            one = _with_mud_above(one, not_in_tension(scene))
        if unknown and one.verdict == WITHIN:
            why = f"an estimated error below the result itself: {unknown}"
            one = one._replace(verdict=UNKNOWN, missing=why)
        each.append(one._replace(takes=takes(scene, limit)))
    return each


def _unbounded(output: str) -> str | None:
    """The error of an output, where no accuracy bounds it: "angle" or "shear"; None elsewhere."""
    return next((name for name, (_, of) in UNBOUNDED.items() if output in of), None)


class Error(NamedTuple):
    """Estimated error of an output."""

    size: float  # in its SI unit
    share: float  # of the largest value
    words: str


def error_of(output: str, facts: Mapping[str, Any], own_mesh: bool) -> Error:
    """Estimated error of an output, which no accuracy bounds; zero where one does, and where it is unknown.

    Parameters
    ----------
    own_mesh : whether the scene gives its mesh, which bounds no error.
    """
    estimated = facts.get("error_estimate", {})
    if name := _unbounded(output):
        noun, outputs = UNBOUNDED[name]
        share = estimated.get(name, 0.0)
        size = _absolute(share, outputs, facts)
        text = f"{math.degrees(size):.2g} deg" if name == "angle" else f"{size:.2g} N"
        return Error(size, share, f"an error of the {noun}, {text} as estimated")
    names = BOUNDED.get(output, ()) if own_mesh else ()
    share = max((estimated.get(name, 0.0) for name in names), default=0.0)
    words = f"an error of {output}, {100.0 * share:.2g} % as estimated"
    return Error(_absolute(share, (output,), facts), share, words)


def _absolute(share: float, outputs: Collection[str], facts: Mapping[str, Any]) -> float:
    """A relative error (1) of outputs in their unit.

    It is relative to the largest value of a finer run, which exceeds that of the run by no more than itself.
    """
    rows = [row for row in facts.get("extremes", []) if row["output"] in outputs]
    largest = max((abs(row[side]) for row in rows for side in ("largest", "smallest")), default=0.0)
    return float(share * largest / max(1.0 - share, LEAST_LEFT))


def _with_error(one: Checked, facts: Mapping[str, Any], own_mesh: bool) -> Checked:
    """A limit that is not met for certain where the error of its output is larger than what is left."""
    if one.verdict != WITHIN or one.demand is None:
        return one
    name = _unbounded(one.output)
    if name == "shear" and "vibration_since" in facts:
        why = "an estimated error of the shear force, which a riser that vibrates in vortices does not have"
        return one._replace(verdict=UNKNOWN, missing=why)
    error = error_of(one.output, facts, own_mesh)
    worst = one.demand + (-error.size if one.side == "smallest" else error.size)
    if use(one.side, worst, one.allowable) <= 1.0:
        return one
    remedy = "request a smaller error by analysis.accuracy"
    if name in facts.get("sampling_error", {}):  # partly that of a vibration over so long a time
        remedy = f"run longer, or {remedy}"
    if name is None:
        remedy = "give more analysis.mesh.elements and a shorter analysis.step, or analysis.accuracy instead"
    return one._replace(verdict=UNKNOWN, missing=f"{error.words}, below the margin; {remedy}")


def _with_mud_above(one: Checked, mud: float) -> Checked:
    """A smallest tension that is not within its limit if the mud above the riser (N) takes what is left."""
    if one.verdict != WITHIN or one.demand is None or one.side != "smallest":
        return one
    if use(one.side, one.demand - mud, one.allowable) <= 1.0:
        return one
    return one._replace(verdict=UNKNOWN, missing=taken_by(mud))


def taken_by(mud: float) -> str:
    """What a smallest tension is not known for: the weight of the mud above the riser (N)."""
    return (
        f"contents above the riser's upper end, which decrease the tension by {1e-3 * mud:.3g} kN"
    )


def _one(scene: Resolved, limit: Limit, rows: list[dict[str, Any]], origin: str) -> Checked:
    about = (limit.output, limit.place, limit.mode, limit.side, limit.allowable)
    unit = UNITS[limit.output]
    missing = lacks(scene, limit)
    found = demand_of(scene, limit, rows)
    if found is None:
        why = ", ".join(missing) or f"{limit.output} in this run"
        return Checked(*about, None, None, None, None, UNKNOWN, why, origin, unit)
    demand, s, time = found
    share = use(limit.side, demand, limit.allowable)
    verdict = EXCEEDED if share > 1.0 else UNKNOWN if missing else WITHIN
    return Checked(*about, demand, share, s, time, verdict, ", ".join(missing), origin, unit)


def takes(scene: Resolved, limit: Limit) -> str:
    """What a limit applies to where its name does not show it: sections, and what counts where they meet."""
    if limit.side == "mean" and 0.0 < scene.built_up < (scene.analysis.duration or 0.0):
        return f"from {scene.built_up:g} s on, when ramps are over"
    if limit.output == "stroke":
        return "from the static state"
    if limit.output == "joint_stroke":
        return "from the joint's length"
    if len(scene.riser) == 1 or limit.output not in ALONG:
        return ""
    sections = [section.name for section in sections_of(scene, limit)]
    below = len(scene.riser) - len(sections)
    parts = (
        [] if limit.at else [f"{sections[0]} to {sections[-1]}" if sections[1:] else sections[0]]
    )
    if below and not limit.at:
        parts.append("without stack and conductor below the flex joint")
    if limit.output == "von_mises_stress":
        parts.append("where walls meet, the larger")
    return "; ".join(parts)


def demand_of(
    scene: Resolved, limit: Limit, rows: list[dict[str, Any]]
) -> tuple[float, float | None, float | None] | None:
    """Value, place (m) and time (s) at which most of a limit is used; None where no row tells it.

    Parameters
    ----------
    rows : extremes of a run, a row an output and place.
    """
    names = [section.name for section in (scene.riser if limit.at else sections_of(scene, limit))]
    places = limit.places(names)
    there = [row for row in rows if row["output"] == limit.output and row["where"] in places]
    demands = [_demand(limit, row) for row in there]
    return max(demands, key=lambda one: use(limit.side, one[0], limit.allowable), default=None)


def sections_of(scene: Resolved, limit: Limit) -> list[Section]:
    """The sections that a limit without a place applies to."""
    return scene.riser_sections if limit.output in OF_THE_RISER else scene.riser


def _demand(limit: Limit, row: Mapping[str, Any]) -> tuple[float, float | None, float | None]:
    """Value, place (m) and time (s) that a limit asks for of a row of extremes."""
    sides = [limit.side]
    if limit.side == "largest" and limit.output in SIGNED:
        sides = ["largest", "smallest"]
    side = max(sides, key=lambda one: abs(row[one])) if len(sides) > 1 else sides[0]
    value = abs(row[side]) if limit.output in SIGNED else row[side]
    return value, row.get(side + "_s"), row.get(side + "_time")


def use(side: str, demand: float, allowable: float) -> float:
    """Share of an allowable that a demand uses, above 1 where it is exceeded; both in one unit.

    A floor above zero is used as far as it is from the demand: twice the floor is a use of a half.
    """
    if side == "smallest" and allowable >= 0.0:
        if demand <= 0.0:
            return 1.0 if demand == allowable else math.inf
        return allowable / demand
    if allowable < 0.0 and side == "largest":  # stays below a negative value
        return math.inf if demand >= 0.0 else allowable / demand
    return max(0.0, demand / allowable)


def label(one: Checked | Limit) -> str:
    """A limit in words: mode, side, output and place."""
    at = one.place if isinstance(one, Limit) else one.at
    place = f" at {at}" if at else ""
    return f"{one.mode}: {one.side} {one.output}{place}"
