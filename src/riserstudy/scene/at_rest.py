"""A scene at rest: platform in calm water and full current, however the run itself begins."""

from __future__ import annotations

from typing import Any

from riserstudy.scene.forcing import TILTS, TRANSLATIONS
from riserstudy.scene.resolve import Resolved


def at_rest(scene: Resolved) -> Resolved:
    """The scene with its platform in its position in calm water, and with its full current.

    A run itself can begin in another state: a motion without a ramp may start displaced, and a current with
    a ramp starts from zero.
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
