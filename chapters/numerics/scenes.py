"""Which scenes a measured dataset is about; known before anything runs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from riserstudy.scene.load import SceneFile, read_scene

if TYPE_CHECKING:
    from chapters.numerics.models import Case, Family, Ladder, LimitCase, LongCase
    from riserstudy.study.study import Study

Scenes = Iterator[tuple[str, SceneFile]]
# parts of a scene that leave its kind as it is
_VALUES = {"title", "note", "paper", "output", "mesh", "step", "accuracy", "points", "profile"}
_WHERE = "config/studies/numerics.yaml: measured"


def in_tier(things: dict[str, Any], tier: str) -> dict[str, Any]:
    """The cases, methods or variants of a tier."""
    of = {name: x for name, x in things.items() if getattr(x, "only", None) in (None, tier)}
    return {name: x for name, x in of.items() if tier != "preview" or x.preview}


def case_file(
    config: Path, name: str, case: Case | LimitCase | Ladder | Family | LongCase
) -> SceneFile:
    """The scene of a case."""
    return read_scene(config / case.scene, keep=True).with_values(case.set, f"{_WHERE}: {name}.set")


def bases(studies: Sequence[Study], tier: str) -> Scenes:
    """The scenes that studies vary, each kind once: a kind is what is in a scene, whatever its values.

    First those of the studies, then what their named options make of them. In preview a scene file stands
    for all that studies set on it, the first with motion before statics, and for their options.
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
    """A study's scene with each named option of each axis in turn."""
    for name, axis in study.model.axes.items():
        if axis == "readings" or isinstance(axis, dict):
            for label, sets in study.axes[name]:
                yield label, study.base.with_values(sets, study.where)


def places(tree: Any, path: str = "") -> Iterator[str]:
    """Every path of a scene at which something stands, what leaves its kind as it is apart."""
    if isinstance(tree, list):
        tree = {f"[{k}]": part for k, part in enumerate(tree)}
    if not isinstance(tree, dict):
        yield path
        return
    for name, part in tree.items():
        if name not in _VALUES:
            yield from places(part, f"{path}.{name}")
