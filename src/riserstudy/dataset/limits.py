"""Demand and allowable: the utilisation of each limit in a run, with place and time."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple

from riserstudy.records.numerals import newtons, percent
from riserstudy.records.words import listed
from riserstudy.scene.limit_inputs import lacks, lacks_outputs, last_time, times_of_mean
from riserstudy.scene.limits import ALONG, ANGLES, OF_THE_RISER, SIGNED, UNITS, Limit
from riserstudy.scene.load import SceneFile
from riserstudy.scene.pressures import not_in_demand
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import Section

#: errors that are estimated, but not limited by a tolerance: by name, as sentences call them
NOT_LIMITED = {
    "ufj_angle": "upper flex joint angle",
    "lfj_angle": "lower flex joint angle",
    "shear": "shear force",
    "stroke": "stroke",
    "tensioner_force": "tensioner force",
    "overpull": "overpull",
    "lift": "lift",
}
#: those whose allowable is never zero: an error is also small or large compared with it
MAGNITUDES = (*ANGLES, "shear")
#: facts of a run with the largest values of which errors are shares, by the name of the error; of other
#: errors, these are the extremes of their outputs
SCALES = {"displacement": "largest_displacement", "lift": "lift_max"}
#: facts of a run that `checked` uses
FACTS = (
    "extremes",
    "extremes_connected",
    "error_estimate",
    "sampling_error",
    "vibration_since",
    *SCALES.values(),
)
# smallest remainder of a value after subtraction of its error, as a share; below it, nothing is known
LEAST_LEFT = 0.1
# largest error on a prescribed mesh, as a share, with which the place or time of reaching a limit is known
SURE = 0.05
FINER = "give a finer analysis.mesh and a shorter analysis.step, or analysis.accuracy instead"
#: variables over ``limit`` with the parts of each label; the last one includes the place
PARTS = ("mode_of_limit", "side_of_limit", "output_of_limit")
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
    takes: str = ""  # part that the limit applies to, if its name does not show it


def checked(file: SceneFile, scene: Resolved, facts: Mapping[str, Any]) -> list[Checked]:
    """Every limit of a scene, compared with the extremes of its run.

    An output whose error exceeds its value does not meet any limit. A tolerance does not limit the error of
    angles, shear, strokes, tensioner forces, overpull and clearance, and a prescribed mesh does not limit any
    error. An output therefore meets a limit only if it meets the limit with its estimated error added.
    Limits of operations that a disconnect ends apply until the disconnect. ``facts``: those of `FACTS` that
    the run has: its extremes, one row per output and place, and its estimated errors.
    """
    estimated = facts.get("error_estimate", {})
    errors = {k: v for k, v in estimated.items() if k not in NOT_LIMITED and v > 1.0}
    unknown = ", ".join(f"{name} {percent(value)}" for name, value in errors.items())
    plain = "published" if scene.paper else "given"
    each = []
    for k, limit in enumerate(scene.limits or []):
        origin = file.origins.get(f"limits[{k}].{limit.side}") or file.origins.get(f"limits[{k}]")
        rows = facts.get("extremes", [])
        if limit.ends_with_disconnect:
            rows = facts.get("extremes_connected", rows)
        one = _one(scene, limit, rows, origin.status if origin else plain)
        one = _with_error(one, facts, scene.analysis.mesh is not None)
        one = _with_mud_above(one, not_in_demand(scene, limit))
        if unknown and one.verdict == WITHIN:
            why = f"an estimated error below the result itself: {unknown}"
            one = one._replace(verdict=UNKNOWN, missing=why)
        each.append(one._replace(takes=takes(scene, limit)))
    return each


def _not_limited(output: str) -> str | None:
    """Name of an output's error that no tolerance limits; None for other outputs."""
    return next((name for name in QUANTITIES[output].errors if name in NOT_LIMITED), None)


