"""Which scenes a measured dataset is about; known before anything runs."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from riserstudy.numerics.models import Case, EffectsStudy, LimitCase, LimitStudy, StabilityStudy
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.store import canonical

if TYPE_CHECKING:
    from riserstudy.study import Study

Scenes = Iterator[tuple[str, SceneFile]]
_WHERE = "config/studies/numerics.yaml: measured"


def scenes_of(
    study: StabilityStudy | LimitStudy | EffectsStudy,
    config: Path,
    tier: str,
    others: list[Study],
) -> Scenes:
    """Name and scene of every case of a tier.

    Raises
    ------
    InputError
        When a scene cannot be meant.
    """
    if isinstance(study, EffectsStudy):
        yield from bases(others)
        return
    cases = study.cases if isinstance(study, StabilityStudy) else study.variants
    for name, case in in_tier(cases, tier).items():
        yield name, case_file(config, name, case)


def in_tier(things: dict[str, Any], tier: str) -> dict[str, Any]:
    """The cases, methods or variants of a tier."""
    return {name: x for name, x in things.items() if tier != "preview" or x.preview}


def case_file(config: Path, name: str, case: Case | LimitCase) -> SceneFile:
    """The scene of a case."""
    return read_scene(config / case.scene).with_values(case.set, f"{_WHERE}: {name}.set")


def bases(studies: list[Study]) -> Scenes:
    """The scenes that studies vary, each once, with what the first study that has it sets."""
    seen = set()
    for study in studies:
        alone = str(canonical(study.base.tree))
        if study.model.scene not in seen and alone not in seen:
            seen |= {study.model.scene, alone}
            yield f"{study.paper}/{Path(study.model.scene).stem}", study.base
