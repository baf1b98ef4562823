"""Whether lengths and elevations agree, to detect errors of unit or sign.

Refused are risers that cannot be built: a riser that does not reach from end to end, or an end far from the
sea surface or the seabed. If a scene does not give these levels, they are not compared.
"""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.alike import alike
from riserstudy.scene.geometry import ROUNDED, length_of, span
from riserstudy.scene.limits import ENDS as ENDS_OF_SECTIONS
from riserstudy.scene.soil import TabulatedSoil

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.parts import Parts
    from riserstudy.scene.riser import Section

# largest share of its length by which a held riser may stretch: steel yields at 0.003
STRETCH = 0.01
SLIDES = 0.003  # the same for a riser with a telescopic joint, whose length is given
# offset of the top, as a share of the length, from which a string is a slack cable and no riser
FAR = 0.5
STACK = 50.0  # m, the tallest wellhead, BOP and LMRP below a riser's lower end
DECK = 100.0  # m, the highest deck above the sea
KEEL = 30.0  # m, the deepest keel below it, from which a riser may hang
ENDS = ("bottom.elevation", "top.elevation")


def names(scene: Parts) -> Iterator[Misfit]:
    """Names of sections must be different, and none may look like the end of another section."""
    for k, section in enumerate(scene.riser):
        if not section.name.strip() or section.name.startswith(ENDS_OF_SECTIONS):
            found = f"{section.name!r} does not name a section"
            remedy = "give a name that is not empty and does not start with 'lower end of' or 'upper end of'"
            yield Misfit(f"riser[{k}].name", found, remedy)
    for name, count in Counter(section.name for section in scene.riser).items():
        if count > 1:
            found = f"{count} sections are named {name!r}"
            yield Misfit("riser", found, "give each section a different name")


def reaches(scene: Parts) -> Iterator[Misfit]:
    """A riser held at both ends must be as long as the distance between them.

    A string without bending stiffness, or a cable with its ends far apart horizontally, may be slack.
    """
    top, bottom = scene.top.elevation, scene.bottom.elevation
    if top is None or bottom is None:
        return
    upright, length = abs(top - bottom), length_of(scene)
    platform = scene.platform and scene.platform.position
    aside = math.hypot(
        (scene.top.offset or 0.0) + ((platform and platform.surge) or 0.0),
        (platform and platform.sway) or 0.0,
    )
    apart, joint = math.hypot(upright, aside), scene.top.telescopic_joint
    spare = (SLIDES if joint else STRETCH) * length + ROUNDED
    stiff = all(s.young_modulus or s.bending_stiffness for s in scene.riser)
    fault, allowed = "", ""
    if length < upright - spare or (joint is None and length < apart - spare):
        fault, allowed = "short", f"at least {upright - spare:.6g} m"
    elif stiff and aside < FAR * length and length > apart + spare:
        fault, allowed = "long", f"at most {apart + spare:.6g} m"
    if fault:
        yield Misfit(
            "riser",
            f"the length {length:.6g} m{' with top.telescopic_joint' if joint else ''} is too {fault} "
            f"between bottom.elevation {bottom:g} m and top.elevation {top:g} m, which are {apart:.6g} m "
            "apart",
            f"give {allowed}, or correct the elevations or units",
            (*ENDS, "top.telescopic_joint", "top.offset", "platform.position"),
        )


def filled(scene: Parts) -> Iterator[Misfit]:
    """Contents must fill their sections completely, as one column up to one level."""
    levels = {k: s.contents.level for k, s in enumerate(scene.riser) if s.contents}
    highest = max(levels, default=-1)
    path = f"riser[{highest}].contents.level"
    for k, level in levels.items():
        if level is not None and not alike([level, levels[highest]]):
            found = (
                f"{level:g} m differs from the level of the highest section with contents, "
                f"{scene.riser[highest].name!r}"
            )
            used = levels[highest]
            remedy = "remove this level" if used is None else f"give {used:g} m, or remove this level"
            yield Misfit(f"riser[{k}].contents.level", found, remedy, (path,))
    ends, level = span(scene), levels.get(highest)
    if level is None or ends is None:
        return
    upper = ends.bottom + sum(section.total_length for section in scene.riser[: highest + 1])
    if level < upper - ROUNDED - SLIDES * (upper - ends.bottom):
        found = f"{level:g} m is below the upper end of the section at {upper:g} m"
        remedy = f"give {upper:g} m or more, or divide the section at the level of the contents"
        yield Misfit(path, found, remedy, ENDS)


