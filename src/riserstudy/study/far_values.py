"""Values of an axis that are far from the scene's value, typically by an error of unit."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from riserstudy.scene.fields import in_si
from riserstudy.scene.paths import value_at
from riserstudy.study.axes import Numbers
from riserstudy.study.study import Study

# ratio to the nearest other value, of the axis or the scene, from which on a value is far
FAR = 100.0
ROUNDING = 1e-9  # relative difference of the same ratio in different units


def far_values(study: Study) -> list[str]:
    """A warning for each axis of numbers with values 100 times the scene's value, or a hundredth of it.

    There is no warning if the axis reaches such values by smaller steps, or contains the scene's value: it is
    then intended. Numbers without a unit, such as counts and seeds, and paths without a value or with zero in
    the scene, are not checked.
    """
    return [
        f"{study.where}: axes.{name}: {text}; check the unit"
        for name, axis in study.model.axes.items()
        if isinstance(axis, Numbers)
        for text in _far(study, axis)
    ]


def _far(study: Study, axis: Numbers) -> Iterator[str]:
    """A warning about the value of an axis farthest from the scene's value at a path, if it is far."""
    for path in axis.paths:
        there = value_at(study.base.tree, path)
        scene, unit = in_si(path, there)
        if not scene or unit in (None, "1"):
            continue
        written = [axis.overrides(number)[path] for number in axis.numbers(study.tier)]
        values = {text: abs(in_si(path, text)[0] or 0.0) / abs(scene) for text in written}
        ratios = {text: ratio for text, ratio in values.items() if ratio}
        own = any(math.isclose(ratio, 1.0) for ratio in ratios.values())
        leaps = pairwise(sorted([1.0, *ratios.values()]))
        if not own and any(high >= FAR * (1.0 - ROUNDING) * low for low, high in leaps):
            worst = max(ratios, key=lambda text: abs(math.log(ratios[text])))
            times = float(f"{ratios[worst]:.3g}")
            yield f"{worst} is {times:g} times the scene's {there} at {path}"