class Error(NamedTuple):
    """Estimated error of an output."""

    size: float  # absolute error, in the SI unit of the output
    share: float  # error as a share of the largest value
    words: str


def error_of(output: str, facts: Mapping[str, Any], own_mesh: bool) -> Error:
    """Estimated error of an output if no tolerance limits it; else, or if it is not known, zero.

    ``own_mesh``: whether the scene prescribes its mesh, so no error is limited.
    """
    estimated = facts.get("error_estimate", {})
    names = QUANTITIES[output].errors
    if name := _not_limited(output):
        outputs = [other for other in UNITS if QUANTITIES[other].errors == names]
        share = estimated.get(name, 0.0)
        size = _absolute(share, outputs, facts)
        words = f"an error of the {NOT_LIMITED[name]}, {_in_words(size, UNITS[output])} as estimated"
        return Error(size, share, words)
    names = names if own_mesh else ()
    share = max((estimated.get(name, 0.0) for name in names), default=0.0)
    words = f"an error of {output}, {percent(share)} as estimated"
    # the error at the foot is relative to the largest value anywhere
    of = QUANTITIES[output].at_foot_of or output
    return Error(_absolute(share, (of,), facts), share, words)


def _in_words(size: float, unit: str) -> str:
    """An error with its unit; ``unit``: SI unit of the output."""
    if unit == "rad":
        return f"{math.degrees(size):.2g} deg"
    return f"{size:.2g} m" if unit == "m" else newtons(size)


def too_coarse(limit: Limit, error: Error) -> str:
    """Why it is not known where or when a limit is reached on a prescribed mesh; empty if it is known."""
    of_allowable = _not_limited(limit.output) in MAGNITUDES
    if (error.size / abs(limit.allowable) if of_allowable else error.share) <= SURE:
        return ""
    most = f"{100.0 * SURE:g} %{' of its allowable' if of_allowable else ' of its largest value'}"
    return f"{error.words}, below {most}; {FINER}"


def _absolute(share: float, outputs: Collection[str], facts: Mapping[str, Any]) -> float:
    """A relative error (1) of outputs, converted to their unit.

    It is relative to the largest value of a finer run, which exceeds that of this run by at most the error
    itself.
    """
    rows = [row for row in facts.get("extremes", []) if row["output"] in outputs]
    sides = ("largest", "smallest")
    largest = max((abs(row.get(side, 0.0)) for row in rows for side in sides), default=0.0)
    errors = {name for output in outputs for name in QUANTITIES[output].errors}
    largest = max(largest, *(facts.get(SCALES[name], 0.0) for name in errors if name in SCALES), 0.0)
    return float(share * largest / max(1.0 - share, LEAST_LEFT))


def _with_error(one: Checked, facts: Mapping[str, Any], own_mesh: bool) -> Checked:
    """The limit, marked as not certainly met if the error of its output exceeds the margin."""
    if one.verdict != WITHIN or one.demand is None:
        return one
    name = _not_limited(one.output)
    if name == "shear" and "vibration_since" in facts:
        why = "an estimated error of the shear force, which a riser that vibrates in vortices does not have"
        return one._replace(verdict=UNKNOWN, missing=why)
    error = error_of(one.output, facts, own_mesh)
    worst = one.demand + (-error.size if one.side == "smallest" else error.size)
    if use(one.side, worst, one.allowable) <= 1.0:
        return one
    remedy = "request a smaller error by analysis.accuracy"
    if name in facts.get("sampling_error", {}):  # partly due to the limited duration of a vibration
        remedy = f"run longer, or {remedy}"
    if name is None:
        remedy = "give a finer analysis.mesh and a shorter analysis.step, or analysis.accuracy instead"
    return one._replace(verdict=UNKNOWN, missing=f"{error.words}, below the margin; {remedy}")


