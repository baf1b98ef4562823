"""A few representative points of a study: corners and middles of its axes, ends of sampled ranges."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice, product
from random import Random
from typing import Any

from riserstudy.study.axes import Numbers, Samples
from riserstudy.study.grid import Index
from riserstudy.study.study import Study

_NUMBER = re.compile(r"\s*([-+0-9.eE]+)\s")
TRIES = 50  # attempts per point, after which a small grid has no further point


def corners(study: Study, count: int, seed: int) -> list[Index]:
    """Points at corners and the middle of axes of numbers, and at all labels and ends of samples in turn.

    ``count``: largest number of points; the result has fewer if there are no more.
    """
    return list(dict.fromkeys(islice(_turns(study, seed), TRIES * count)))[:count]


def others(study: Study, without: list[Index], count: int, seed: int) -> list[Index]:
    """Random points of the grid with equal probability, except those in ``without``."""
    draw, found = Random(f"others {seed}"), dict.fromkeys(without)
    for _ in range(TRIES * count):
        if len(found) == len(without) + count:
            break
        found[tuple(draw.randrange(len(axis)) for axis in study.axes.values())] = None
    return list(found)[len(without) :]


def _turns(study: Study, seed: int) -> Iterator[Index]:
    """Endless marked points; each axis passes through all its marks in random order before repeating one."""
    draw = Random(f"corners {seed}")
    models = study.model.axes
    numbers = [name for name in study.axes if isinstance(models[name], Numbers)]
    lengths = [len(study.axes[name]) for name in numbers]
    boxes = [*product(*({0, n - 1} for n in lengths)), tuple(n // 2 for n in lengths)]
    joint = _shuffled(list(dict.fromkeys(boxes)), draw)
    rest = {name: _shuffled(_marks(study, name), draw) for name in study.axes if name not in numbers}
    while True:
        place = dict(zip(numbers, next(joint), strict=True))
        place |= {name: next(turn) for name, turn in rest.items()}
        yield tuple(place[name] for name in study.axes)


def _shuffled(marks: list[Any], draw: Random) -> Iterator[Any]:
    while True:
        draw.shuffle(marks)
        yield from marks


def _marks(study: Study, name: str) -> list[int]:
    """Indices of all labels; for samples, those with the least, the most or an option of an assumption."""
    axis = study.model.axes[name]
    if not isinstance(axis, Samples):
        return list(range(len(study.axes[name])))
    samples = study.assumed(axis)
    marks: dict[int, None] = {}
    for path in samples[0]:
        values = [_size(sample[path]) for sample in samples]
        if all(isinstance(value, float) for value in values):
            marks |= dict.fromkeys([values.index(min(values)), values.index(max(values))])
        else:
            marks |= dict.fromkeys(values.index(value) for value in dict.fromkeys(values))
    return list(marks)


def _size(value: Any) -> Any:
    """A number without its unit, which all samples share; else text."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(value)
    number = _NUMBER.match(f"{value} ") if isinstance(value, str) else None
    try:
        return float(number.group(1)) if number else str(value)
    except ValueError:
        return str(value)
