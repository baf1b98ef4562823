"""Groups of kernels, and the group that a scene needs."""

from __future__ import annotations

from riserstudy.scene.resolve import Resolved

#: Hermite elements, along a line, in a plane, in space, without bending stiffness; groups that compile in the
#: shortest time come first, but groups that most studies need before groups that few studies need
GROUPS = ("hermite", "line", "plane", "space", "string")


def group_of_modes(scene: Resolved) -> str:
    """The group with most of the kernels for a scene's modes, which include lateral modes without a load."""
    bends = all(bending for _, bending in (section.elasticity for section in scene.riser))
    if scene.spatial or scene.lateral or not bends or scene.top.x is None:
        return group_of(scene.replaced(analysis=scene.analysis.replaced(solver=None)))
    return "plane"


def group_of(scene: Resolved) -> str:
    """The group with most of the kernels that a scene needs; it compiles the others when they are called."""
    if scene.analysis.solver == "hermite":
        return "hermite"
    if not (scene.lateral or scene.spatial):
        return "line"
    if not any(bending for _, bending in (section.elasticity for section in scene.riser)):
        return "string"
    return "space" if scene.spatial else "plane"
