"""Values of an axis that are far from the scene's: what a slip of a unit makes, and a few studies mean."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from riserstudy.scene.fields import in_si
from riserstudy.scene.paths import value_at
from riserstudy.study.axes import Numbers
from riserstudy.study.study import Study

FAR = 100.0  # times the next value of the axis, the scene's among them
ROUNDING = 1e-9  # by which the same ratio comes out otherwise in another unit


def far_values(study: Study) -> list[str]:
    """A warning for each axis of numbers with values a hundred times the scene's, or a hundredth.

    An axis that leads there by smaller steps, or has the scene's own value, is meant so. Numbers without a
    unit, such as counts and seeds, and paths where the scene has no value or zero, are left alone.
    """
    return [
        f"{study.where}: axes.{name}: {text}; check the unit"
        for name, axis in study.model.axes.items()
        if isinstance(axis, Numbers)
        for text in _far(study, axis)
    ]


def _far(study: Study, axis: Numbers) -> Iterator[str]:
    """The value of an axis that is farthest from the scene's at a path, where it leaps there."""
    for path in axis.paths:
        there = value_at(study.base.tree, path)
        scene, unit = in_si(path, there)
        if not scene or unit in (None, "1"):
            continue
        written = [axis.overrides(number)[path] for number in axis.numbers(study.tier)]
        values = {text: abs(in_si(path, text)[0] or 0.0) / abs(scene) for text in written}
        ratios = {text: ratio for text, ratio in values.items() if ratio}
        own = any(math.isclose(ratio, 1.0) for ratio in ratios.values())
        if not own and _leaps([1.0, *ratios.values()]):
            worst = max(ratios, key=lambda text: abs(math.log(ratios[text])))
            times = float(f"{ratios[worst]:.3g}")
            yield f"{worst} is {times:g} times the scene's {there} at {path}"


def _leaps(values: list[float]) -> bool:
    """Whether one of some positive values is far from the next."""
    return any(b >= FAR * (1.0 - ROUNDING) * a for a, b in pairwise(sorted(values)))
