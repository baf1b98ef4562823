"""Groups of kernels that scenes of a kind share: which of them a scene runs."""

from __future__ import annotations

from riserstudy.scene.models import Scene

#: by the name of their marker; those that most scenes need first
GROUPS = {
    "plane": "risers in a plane",
    "line": "risers along a line",
    "space": "risers in space",
    "string": "strings without bending stiffness",
    "hermite": "beams of Hermite elements",
}


def group_of(scene: Scene) -> str:
    """The group with most of the kernels that a scene runs; others it compiles as it comes to them."""
    if scene.analysis.solver == "hermite":
        return "hermite"
    if not (scene.lateral or scene.spatial):
        return "line"
    if not any(bending for _, bending in (section.elasticity for section in scene.riser)):
        return "string"
    return "space" if scene.spatial else "plane"