def _with_mud_above(one: Checked, mud: float) -> Checked:
    """The limit of a smallest tension, not met if the mud above the riser (N) exceeds the margin."""
    if not mud or one.verdict != WITHIN or one.demand is None:
        return one
    if use(one.side, one.demand - mud, one.allowable) <= 1.0:
        return one
    return one._replace(verdict=UNKNOWN, missing=taken_by(mud))


def taken_by(mud: float) -> str:
    """What a smallest tension is not known for: the weight of the mud above the riser (N)."""
    return f"contents above the riser's upper end, which decrease the tension by {1e-3 * mud:.3g} kN"


def _one(scene: Resolved, limit: Limit, rows: list[dict[str, Any]], origin: str) -> Checked:
    about = (limit.output, limit.place, limit.mode, limit.side, limit.allowable)
    unit = UNITS[limit.output]
    missing = lacks(scene, limit)
    found = demand_of(scene, limit, rows)
    if found is None:
        few = lacks_outputs(scene) if limit.side == "mean" else ""
        why = ", ".join(missing) or few or f"{limit.output} in this run"
        return Checked(*about, None, None, None, None, UNKNOWN, why, origin, unit)
    demand, s, time = found
    share = use(limit.side, demand, limit.allowable)
    verdict = EXCEEDED if share > 1.0 else UNKNOWN if missing else WITHIN
    return Checked(*about, demand, share, s, time, verdict, ", ".join(missing), origin, unit)


def takes(scene: Resolved, limit: Limit) -> str:
    """Sections and times that a limit applies to, if its name does not show them, and the side between them.

    A disconnect ends the operations of all limits but those of the mode ``disconnect``, and not the run.
    """
    last = min(last_time(scene, limit), scene.lower_joint_until if limit.output == "lfj_angle" else math.inf)
    until = f"until the disconnect at {last:.4g} s" if last < math.inf and scene.analysis.duration else ""
    return "; ".join(filter(None, [_part(scene, limit), until]))


def _part(scene: Resolved, limit: Limit) -> str:
    """The part of the riser, of its cylinders or of the run that a limit applies to."""
    if limit.side == "mean" and (times := _times_of_mean(scene, limit)):
        return times
    if limit.output == "stroke":
        return "from the static state"
    if limit.output == "joint_stroke":
        return "from the joint's nominal length"
    if limit.output == "tensioner_force" and limit.side == "smallest":
        return _of_failed(scene)
    if len(scene.riser) == 1 or limit.output not in ALONG:
        return ""
    sections = [section.name for section in sections_of(scene, limit)]
    below = len(scene.riser) - len(sections)
    parts = [] if limit.at else [f"{sections[0]} to {sections[-1]}" if sections[1:] else sections[0]]
    if below and not limit.at:
        parts.append("without stack and conductor below the flex joint")
    if limit.output == "von_mises_stress":
        parts.append("where two sections meet, the larger stress")
    return "; ".join(parts)


def _of_failed(scene: Resolved) -> str:
    """Cylinders that a smallest pull does not apply to, in words, with the time from which on it does not."""
    rig = scene.top.tensioners
    if rig is None:
        return ""
    words = [f"without failed {_cylinders(rig.failed)}"] if rig.failed else []
    if rig.failing:
        words.append(f"{_cylinders(rig.failing.cylinders)} only until {rig.failing.at:g} s")
    return "; ".join(words)


def _cylinders(numbers: Sequence[int]) -> str:
    return f"cylinder{'s' if len(numbers) > 1 else ''} {listed(map(str, numbers))}"


def _times_of_mean(scene: Resolved, limit: Limit) -> str:
    """Times that a mean is taken over, if these are not the whole run or include ramps."""
    start, end, periods = times_of_mean(scene, limit.output, last_time(scene, limit))
    if scene.built_up > start:
        return f"includes ramps, which end at {scene.built_up:g} s" if end else ""
    if periods:
        return f"from {start:g} s on, over {periods} whole period{'s' if periods > 1 else ''}"
    if start and start == scene.built_up:
        return f"from {start:g} s on, when ramps are over"
    return f"from {start:g} s on" if start else ""


