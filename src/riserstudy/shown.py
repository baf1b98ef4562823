"""What a study file shows besides figures of its datasets: scenes drawn to scale, a run in motion."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

from pydantic import Field

from riserstudy.scene.base import Strict
from riserstudy.scene.load import SceneFile, read_scene


class SchematicModel(Strict):
    """A scene drawn to scale, with what is set on top of it. Absent set: nothing."""

    caption: str
    scene: str
    set: dict[str, Any] = Field(default_factory=dict)

    def file(self, config: Path) -> SceneFile:
        """The scene that is drawn."""
        return read_scene(config / self.scene).with_values(self.set, "schematics.set")


class RunInMotion(Strict):
    """A run that the report shows moving, by its place on the axes, and the quantity that colours it."""

    study: str
    at: dict[str, str | float] = Field(default_factory=dict)
    colour: Literal["bending_moment", "effective_tension"]
