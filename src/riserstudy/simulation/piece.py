"""The first piece of a run, from which properties of the whole run are estimated."""

from __future__ import annotations

from typing import Any

from riserstudy.scene.resolve import Resolved


def piece_of(scene: Resolved, piece: float) -> Resolved:
    """The scene with only the first piece of its run, of a duration (s)."""
    a = scene.analysis
    if a.output is None:
        raise TypeError("a scene without time")  # excluded by the caller
    output = a.output.replaced(start=None, interval=min(a.output.interval, piece))
    return scene.replaced(analysis=a.replaced(duration=piece, output=output))


def longest_ramp(scene: Resolved) -> float:
    """Longest ramp of the motions and waves of a scene (s)."""
    platform = scene.platform
    growing: list[Any] = [scene.wave, *(motion for _, motion in (platform.harmonics if platform else []))]
    growing += [platform.response, platform.cruise] if platform else []
    return max(((one.ramp or 0.0) for one in growing if one), default=0.0)
