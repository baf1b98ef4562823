"""A scene at rest: platform in calm water and full current, however the run itself begins."""

from __future__ import annotations

from collections.abc import Sequence

from riserstudy.scene.forcing import TILTS, TRANSLATIONS
from riserstudy.scene.resolve import Resolved

NEAR = 1e-9  # m and rad


def at_rest(scene: Resolved) -> Resolved:
    """The scene with its platform in its position in calm water, and with its full current.

    A run itself can begin in another state: a motion without a ramp may start displaced, and a current with
    a ramp starts from zero.
    """
    scene = unmoved(scene)
    if scene.current is None:
        return scene
    return scene.replaced(current=scene.current.replaced(ramp=None))


def unmoved(scene: Resolved) -> Resolved:
    """The scene with its platform where it is in calm water."""
    if scene.platform is None:
        return scene
    none = dict.fromkeys((*TRANSLATIONS, *TILTS, "cruise", "response"))
    return scene.replaced(platform=scene.platform.replaced(**none))


def moves_at(place: Sequence[float], scene: Resolved) -> bool:
    """Whether motions displace the platform (m, rad: surge to yaw) from its place in calm water."""
    if scene.platform is None:
        return False
    rest = scene.platform.position
    of = [getattr(rest, name, None) or 0.0 for name in (*TRANSLATIONS, *TILTS)]
    return any(abs(a - b) > NEAR for a, b in zip(place, of, strict=True))


def static(scene: Resolved) -> Resolved:
    """The scene at rest, without a time history and what is computed from one; mesh and accuracy stay."""
    none = dict.fromkeys(("duration", "output", "step", "start", "method"))
    analysis = scene.analysis.replaced(**none)
    return at_rest(scene).replaced(analysis=analysis, fatigue=None)
