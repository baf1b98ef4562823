"""The effects that a scene has and the effects that it lacks, with the reason for each."""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.effects.registry import LATERAL_FREEDOM
from riserstudy.model.absent_effects import missing
from riserstudy.model.build import build
from riserstudy.model.mesh import even
from riserstudy.scene.resolve import Resolved


class Row(NamedTuple):
    """One effect of the ledger."""

    name: str
    on: bool
    because: str
    missing: str  # inputs that an effect that is off requires


def ledger(scene: Resolved) -> list[Row]:
    """All effects; the effects that the scene has come first."""
    model = build(scene, even(scene, max(2, len(scene.riser))), ring_elevation=0.0)
    on = {effect.name: effect.because for effect in model.effects}
    if scene.lateral:
        on[LATERAL_FREEDOM] = scene.lateral
    rows = [Row(name, True, because, "") for name, because in on.items()]
    return rows + [Row(name, False, f"no {inputs}", inputs) for name, inputs in missing(set(on)).items()]
