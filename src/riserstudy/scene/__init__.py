"""Scenes: what is there, in the units of its source, and where each value comes from."""

from riserstudy.scene.load import load_scene
from riserstudy.scene.models import Scene

__all__ = ["Scene", "load_scene"]
