"""Division of sections at the water surface, if their weight is computed from their parts.

Buoyancy acts only below the surface.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.geometry import levels
from riserstudy.scene.limits import ABOVE

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts
    from riserstudy.scene.riser import Section


def cut(scene: Parts) -> list[Section]:
    """The sections; a section that crosses the surface is divided unless its total weight is given.

    A pipe weight that is given together with modules or lines is a submerged weight. For the part above the
    surface, the weight of the displaced water is added to it. Raises Misfit if the output of stress names a
    divided section, or a divided section has no outer diameter.
    """
    if scene.water is None or scene.water.surface is None or scene.gravity is None:
        return scene.riser
    surface = scene.water.surface
    sections: list[Section] = []
    for k, section in enumerate(scene.riser):
        ends = levels(scene, k)
        follows = section.submerged_weight is None or section.modules or section.lines
        if not (follows and ends and ends[0] < surface < ends[1]):
            sections.append(section)
            continue
        output = scene.analysis.output
        if output and output.stress_in == section.name:
            found = f"{section.name!r} crosses the water surface, where it is divided"
            remedy = "divide it into two sections at the surface, and name one of them"
            raise Misfit("analysis.output.stress_in", found, remedy, ("riser", "water.surface"))
        above: dict[str, Any] = {"flex_joint_below": None, "guide_below": None}
        if section.submerged_weight is not None:
            if section.outer_diameter is None:
                raise Misfit(
                    f"{section.line}.outer_diameter",
                    f"missing, but section {section.name!r} crosses the water surface, so its buoyancy must "
                    "be known",
                    "add outer_diameter, or divide it into two sections with their weights",
                    ("riser", "water.surface"),
                )
            displaced = scene.water.density * 0.25 * math.pi * section.outer_diameter**2
            above["submerged_weight"] = section.submerged_weight + displaced * scene.gravity
        if section.name + ABOVE in [other.name for other in scene.riser]:
            found = f"section {section.name!r} is divided at the water surface, which needs the name "
            found += f"{section.name + ABOVE!r} for its upper part"
            remedy = "rename the other section of this name"
            raise Misfit(f"{section.line}.name", found, remedy, ("riser", "water.surface"))
        upper = _part(section, section.name + ABOVE, ends[1] - surface)
        lower = _part(section, section.name, surface - ends[0])
        sections += [lower, upper.replaced(**above)]
    return scene.riser if len(sections) == len(scene.riser) else sections


def _part(section: Section, name: str, length: float) -> Section:
    """A part of a section with a length (m), and its share of the modules."""
    modules = section.modules
    if modules:
        share = length / section.total_length * (section.joints.count if section.joints else 1)
        modules = modules.replaced(mass=share * modules.mass, lift=share * modules.lift)
    return section.replaced(name=name, length=length, joints=None, modules=modules)
