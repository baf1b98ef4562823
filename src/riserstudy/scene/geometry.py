"""Whether a scene's lengths and elevations close: a slip of a unit or a sign must not become a riser.

What is refused cannot be built: a riser that does not reach from end to end, or a top or a foot far from
the sea's levels. Where a scene gives no levels nothing is compared with them.
"""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

from riserstudy.scene.alike import alike
from riserstudy.scene.soil import TabulatedSoil

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts

STRETCH = 0.01  # share of its length that a held riser is off, at most: steel yields at 0.003
SLIDES = 0.003  # the same below a telescopic joint, whose length is given
ROUNDED = 1.0  # m, to which decks are drawn
FAR = 0.5  # share of its length by which no riser is held aside, and cables that hang slack are
STACK = 50.0  # m, the tallest wellhead, BOP and LMRP below a riser's lower end
DECK = 100.0  # m, the highest deck above the sea
KEEL = 30.0  # m, the deepest keel below it, from which a riser may hang


class Span(NamedTuple):
    """Elevations of a riser's ends, as given or as they are before it stretches (m)."""

    bottom: float
    top: float


def closes(scene: Parts) -> None:
    """See that names are unique and lengths and elevations fit together.

    Raises
    ------
    ValueError
        Field, what was found and what is allowed.
    """
    names = Counter(section.name for section in scene.riser)
    for name, count in names.items():
        if count > 1:
            raise ValueError(
                f"riser: {count} sections are named {name!r}; give each section a name of its own"
            )
    _reaches(scene)
    _filled(scene)
    ends = span(scene)
    if scene.water and ends:
        _stands_in(ends, scene)
    if scene.soil and ends:
        _foot(ends, scene)


def _filled(scene: Parts) -> None:
    """Contents are one column, full from end to end, that stands up to one level."""
    filled = [(k, section) for k, section in enumerate(scene.riser) if section.contents]
    levels = {k: section.contents.level for k, section in filled if section.contents}
    highest = max(levels, default=-1)
    for k, level in levels.items():
        if level is not None and not alike([level, levels[highest]]):
            raise ValueError(
                f"riser[{k}].contents.level {level:g} m is another than that of the highest section with "
                f"contents, {scene.riser[highest].name!r}; allowed is that one's: it counts alone"
            )
    bottom, level = scene.bottom.elevation, levels.get(highest)
    if level is None or bottom is None:
        return
    upper = bottom + sum(section.total_length for section in scene.riser[: highest + 1])
    if level < upper - ROUNDED - SLIDES * (upper - bottom):
        raise ValueError(
            f"riser[{highest}].contents.level {level:g} m is below the section's upper end at {upper:g} m; "
            "allowed is from there: contents fill a section from end to end"
        )


def span(scene: Parts) -> Span | None:
    """Elevations of the riser's ends; None where its top hangs at no elevation."""
    length = _length(scene)
    top = scene.top.elevation
    if scene.bottom.elevation is None:
        return None if top is None else Span(top - length, top)
    return Span(scene.bottom.elevation, scene.bottom.elevation + length if top is None else top)


def levels(scene: Parts, k: int) -> tuple[float, float] | None:
    """Elevations of a section's ends before it stretches (m); None where they are not given."""
    lengths = [section.total_length for section in scene.riser]
    bottom = scene.bottom.elevation
    if bottom is None:
        if scene.top.elevation is None:
            return None
        bottom = scene.top.elevation - sum(lengths)
    low = bottom + sum(lengths[:k])
    return low, low + lengths[k]


def _length(scene: Parts) -> float:
    """From end to end along the riser, with its telescopic joint (m)."""
    joint = scene.top.telescopic_joint
    return sum(s.total_length for s in scene.riser) + (joint.length if joint else 0.0)


def _reaches(scene: Parts) -> None:
    """A riser held at both ends is as long as they are apart; what is no riser may hang slack.

    That is a string without bending, or a cable whose ends are far aside of each other.
    """
    top, bottom = scene.top.elevation, scene.bottom.elevation
    if top is None or bottom is None:
        return
    upright, length = abs(top - bottom), _length(scene)
    platform = scene.platform and scene.platform.position
    aside = math.hypot(
        (scene.top.offset or 0.0) + ((platform and platform.surge) or 0.0),
        (platform and platform.sway) or 0.0,
    )
    apart = math.hypot(upright, aside)
    joint = scene.top.telescopic_joint
    spare = (SLIDES if joint else STRETCH) * length + ROUNDED
    elevations = f"bottom.elevation {bottom:g} m and top.elevation {top:g} m"
    made = f"riser{' and top.telescopic_joint' if joint else ''} of {length:.6g} m"
    if length < upright - spare or (joint is None and length < apart - spare):
        raise ValueError(
            f"{made} is too short between {elevations}, {apart:.6g} m apart; allowed is from "
            f"{upright - spare:.6g} m: check lengths, elevations and their units"
        )
    stiff = all(s.young_modulus or s.bending_stiffness for s in scene.riser)
    if stiff and aside < FAR * length and length > apart + spare:
        raise ValueError(
            f"{made} is too long between {elevations}, {apart:.6g} m apart; allowed is up to "
            f"{apart + spare:.6g} m: check lengths, elevations and their units"
        )


