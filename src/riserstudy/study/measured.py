"""Datasets that a chapter measures by its code, instead of simulating a grid.

An entry below ``measured`` in a study file is checked by a model of the chapter. The chapter's module
``models`` has a mapping ``MODELS`` of models by name of the dataset. Its module ``measured`` has a function
with this name, which takes the model and a ``Setting`` and returns the dataset.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from riserstudy.errors import InputError
from riserstudy.files.chapters import chapter_modules, import_of_chapter
from riserstudy.files.digests import defining
from riserstudy.inputs.strict import Strict
from riserstudy.inputs.validate import check
from riserstudy.study.axes import Tier

if TYPE_CHECKING:
    from riserstudy.scene.load import SceneFile
    from riserstudy.study.study import Study


class Setting(NamedTuple):
    """Inputs of a measurement; ``compiled`` is the marker file that states the compile times."""

    config: Path
    tier: Tier
    threads: int = 1
    studies: Sequence[Study] = ()  # studies of all papers
    compiled: Path = Path()


class MeasuredModel(Strict):
    """A dataset that a chapter measures: its caption, and the fields that its model adds.

    ``timed``: it measures times, so no other job may run at the same time.
    """

    timed: ClassVar[bool] = False

    caption: str

    def scene_files(self, setting: Setting) -> Iterable[tuple[str, SceneFile]]:
        """Name and scene of each case; a change of one repeats the measurement. By default none."""
        del setting
        return ()

    def data_files(self, setting: Setting) -> Iterable[Path]:
        """Further files that are read; a change of one repeats the measurement. By default none."""
        del setting
        return ()


def models_of(paper: str) -> dict[str, type[MeasuredModel]]:
    """Models of the datasets that a chapter measures, by name; empty if it has no module ``models``."""
    models: dict[str, type[MeasuredModel]] = {}
    for module in chapter_modules(paper, "models"):
        models |= import_of_chapter(module).MODELS
    return models


def measured_models(path: Path, paper: str, trees: dict[str, Any]) -> dict[str, MeasuredModel]:
    """The entries below ``measured`` in the study file ``path``, checked by the models of its chapter.

    Raises InputError when the chapter lacks the model or the function, or an entry is invalid.
    """
    models = models_of(paper) if trees else {}
    measured = {}
    for name, tree in trees.items():
        field = f"measured.{name}"
        if name not in models:
            found = f"MODELS in chapters/{paper}/models.py has no {name!r}"
            allowed = f"use one of {', '.join(models)}" if models else "add it there, or remove it here"
            raise InputError(path, field, found, allowed)
        if defining(chapter_modules(paper, "measured"), name) is None:
            found = f"chapters/{paper}/measured.py defines no function {name}"
            raise InputError(path, field, found, "define the function, or remove this entry")
        measured[name] = check(models[name], tree, path, field)
    return measured
