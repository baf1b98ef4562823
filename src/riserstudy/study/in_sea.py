"""A scene in other irregular seas, with other phases."""

from __future__ import annotations

from typing import Any, NamedTuple

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sea import Storm


class Sea(NamedTuple):
    """An irregular sea."""

    height: float  # significant wave height (m)
    period: float  # peak period (s)


def in_sea(file: SceneFile, sea: Sea, seed: int) -> SceneFile:
    """The scene in another sea, with other phases.

    Raises InputError when the scene has no irregular sea, or no time.
    """
    return file.with_values(values_of(file, sea) | phases_of(file, seed), "sea")


def values_of(file: SceneFile, sea: Sea) -> dict[str, Any]:
    """Values that put a scene into another sea, by path of the scene.

    Raises InputError when the scene has no irregular sea, or no time.
    """
    values: dict[str, Any] = {}
    for path in _paths(file):
        values[f"{path}.significant_height"] = f"{sea.height!r} m"
        values[f"{path}.peak_period"] = f"{sea.period!r} s"
    return values


def phases_of(file: SceneFile, seed: int) -> dict[str, Any]:
    """Values that give the sea of a scene other phases, by path of the scene.

    Raises InputError when the scene has no irregular sea, or no time.
    """
    return {f"{path}.seed": seed for path in _paths(file)}


def one_sea(scene: Resolved) -> str:
    """A statement that a run has one of many possible irregular seas; empty without such a sea."""
    seas = scene.irregular_waves.values()
    if scene.analysis.duration is None or not seas:
        return ""
    seeds = " and ".join(str(seed) for seed in dict.fromkeys(sea.seed for sea in seas))
    run = f"{scene.analysis.duration:g} s with seed {seeds}"
    return f"one irregular sea, of {run}; other seeds and longer seas have other extremes"


def exposure(scene: Resolved) -> float:
    """Duration of a run after its ramps and the start of its outputs (s), in which extremes count."""
    output = scene.analysis.output
    start = (output.start if output else None) or 0.0
    return float(scene.analysis.duration or 0.0) - max(scene.built_up, start)


def heading_paths(file: SceneFile) -> list[str]:
    """Paths of the headings of a scene's irregular sea.

    Operators without headings have none: the platform's response is that to waves from any side. Raises
    InputError when there is no irregular sea, or the scene has no time.
    """
    platform = file.resolved().platform
    turns = platform is not None and platform.response is not None and platform.response.headings
    paths = {"platform.response.wave": "platform.response.heading", "wave": "wave.heading"}
    return [paths[path] for path in _paths(file) if turns or path == "wave"]


def heading_values(file: SceneFile, sectors: int) -> list[dict[str, Any]]:
    """Values that set the heading of a scene's sea to the middle of each sector, the first along x.

    Raises InputError when the scene has no irregular sea, or no time.
    """
    headings = [f"{k * 360.0 / sectors:.10g} deg" for k in range(sectors)]
    return [dict.fromkeys(heading_paths(file), heading) for heading in headings]


def sea_of(file: SceneFile) -> Storm:
    """The irregular sea of a scene; the platform's sea, if it has one.

    Raises InputError when there is none, or the scene has no time.
    """
    return next(iter(_seas(file).values()))


def _paths(file: SceneFile) -> list[str]:
    return list(_seas(file))


def _seas(file: SceneFile) -> dict[str, Storm]:
    """Irregular seas of a scene, by path. Raises InputError when there is none, or the scene is static."""
    scene = file.resolved()
    seas = scene.irregular_waves
    if not seas:
        allowed = "give `platform.response.wave` or `wave` with significant_height and peak_period"
        raise InputError(file.source, "wave", "the scene has no irregular sea", allowed)
    if scene.analysis.duration is None:
        allowed = "add the duration of each run in a sea, such as `1 h`"
        raise InputError(file.source, "analysis.duration", "missing", allowed)
    return seas
