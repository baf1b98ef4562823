"""The scenes that studies vary, one of each kind."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from riserstudy.scene.load import SceneFile
    from riserstudy.study.study import Study

Scenes = Iterator[tuple[str, "SceneFile"]]
# parts of a scene that do not change its kind
_VALUES = {"title", "note", "paper", "output", "mesh", "step", "accuracy", "points", "profile"}


def bases(studies: Sequence[Study], tier: str) -> Scenes:
    """Yield the scenes that studies vary, one of each kind: a kind is the set of keys, whatever the values.

    Base scenes have priority over scenes with a named option of an axis. In preview, one scene represents
    all studies with its scene file and their options: the first with motion, or else the first static one.
    """
    ordered = sorted(studies, key=lambda study: "duration" not in study.base.tree["analysis"])
    scenes: dict[str, tuple[str, SceneFile]] = {}
    for study in ordered:
        kind = study.model.scene if tier == "preview" else ",".join(places(study.base.tree))
        scenes.setdefault(kind, (f"{study.paper}/{study.name}", study.base))
    for study in ordered if tier != "preview" else []:
        for label, file in _options(study):
            kind = ",".join(places(file.tree))
            scenes.setdefault(kind, (f"{study.paper}/{study.name}: {label}", file))
    yield from sorted(scenes.values(), key=lambda one: one[0].split("/")[0])


def _options(study: Study) -> Scenes:
    """Yield the study's scene with one named option of one axis at a time."""
    for name, axis in study.model.axes.items():
        if axis == "readings" or isinstance(axis, dict):
            for label, sets in study.axes[name]:
                yield label, study.base.with_values(sets, study.where)


def places(tree: Any, path: str = "") -> Iterator[str]:
    """Yield every path of a scene that has a value, without the parts that do not change its kind."""
    if isinstance(tree, list):
        tree = {f"[{k}]": part for k, part in enumerate(tree)}
    if not isinstance(tree, dict):
        yield path
        return
    for name, part in tree.items():
        if name not in _VALUES:
            yield from places(part, f"{path}.{name}")
