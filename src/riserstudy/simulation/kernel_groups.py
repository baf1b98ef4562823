"""Groups of kernels that scenes of a kind share: which of them a scene runs."""

from __future__ import annotations

from riserstudy.scene.resolve import Resolved

#: of Hermite elements, along a line, in a plane, in space, without bending stiffness; what is compiled in
#: the shortest time first, but what most studies need before what few do
GROUPS = ("hermite", "line", "plane", "space", "string")


def group_of_modes(scene: Resolved) -> str:
    """The group with most of the kernels that a scene's modes take: sideways without a load, too."""
    bends = all(bending for _, bending in (section.elasticity for section in scene.riser))
    if scene.spatial or scene.lateral or not bends or scene.top.x is None:
        lumped = scene.analysis.model_copy(update={"solver": None})
        return group_of(scene.model_copy(update={"analysis": lumped}))
    return "plane"


def group_of(scene: Resolved) -> str:
    """The group with most of the kernels that a scene runs; others it compiles as it comes to them."""
    if scene.analysis.solver == "hermite":
        return "hermite"
    if not (scene.lateral or scene.spatial):
        return "line"
    if not any(bending for _, bending in (section.elasticity for section in scene.riser)):
        return "string"
    return "space" if scene.spatial else "plane"