def demand_of(
    scene: Resolved, limit: Limit, rows: list[dict[str, Any]]
) -> tuple[float, float | None, float | None] | None:
    """Value, place (m) and time (s) of the largest utilisation of a limit; None if no row has it.

    ``rows``: extremes of a run, one row per output and place.
    """
    there = rows_of(scene, limit, rows)
    demands = [_demand(limit, row) for row in there if limit.side in row]  # few outputs have no mean
    sign = -1.0 if limit.side == "smallest" else 1.0  # of two with infinite utilisation, the worse governs
    return max(
        demands, key=lambda one: (use(limit.side, one[0], limit.allowable), sign * one[0]), default=None
    )


def rows_of(scene: Resolved, limit: Limit, rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The rows of extremes that a limit applies to."""
    names = [section.name for section in (scene.riser if limit.at else sections_of(scene, limit))]
    places = limit.places(names)
    return [row for row in rows if row["output"] == limit.output and row["where"] in places]


def sections_of(scene: Resolved, limit: Limit) -> list[Section]:
    """The sections that a limit without a place applies to."""
    return scene.riser_sections if limit.output in OF_THE_RISER else scene.riser


def _demand(limit: Limit, row: Mapping[str, Any]) -> tuple[float, float | None, float | None]:
    """Value, place (m) and time (s) in a row of extremes that a limit applies to."""
    sides = [limit.side]
    if limit.side == "largest" and limit.output in SIGNED:
        sides = ["largest", "smallest"]
    side = max(sides, key=lambda one: abs(row[one]))
    value = abs(row[side]) if limit.output in SIGNED else row[side]
    return value, row.get(side + "_s"), row.get(side + "_time")


def use(side: str, demand: float, allowable: float) -> float:
    """Utilisation of an allowable by a demand, above 1 if it is exceeded; both in the same unit.

    For a smallest allowable above zero, it is allowable divided by demand: twice the allowable gives one
    half.
    """
    if side == "smallest" and allowable >= 0.0:
        if demand <= 0.0:
            return 1.0 if demand == allowable else math.inf
        return allowable / demand
    if allowable < 0.0 and side != "smallest":  # demand must be below a negative value
        return math.inf if demand >= 0.0 else allowable / demand
    return max(0.0, demand / allowable)


def label(one: Checked | Limit) -> str:
    """A limit in words: mode, side, output and place."""
    return limit_in_words(one.mode, one.side, one.output, one.place if isinstance(one, Limit) else one.at)


def limit_in_words(mode: str, side: str, output: str, place: str) -> str:
    """A limit by its mode, its side, the name of its output or words for it, and its place ("" for all)."""
    return f"{mode}: {side} {output}{f' at {place}' if place else ''}"


def labels(limits: Sequence[Checked | Limit]) -> list[str]:
    """Limits in words, which differ."""
    return numbered([label(one) for one in limits])


def coordinates(limits: Sequence[Limit]) -> dict[str, Any]:
    """Coordinates of arrays over ``limit``: labels, which differ, and their parts."""
    names = labels(limits)
    modes, sides = [one.mode for one in limits], [one.side for one in limits]
    begins = [f"{mode}: {side} " for mode, side in zip(modes, sides, strict=True)]
    outputs = [name.removeprefix(begin) for name, begin in zip(names, begins, strict=True)]
    parts = zip(PARTS, (modes, sides, outputs), strict=True)
    return {"limit": names} | {name: ("limit", values) for name, values in parts}


def numbered(names: Sequence[str]) -> list[str]:
    """Names that differ: of several equal ones, the second and later ones are numbered."""
    found: list[str] = []
    for name in names:
        other, number = name, 2
        while other in found:
            other, number = f"{name} ({number})", number + 1
        found.append(other)
    return found
