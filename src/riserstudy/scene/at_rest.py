"""A scene at rest: what it is before anything moves, whatever its run begins with."""

from __future__ import annotations

from typing import Any

from riserstudy.scene.forcing import TILTS, TRANSLATIONS
from riserstudy.scene.resolve import Resolved


def at_rest(scene: Resolved) -> Resolved:
    """The scene with its platform where it is in calm water, and with the whole of its current.

    A run begins wherever a motion without a ramp is at its start, and before a current with a ramp flows.
    """
    changed: dict[str, Any] = {}
    if scene.platform:
        none = dict.fromkeys((*TRANSLATIONS, *TILTS, "cruise", "response"))
        changed["platform"] = scene.platform.model_copy(update=none)
    if scene.current:
        changed["current"] = scene.current.model_copy(update={"ramp": None})
    return scene.model_copy(update=changed)


def static(scene: Resolved) -> Resolved:
    """The scene at rest, without a time history and what is computed from one; mesh and accuracy stay."""
    none = dict.fromkeys(("duration", "output", "step", "start", "method"))
    analysis = scene.analysis.model_copy(update=none)
    return at_rest(scene).model_copy(update={"analysis": analysis, "fatigue": None})