def levels(scene: Parts) -> Iterator[Misfit]:
    """The upper end must be between keel and deck of a platform, the lower end at or above the seabed."""
    ends = span(scene)
    if scene.water is None or ends is None:
        return
    surface, seabed = scene.water.surface, scene.water.seabed
    drawn = min(ROUNDED, 0.01 * (ends.top - ends.bottom))
    if surface is not None and not surface - KEEL <= ends.top <= surface + DECK:
        yield Misfit(
            "water.surface",
            f"the surface is at {surface:g} m, but the upper end of the riser is at {ends.top:g} m",
            f"correct elevations or lengths: the upper end must be between {KEEL:g} m below the surface and "
            f"{DECK:g} m above it",
            (*ENDS, "riser"),
        )
    if seabed is None:
        return
    if scene.bottom.hold != "foot" and ends.bottom < seabed - drawn:
        yield Misfit(
            "water.seabed",
            f"the lower end of the riser, at {ends.bottom:g} m, is below the seabed at {seabed:g} m",
            "correct the elevations, or write 'bottom.hold: foot' for a conductor in the soil",
            (*ENDS, "riser"),
        )
    if scene.bottom.hold == "wellhead" and ends.bottom > seabed + STACK:
        yield Misfit(
            "water.seabed",
            f"the lower end of the riser is held at {ends.bottom:g} m, more than {STACK:g} m above the "
            f"seabed at {seabed:g} m",
            "correct water.seabed or bottom.elevation",
            (*ENDS, "riser"),
        )


def foot(scene: Parts) -> Iterator[Misfit]:
    """The mudline must be on the sections below the flex joint, and not above the seabed."""
    ends, soil = span(scene), scene.soil
    if soil is None or ends is None:
        return
    low: dict[int, Section] = {}
    head, mudline = ends.bottom, soil.mudline
    for k, section in enumerate(scene.riser[: max(scene.lowest_riser_section, 1)]):
        if head < mudline:
            low[k] = section
        head += section.total_length
    if not ends.bottom < mudline <= head + ROUNDED:
        found = f"{mudline:g} m is not on the conductor (the sections below the flex joint)"
        remedy = f"give an elevation above {ends.bottom:g} m and up to {head:g} m"
        yield Misfit("soil.mudline", found, remedy, (*ENDS, "riser"))
    for k, section in low.items():
        if section.outer_diameter is None:
            found = f"missing, but section {section.name!r} is in the soil"
            yield Misfit(f"riser[{k}].outer_diameter", found, "add outer_diameter", ("soil",))
    deepest = mudline - ends.bottom
    if isinstance(soil.resistance, TabulatedSoil):
        depths = [*soil.resistance.curves]
        if depths[0] > 0.0 or depths[-1] < deepest - ROUNDED:
            found = f"covers depths from {depths[0]:g} m to {depths[-1]:g} m below the mudline only"
            remedy = f"give rows from 0 m to the lower end of the conductor, {deepest:g} m"
            yield Misfit("soil.resistance.table", found, remedy, ("soil.mudline", *ENDS))
    seabed = scene.water.seabed if scene.water else None
    if seabed is not None and mudline > seabed + ROUNDED:
        found = f"{mudline:g} m is above the seabed at {seabed:g} m"
        yield Misfit("soil.mudline", found, "correct soil.mudline or water.seabed", ("water.seabed",))
