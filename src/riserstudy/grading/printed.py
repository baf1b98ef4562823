"""Which values of a scene its paper prints: a plain value says that it does, and must be on the list."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from riserstudy.grading.models import PrintedInput, PublishedFile, published_path
from riserstudy.scene.check import check
from riserstudy.scene.load import SceneFile, read_yaml
from riserstudy.scene.origin import plain_values


def printed_inputs(config: Path, paper: str) -> list[PrintedInput]:
    """What the file of a paper lists; nothing where there is no file or no list.

    Raises
    ------
    InputError
        When the file cannot be meant.
    """
    path = published_path(config, paper)
    if not path.exists():
        return []
    return check(PublishedFile, read_yaml(path, keep=True), path).inputs


def printed_as(inputs: Iterable[PrintedInput], path: str, value: Any) -> PrintedInput | None:
    """The printed input that a value at a dotted path of a scene is, if it is one."""
    for printed in inputs:
        if str(printed.value) == str(value) and any(_leads(at, path) for at in printed.paths):
            return printed
    return None


def unprinted(inputs: list[PrintedInput], scene: SceneFile) -> list[tuple[str, Any]]:
    """Plain values of a scene, by dotted path, that are on no list of what its paper prints."""
    return [
        (path, value)
        for path, value in plain_values(scene.tree, scene.origins)
        if printed_as(inputs, path, value) is None
    ]


def _leads(at: str, path: str) -> bool:
    """Whether a place, in which ``[*]`` is any index, is a path."""
    return re.fullmatch(re.escape(at).replace(r"\[\*\]", r"\[\d+\]"), path) is not None
