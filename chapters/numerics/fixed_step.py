"""A scene as a study of the engine runs it: with histories everywhere, a method, a mesh and a step."""

from __future__ import annotations

from typing import Any

from riserstudy.model.mesh import Mesh
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved

#: what a scene is freed of before methods, meshes and steps are put in
FREE = {f"analysis.{name}": None for name in ("mesh", "step", "method", "solver")}
MOST_ELEMENTS = 20_000  # that a scene may name; meshes made by refining may have more


def whole(scene: Resolved) -> Resolved:
    """The scene with histories at all nodes."""
    output = scene.analysis.output
    if output is None:
        return scene
    everywhere = output.model_copy(update={"stations": None})
    analysis = scene.analysis.model_copy(update={"output": everywhere})
    return scene.model_copy(update={"analysis": analysis})


def stepped(file: SceneFile, values: dict[str, Any], mesh: Mesh, step: float | None) -> Resolved:
    """The scene with a method; mesh and step stand in it because some methods ask for them."""
    fixed: dict[str, Any] = {"analysis.accuracy": None}
    fixed["analysis.mesh"] = {"elements": min(len(mesh.l0), MOST_ELEMENTS)}
    if step:
        fixed["analysis.step"] = f"{step!r} s"
    return file.with_values(fixed | values, "method").resolved()
