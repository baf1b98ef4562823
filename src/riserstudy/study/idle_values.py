"""Axes, values and outputs to keep that have no effect on a study, typically by an error of name."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from riserstudy.dataset.variables import quantity_of
from riserstudy.scene.origin import unwrap
from riserstudy.scene.paths import within_any
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.study.study import Study, set_by_all
from riserstudy.study.study_model import SETTINGS


def idle_values(study: Study) -> list[str]:
    """A warning for each axis without effect, each value that an axis replaces, and each absent output.

    Axes of limits change no run, but verdicts; they get no warning. Outputs are compared with the scenes at
    the first point and at the points that differ from it on one axis.
    """
    return [*_idle_axes(study), *_replaced(study), *_absent_outputs(study)]


def _idle_axes(study: Study) -> Iterator[str]:
    shape = [len(axis) for axis in study.grid.axes]
    keys = np.array([point.key.encode() for point in study.plan]).reshape(shape)
    for place, (name, steps) in enumerate(study.axes.items()):
        limits = any(path.startswith("limits") for _, sets in steps for path in sets)
        idle = bool((keys == keys.take([0], axis=place)).all())
        if idle and shape[place] > 1 and not limits:
            yield f"{study.where}: axes.{name}: its values change no run; check its paths and labels"


def _replaced(study: Study) -> Iterator[str]:
    """A warning for each value in ``set`` that no point has, because all values of an axis replace it.

    Values with a stated origin get no warning, since the origin describes the value. Nor do mesh, step and
    tolerance: without them, the base scene would have the tolerance of the tier.
    """
    for path, value in study.model.set.items():
        if within_any(path, SETTINGS) or unwrap(value)[1]:
            continue
        for name, steps in study.axes.items():
            if set_by_all(steps, path):
                yield f"{study.where}: set.{path}: every value of axis {name!r} replaces it; leave it out"


def _absent_outputs(study: Study) -> Iterator[str]:
    """A warning for each output to keep that the runs do not return."""
    left = dict.fromkeys(study.model.keep or [], "")
    for index in study.grid.near_first([range(len(axis)) for axis in study.grid.axes]):
        if not left:
            return
        scene = study.grid.file(index).resolved()
        lacks = {name: QUANTITIES[quantity_of(name)].lacks(scene) for name in left}
        left = {name: lack for name, lack in lacks.items() if lack}
    for name, lack in left.items():
        yield f"{study.where}: keep: no run has {name!r}, which needs {lack}"
