"""A scene as the engine studies run it: with histories at all nodes, a method, a mesh and a time step."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from riserstudy.model.mesh import Mesh
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.scene.resolve import Resolved

#: settings that are removed from a scene before a method, a mesh and a step are set
FREE = {f"analysis.{name}": None for name in ("mesh", "step", "method", "solver")}
MOST_ELEMENTS = 20_000  # most that a scene file may give; refined meshes may have more


def freed(path: Path, sets: dict[str, Any], where: str) -> SceneFile:
    """Read a scene, remove its settings, and then set values, which may set them again."""
    return read_scene(path).with_values(FREE, where).with_values(sets, where)


def whole(scene: Resolved) -> Resolved:
    """Return the scene with histories at all nodes."""
    output = scene.analysis.output
    if output is None:
        return scene
    return scene.replaced(analysis=scene.analysis.replaced(output=output.replaced(stations=None)))


def stepped(file: SceneFile, values: dict[str, Any], mesh: Mesh, step: float | None) -> Resolved:
    """Return the scene with a method, and with mesh and step, because some methods require them."""
    fixed: dict[str, Any] = {"analysis.accuracy": None}
    fixed["analysis.mesh"] = {"elements": min(len(mesh.l0), MOST_ELEMENTS)}
    if step:
        fixed["analysis.step"] = f"{step!r} s"
    return file.with_values(fixed, "mesh and step").with_values(values, "method").resolved()
