"""Requirements of the riser's sections and of the bodies on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.alike import alike
from riserstudy.scene.ends import FlexJoint

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.parts import Parts


def bends(scene: Parts) -> list[bool]:
    """Whether each section has bending stiffness."""
    return [bool(s.young_modulus or s.bending_stiffness) for s in scene.riser]


def _without(part: str) -> tuple[str, str]:
    """Fault and remedy of an input that requires another part of the scene."""
    return f"requires {part} in the scene", f"add {part}, or remove this input"


def water(scene: Parts) -> Iterator[Misfit]:
    """Drag, added mass and a current require water."""
    if scene.water is not None:
        return
    for k, section in enumerate(scene.riser):
        for name in ("drag", "tangential_drag", "added_mass"):
            if getattr(section, name):
                yield Misfit(f"riser[{k}].{name}", *_without("water"), ("water",))
    for name, body in (("bottom.body", scene.bottom.body), ("top.body", scene.top.body)):
        if body and body.drag_area:
            yield Misfit(f"{name}.drag_area", *_without("water"), ("water",))
    if scene.current:
        yield Misfit("current", *_without("water"), ("water",))


def gravity(scene: Parts) -> Iterator[Misfit]:
    """Contents, pistons and bodies with a derived weight require gravity."""
    if scene.gravity is None:
        filled = [f"riser[{k}].contents" for k, s in enumerate(scene.riser) if s.contents]
        rig = scene.top.tensioners
        heavy = [*filled, *(["top.tensioners.piston_mass"] if rig and rig.piston_mass else [])]
        for path in heavy:
            yield Misfit(path, *_without("gravity"), ("gravity",))
    if scene.gravity is not None and scene.water is not None:
        return
    for end, body in (("bottom", scene.bottom.body), ("top", scene.top.body)):
        if body and (body.displaced_volume is not None or body.density):
            found = "displaced_volume and density require gravity and water in the scene"
            remedy = "add gravity and water, or give submerged_weight instead"
            yield Misfit(f"{end}.body", found, remedy, ("gravity", "water"))


def mass(scene: Parts) -> Iterator[Misfit]:
    """Dynamics require mass, and a loss of tension requires a duration."""
    if scene.analysis.duration and not (
        all(s.mass for s in scene.riser) or scene.top.body or scene.bottom.body
    ):
        found, remedy = "a dynamic run requires the mass of every section", "add mass to the sections"
        yield Misfit("riser", found, remedy, ("analysis.duration",))
    if scene.top.tension_loss and scene.analysis.duration is None:
        found = "has no effect on a static run"
        remedy = "add analysis.duration and output, or remove tension_loss"
        yield Misfit("top.tension_loss", found, remedy, ("analysis.duration",))


def bending(scene: Parts) -> Iterator[Misfit]:
    """Bending stiffness and damping must be given in all sections alike, or in none."""
    stiff = bends(scene)
    if any(stiff) and not all(stiff):
        found = f"section {scene.riser[stiff.index(False)].name!r} has no bending stiffness, but others have"
        yield Misfit("riser", found, "give bending stiffness to all sections, or to none")
    damping = [s.structural_damping for s in scene.riser]
    if not alike(d.time if d else None for d in damping):
        found = "structural_damping differs between sections"
        yield Misfit("riser", found, "give the same structural_damping to all sections")
    if scene.top.telescopic_joint and not all(stiff):
        found = "requires a riser with bending stiffness"
        remedy = "give young_modulus and diameters, or bending_stiffness, to all sections"
        yield Misfit("top.telescopic_joint", found, remedy, ("riser",))


def turning(scene: Parts) -> Iterator[Misfit]:
    """The rotation of an end can be held only if the riser has bending stiffness."""
    if any(bends(scene)):
        return
    for name, rotation in (("bottom", scene.bottom.rotation), ("top", scene.top.rotation)):
        if rotation == "fixed" or (isinstance(rotation, FlexJoint) and rotation.stiffness):
            found = "has no effect on a riser without bending stiffness"
            remedy = "remove it, or give bending stiffness to all sections"
            yield Misfit(f"{name}.rotation", found, remedy, ("riser",))


def joint(scene: Parts) -> Iterator[Misfit]:
    """One flex joint is possible, between sections that bend; a guide is not possible at a held lower end."""
    joints = [k for k, s in enumerate(scene.riser) if s.flex_joint_below]
    if joints and (not all(bends(scene)) or len(joints) > 1 or joints[0] == 0):
        if len(joints) > 1:
            found = f"{len(joints)} sections have a flex joint below them"
            remedy = "keep one; a joint at the lower end of the riser is bottom.rotation"
        elif joints[0] == 0:
            found = "the lowest section has no section below it"
            remedy = "give the joint at the lower end of the riser as bottom.rotation"
        else:
            found = "a flex joint requires sections with bending stiffness"
            remedy = "give bending stiffness to all sections, or remove the joint"
        yield Misfit(f"riser[{joints[-1]}].flex_joint_below", found, remedy)
    if scene.riser[0].guide_below and scene.bottom.hold != "free":
        found = "a guide has no effect at a held lower end"
        remedy = "remove it, or give it to a section above"
        yield Misfit("riser[0].guide_below", found, remedy, ("bottom.hold",))
