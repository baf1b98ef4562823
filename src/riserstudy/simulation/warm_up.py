"""Compile every kernel by small models that together have all effects, for each group of kernels.

The scenes are in ``warm_up_scenes``, a file for each group.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from riserstudy.effects.catalogue import catalogue
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.model.layout import directions
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.kernel_groups import GROUPS
from riserstudy.simulation.refine import run

DATA_FILES = (
    "warm_up_scenes/hermite.yaml",
    "warm_up_scenes/line.yaml",
    "warm_up_scenes/plane.yaml",
    "warm_up_scenes/space.yaml",
    "warm_up_scenes/string.yaml",
)


def scenes() -> dict[str, list[Resolved]]:
    """Small scenes that together have every effect, by group of kernels."""
    return {group: scenes_of(group) for group in GROUPS}


def scenes_of(group: str) -> list[Resolved]:
    """Small scenes of one group of kernels."""
    path = Path(__file__).with_name("warm_up_scenes") / f"{group}.yaml"
    files: dict[str, SceneFile] = {}
    scenes = []
    for name, about in read_yaml(path).items():
        files[name] = file = _file(about, files, f"{path}: {name}")
        scenes.append((_with_examples(file) if about.get("examples") else file).resolved())
    return scenes


def _file(about: dict[str, Any], files: dict[str, SceneFile], where: str) -> SceneFile:
    """A scene as written in the file, or derived from another scene of the same file."""
    if "like" in about:
        return files[about["like"]].with_values(about["set"], where)
    return SceneFile(where, about["scene"], {})


def _with_examples(file: SceneFile) -> SceneFile:
    """A scene with the example inputs of all effects that fit its directions."""
    needed = directions(file.resolved())
    for effect in catalogue().values():
        if effect.example:
            more = file.with_values(dict(effect.example), "examples of effects")
            file = more if directions(more.resolved()) == needed else file
    return file


def warm_up(group: str | None = None) -> None:
    """Run the scenes of all groups, or of one group."""
    for name in GROUPS if group is None else (group,):
        for scene in scenes_of(name):
            run(scene)
