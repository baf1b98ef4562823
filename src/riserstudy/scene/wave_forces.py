"""Warnings about parts in the water on which it exerts only a part of its forces, or none."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.geometry import levels

if TYPE_CHECKING:
    from riserstudy.scene.resolve import Resolved

MOST_IN_WATER = 0.5  # share of a telescopic joint below the surface, up to which there is no warning


def without_inertia(scene: Resolved) -> list[RunWarning]:
    """Warnings about sections with drag but without added mass, on which waves exert no inertia force.

    The inertia force has the factor 1 + Ca. With a coefficient of 0 the factor is 1; with an absent field
    there is no inertia force.
    """
    if scene.wave is None:
        return []
    text = (
        "{line}.added_mass: {name} has drag in waves but no added mass, so the water's acceleration exerts "
        "no force on it; add added_mass (its coefficient 0 gives the Froude-Krylov force)"
    )
    return [
        warning("drag_without_added_mass", text, {"line": section.line, "name": repr(section.name)})
        for section in scene.riser
        if section.drag is not None and section.added_mass is None
    ]


def joint_in_water(scene: Resolved) -> list[RunWarning]:
    """A warning about a telescopic joint that is mostly in the water, which exerts no forces on it."""
    joint, surface = scene.top.telescopic_joint, scene.water.surface if scene.water else None
    ends = levels(scene, len(scene.riser) - 1)
    acts = (scene.current or scene.wave) and any(s.drag or s.added_mass for s in scene.riser)
    if joint is None or surface is None or ends is None or not acts:
        return []
    deep = surface - ends[1]
    if deep <= MOST_IN_WATER * joint.length:
        return []
    text = (
        "top.telescopic_joint: {deep:.3g} m of {length:.3g} m are below the water surface, but water "
        "exerts no forces on the joint; model its part in water as a section of the riser"
    )
    return [warning("joint_in_water", text, {"deep": min(deep, joint.length), "length": joint.length})]
