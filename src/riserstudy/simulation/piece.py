"""The first piece of a run, which tells of the whole."""

from __future__ import annotations

from typing import Any

from riserstudy.scene.resolve import Resolved


def piece_of(scene: Resolved, piece: float) -> Resolved:
    """The first piece of a run (s)."""
    a = scene.analysis
    if a.output is None:
        raise TypeError("a scene without time")  # asked before
    output = a.output.model_copy(update={"start": None, "interval": min(a.output.interval, piece)})
    first = a.model_copy(update={"duration": piece, "output": output})
    return scene.model_copy(update={"analysis": first})


def longest_ramp(scene: Resolved) -> float:
    """Time over which the motions and waves of a scene grow (s)."""
    platform = scene.platform
    growing: list[Any] = [
        scene.wave,
        *(motion for _, motion in (platform.harmonics if platform else [])),
    ]
    growing += [platform.response, platform.cruise] if platform else []
    return max(((one.ramp or 0.0) for one in growing if one), default=0.0)
