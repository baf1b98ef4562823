"""Samples of unspecified inputs of a paper, over the ranges and options of the assumptions."""

from __future__ import annotations

import re
from importlib.metadata import version
from typing import Any

from riserstudy.errors import InputError
from riserstudy.files.cache import remembered
from riserstudy.scene.origin import Origin

_PARTS = re.compile(r"\s*([-+0-9.eE]+)\s*(.*)")


def sample(assumptions: dict[str, Origin], count: int, seed: int) -> list[dict[str, Any]]:
    """Overrides for ``count`` scrambled Sobol points over all assumptions together.

    A range is sampled uniformly, and options with equal probability. Raises InputError when there is no
    assumption to vary, or the ends of a range have different units.
    """
    if not assumptions:
        found = "samples require a scene with assumptions that have a range or options"
        raise InputError("study", "axes", found, "remove the axis of samples, or add ranges to the scene")
    return [
        {
            path: value_at(path, origin, x)
            for (path, origin), x in zip(assumptions.items(), point, strict=True)
        }
        for point in sobol(len(assumptions), count, seed)
    ]


def sobol(dimensions: int, count: int, seed: int) -> list[list[float]]:
    """``count`` scrambled Sobol points in the unit cube of ``dimensions`` dimensions.

    They are cached, because scipy.stats needs 0.6 s to start, longer than planning.
    """

    def draw() -> list[list[float]]:
        from scipy.stats import qmc

        sampler = qmc.Sobol(dimensions, rng=seed)
        points = sampler.random_base2(max(1, (count - 1).bit_length()))[:count]
        return [[float(x) for x in point] for point in points]

    points: list[list[float]] = remembered(
        f"samples/sobol-{version('scipy')}-{dimensions}-{count}-{seed}", draw
    )
    return points


def value_at(path: str, origin: Origin, x: float) -> Any:
    """Value of an assumption, with its unit, at position 0 <= x < 1 of its range or options.

    Raises InputError when the ends of the range have different units.
    """
    if origin.options:
        return origin.options[min(int(x * len(origin.options)), len(origin.options) - 1)]
    low, high = origin.range or (None, None)
    if isinstance(low, int | float) and isinstance(high, int | float):
        return low + x * (high - low)
    parts = _PARTS.fullmatch(str(low)), _PARTS.fullmatch(str(high))
    if not parts[0] or not parts[1] or parts[0].group(2) != parts[1].group(2):
        found = f"[{low}, {high}] are not two numbers in one unit"
        raise InputError("scene", f"{path}.range", found, "give two values in the same unit")
    a, b = float(parts[0].group(1)), float(parts[1].group(1))
    return f"{a + x * (b - a)!r} {parts[0].group(2)}"
