"""Weights of sections: given, or computed from mass, diameters and contents.

``submerged_weight`` excludes the contents. It is the weight of the pipe and of all parts fixed to it, minus
the weight of the water that its outer surface displaces, as if the bore were empty. The weight of contents is
added to it. For a riser that is open to the sea, a scene gives sea water as contents, or it includes the
weight of this water in ``submerged_weight`` and gives no contents.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from riserstudy.inputs.misfit import Misfit
from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.geometry import levels
from riserstudy.scene.modules_and_lines import disc

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts
    from riserstudy.scene.riser import Section

# share of the dry weight by which a weight must exceed the largest possible one to be doubted
DOUBTED = 0.02


def weighed(scene: Parts) -> list[Section]:
    """The sections, each with its weight.

    Raises Misfit if a weight is neither given nor computable, in a scene with gravity, water or other
    weights.
    """
    without = [k for k, section in enumerate(scene.riser) if section.submerged_weight is None]
    weightless = scene.gravity is None and scene.water is None
    if not without or (weightless and len(without) == len(scene.riser)):
        return scene.riser  # mechanics without weight
    sections = list(scene.riser)
    for k in without:
        section = sections[k]
        if None in (scene.gravity, section.mass, section.inner_diameter, section.contents):
            raise Misfit(
                f"{section.line}.submerged_weight",
                f"the weight of section {section.name!r} is missing",
                "add submerged_weight, or add gravity and the mass, diameters and contents of this section",
                ("gravity", "water", "riser"),
            )
        weight = (scene.gravity or 0.0) * ((section.mass or 0.0) - _displaced(scene, k))
        sections[k] = section.replaced(submerged_weight=weight)
    return sections


def with_attachments(scene: Parts) -> list[Section]:
    """The sections, each with mass and weight of its pipe, modules and lines together.

    Raises Misfit if gravity or the weight of a pipe is missing.
    """
    if not any(section.modules or section.lines for section in scene.riser):
        return scene.riser
    if scene.gravity is None:
        found = "modules and lines of a section require gravity in the scene"
        raise Misfit("riser", found, "add gravity, or remove modules and lines", ("gravity",))
    modular = any(section.modules for section in scene.riser)
    sections = list(scene.riser)
    for k, section in enumerate(scene.riser):
        if section.submerged_weight is None:
            found = "missing, but sections with modules or lines require it"
            remedy = "add the submerged weight of the pipe alone"
            raise Misfit(f"{section.line}.submerged_weight", found, remedy, ("riser",))
        bare = section.buoyancy_lift is None and modular
        more: dict[str, float] = {"buoyancy_lift": 0.0} if bare else {}
        if section.modules or section.lines:
            adds = _attached(section, scene.gravity, _water_around(scene, k))
            more |= {
                "mass": (section.mass or 0.0) + adds.mass,
                "submerged_weight": section.submerged_weight + adds.weight,
            }
            if section.modules:
                more["buoyancy_lift"] = adds.lift
        sections[k] = section.replaced(**more)
    return sections


class _Attached(NamedTuple):
    """Mass (kg/m) and weight (N/m) of the attachments to a pipe, and net lift of the modules (N/m)."""

    mass: float
    weight: float
    lift: float


def _attached(section: Section, gravity: float, water: float) -> _Attached:
    """Values that modules and lines add to a section, in gravity (m/s2) and water (kg/m3; 0 above it)."""
    lines = section.lines or []
    mass, outside = sum(line.all_mass for line in lines), sum(line.outside for line in lines)
    weight = gravity * (mass - water * outside)
    if section.modules is None:
        return _Attached(mass, weight, 0.0)
    each = section.joints.length if section.joints else section.total_length
    own = section.modules.mass / each
    lift = section.modules.lift / each if water else 0.0
    return _Attached(mass + own, weight + (-lift if water else gravity * own), lift)


def doubts(scene: Parts) -> list[RunWarning]:
    """Warnings about weights that contradict diameters, and about bodies with mass but without weight.

    A part fixed to a pipe displaces additional water. Without contents, a section can therefore not weigh
    more than its mass minus the water that its outer diameter displaces. Above the water it displaces none,
    and cannot weigh less than its mass.
    """
    found = _weightless(scene)
    for k, section in enumerate(scene.riser):
        if None in (section.submerged_weight, section.mass, section.contents, scene.gravity):
            continue
        dry = (scene.gravity or 0.0) * (section.mass or 0.0)
        most = dry - (scene.gravity or 0.0) * (0.0 if _dips(scene, k) else _displaced(scene, k))
        weight = section.submerged_weight or 0.0
        values = {"line": section.line, "name": repr(section.name), "weight": weight}
        if weight > most + DOUBTED * dry:
            text = (
                "{line}.submerged_weight: {weight:plain4} N/m of section {name} is more than the weight of "
                "its mass minus the displaced water, {most:plain4} N/m; give the weight without contents, "
                "which the engine adds"
            )
            found.append(warning("weight_with_contents", text, {**values, "most": most}))
        if _dry(scene, k) and weight < dry - DOUBTED * dry:
            text = (
                "{line}.submerged_weight: section {name} is above the water, but its weight {weight:plain4} "
                "N/m is less than mass times gravity, {dry:plain4} N/m; give its weight in air"
            )
            found.append(warning("weight_in_water_of_a_dry_section", text, {**values, "dry": dry}))
    return found


def _weightless(scene: Parts) -> list[RunWarning]:
    """A warning for each body of some mass that has no weight, in a scene with gravity."""
    ends = {"bottom.body": scene.bottom.body, "top.body": scene.top.body}
    text = (
        "{path}: {name} has a mass of {mass:g} kg, but no weight, which therefore counts as zero; give its "
        "submerged_weight, displaced_volume or density"
    )
    return [
        warning("body_without_weight", text, {"path": path, "name": repr(body.name), "mass": body.mass})
        for path, body in ends.items()
        if body and body.mass and scene.gravity and body.weightless
    ]


def _dips(scene: Parts, k: int) -> bool:
    """Whether a section is partly or wholly above the water."""
    ends = levels(scene, k)
    surface = scene.water.surface if scene.water else None
    return bool(ends and surface is not None and ends[1] > surface)


def _displaced(scene: Parts, k: int) -> float:
    """Mass of the water that a section displaces (kg/m)."""
    return _water_around(scene, k) * disc(scene.riser[k].outer_diameter or 0.0)


def _water_around(scene: Parts, k: int) -> float:
    """Density of the water around a section (kg/m3), 0 above it."""
    return 0.0 if scene.water is None or _dry(scene, k) else scene.water.density


def is_dry(scene: Parts, section: Section) -> bool:
    """Whether a section of the scene is wholly above the water."""
    return _dry(scene, next(k for k, one in enumerate(scene.riser) if one is section))


def _dry(scene: Parts, k: int) -> bool:
    """Whether a section is wholly above the water."""
    ends = levels(scene, k)
    surface = scene.water.surface if scene.water else None
    return bool(ends and surface is not None and ends[0] >= surface)
