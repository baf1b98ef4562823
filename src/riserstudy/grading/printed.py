"""Published values of a paper: inputs of scenes, and numbers for figures and derived datasets.

A value of a scene without a stated origin counts as published, and must be in the list of its paper.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from riserstudy.errors import InputError
from riserstudy.grading.models import PrintedInput, PublishedFile
from riserstudy.grading.published import printed_of, published_path
from riserstudy.grading.words_of_size_file import read_words
from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.load import SceneFile
from riserstudy.scene.origin import plain_values
from riserstudy.scene.paths import matches


def printed_inputs(config: Path, paper: str) -> list[PrintedInput]:
    """Inputs that the file of a paper lists; empty without a file or list.

    Raises InputError when the file is invalid.
    """
    return printed_of(config, paper).inputs if published_path(config, paper).exists() else []


def with_printed(
    settings: dict[str, Any], config: Path, paper: str, file: PublishedFile | None = None
) -> dict[str, Any]:
    """Arguments of a figure or derived dataset, with ``{printed: N1}`` replaced by the published value.

    ``{word: smaller}`` is replaced by the bound of this word.

    ``file``: the paper's published file, if it has been read. Raises InputError when the paper has no such
    value, or the table no such word.
    """
    if any(_names(value, "word") for value in settings.values()):
        words = read_words(config)
        settings = {
            name: words.word(value["word"]).bound if _names(value, "word") else value
            for name, value in settings.items()
        }
    if not any(_names(value, "printed") for value in settings.values()):
        return settings
    file = file or printed_of(config, paper)
    try:
        return {
            name: file.number(value["printed"]) if _names(value, "printed") else value
            for name, value in settings.items()
        }
    except Misfit as fault:
        where = config / "studies" / f"{paper}.yaml"
        raise InputError(where, "with", fault.found, fault.allowed) from None


def _names(value: Any, what: str) -> bool:
    return isinstance(value, dict) and list(value) == [what]


def printed_as(inputs: Iterable[PrintedInput], path: str, value: Any) -> PrintedInput | None:
    """The published input to which a scene's value at a dotted path belongs, if there is one."""
    for printed in inputs:
        if str(printed.value) == str(value) and any(matches(path, at) for at in printed.paths):
            return printed
    return None


def unprinted(inputs: list[PrintedInput], scene: SceneFile) -> list[tuple[str, Any]]:
    """Values of a scene without an origin, by dotted path, that are not in the list of its paper."""
    return [
        (path, value)
        for path, value in plain_values(scene.tree, scene.origins)
        if printed_as(inputs, path, value) is None
    ]