def _stands_in(ends: Span, scene: Parts) -> None:
    """The upper end is between keel and deck of a platform afloat, the lower end at or above the seabed."""
    surface = scene.water.surface if scene.water else None
    seabed = scene.water.seabed if scene.water else None
    drawn = min(ROUNDED, 0.01 * (ends.top - ends.bottom))
    if surface is not None and not surface - KEEL <= ends.top <= surface + DECK:
        raise ValueError(
            f"water.surface {surface:g} m: the riser's upper end is at {ends.top:g} m; allowed is from "
            f"{KEEL:g} m below the surface to {DECK:g} m above it: check water.surface, elevations and "
            "lengths"
        )
    if seabed is None:
        return
    if scene.bottom.hold != "foot" and ends.bottom < seabed - drawn:
        raise ValueError(
            f"water.seabed {seabed:g} m: the riser's lower end is at {ends.bottom:g} m, below it; allowed "
            "below the seabed is the foot of a conductor alone ('bottom.hold: foot')"
        )
    if scene.bottom.hold == "wellhead" and ends.bottom > seabed + STACK:
        raise ValueError(
            f"water.seabed {seabed:g} m: the riser's lower end is held at {ends.bottom:g} m; allowed is up "
            f"to {STACK:g} m above the seabed: check water.seabed and bottom.elevation"
        )


def _foot(ends: Span, scene: Parts) -> None:
    """The mudline lies on the sections below the flex joint, and not above the sea's bed."""
    if scene.soil is None:
        return
    mudline, head, low = scene.soil.mudline, ends.bottom, []
    for section in scene.riser[: max(scene.lowest_riser_section, 1)]:
        low += [section] if head < mudline else []
        head += section.total_length
    if not ends.bottom < mudline <= head + ROUNDED:
        raise ValueError(
            f"soil.mudline {mudline:g} m is not on the sections below the flex joint, or the lowest one; "
            f"allowed is above {ends.bottom:g} m and up to {head:g} m"
        )
    if lacking := [section.name for section in low if section.outer_diameter is None]:
        raise ValueError(f"soil needs the outer_diameter of section {lacking[0]!r}")
    deepest = mudline - ends.bottom
    if isinstance(scene.soil.resistance, TabulatedSoil):
        depths = [*scene.soil.resistance.curves]
        if depths[0] > 0.0 or depths[-1] < deepest - ROUNDED:
            raise ValueError(
                f"soil.resistance.table reaches from {depths[0]:g} m to {depths[-1]:g} m below the mudline; "
                f"allowed is from 0 m to the foot, {deepest:g} m"
            )
    seabed = scene.water.seabed if scene.water else None
    if seabed is not None and mudline > seabed + ROUNDED:
        raise ValueError(
            f"soil.mudline {mudline:g} m lies above water.seabed {seabed:g} m; allowed is up to the seabed"
        )


def covered(scene: Parts) -> None:
    """See that a current says what it is all along the riser.

    Raises
    ------
    ValueError
        Field, what was found and what is allowed.
    """
    flow, water, ends = scene.current, scene.water, span(scene)
    if flow is None:
        return
    _in_water(scene)
    if flow.beyond is not None:
        return
    where = _levels_of_current(scene)
    if where is None:
        return
    low, high = where
    if ends is None:  # a hanging riser of unsaid elevation
        return
    seabed, surface = (water.seabed, water.surface) if water else (None, None)
    needs_low = ends.bottom if seabed is None else max(ends.bottom, seabed)
    needs_high = ends.top if surface is None else min(ends.top, surface)
    slip = min(ROUNDED, 0.01 * (ends.top - ends.bottom))
    if low > needs_low + slip or high < needs_high - slip:
        raise ValueError(
            f"current.profile reaches from {low:g} m to {high:g} m of elevation, the riser in water from "
            f"{needs_low:g} m to {needs_high:g} m; give the rest of the profile, or say what holds there, "
            "as 'current.beyond: hold' (its end values) or 'zero' (still water)"
        )


def _in_water(scene: Parts) -> None:
    """Points by elevation lie in the water, wherever end values hold: depths typed there would not."""
    flow, surface = scene.current, scene.water.surface if scene.water else None
    points = flow.profile if flow and isinstance(flow.profile, list) else []
    elevations = [point.elevation for point in points if point.elevation is not None]
    if surface is not None and elevations and min(elevations) >= surface:
        raise ValueError(
            f"current.profile says nothing of the water: its elevations are from {min(elevations):g} m to "
            f"{max(elevations):g} m, the surface is at {surface:g} m; allowed are points below it, or 'depth'"
        )


def _levels_of_current(scene: Parts) -> tuple[float, float] | None:
    """Elevations between which a current is given (m); None where the sea's own levels bound it."""
    flow, water = scene.current, scene.water
    if flow is None:
        return None
    if isinstance(flow.profile, list):
        z, _ = flow.table(water)
        return z[0], z[-1]
    lows = [low for part in flow.parts if (low := getattr(part, "seabed", None)) is not None]
    highs = [high for part in flow.parts if (high := getattr(part, "surface", None)) is not None]
    if not lows and not highs:
        return None
    return max(lows, default=-math.inf), min(highs, default=math.inf)
