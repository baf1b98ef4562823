"""Peaks over all time steps of outputs with one value per time: angles, strokes, tensioner forces."""

from __future__ import annotations

import math
from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.model import Model
from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.records.seen import Peak
from riserstudy.simulation.smallest_sizes import smallest_size
from riserstudy.solve.record import Record

HALVED = 2.0  # room, as a multiple of the planned steps, since some steps may be halved
MOST = 20_000_000  # largest number of values of all steps: 160 MB


def room_for_steps(model: Model, duration: float, step: float) -> int:
    """Number of steps (s) over a duration (s) at which ends and devices are recorded; 0 if too many."""
    room = math.ceil(HALVED * duration / step) + 100
    state = model.s
    width = 2 * (len(state.dim) + 2 * len(state.moment) + 1) + len(state.dim) + 6 + len(state.probe)
    return room if room * width <= MOST else 0


def steps_of(record: Record) -> Record | None:
    """A record with its time steps in place of its outputs; None if not all steps were recorded."""
    count = int(record.steps[0])
    if not 0 < count <= len(record.step_time):
        return None
    return record._replace(
        time=record.step_time[:count],
        end=record.step_end[:count],
        top=record.step_top[:count],
        platform=record.step_platform[:count],
        probe=record.step_probe[:count],
    )


def peaks_of(times: FloatArray, series: Arrays, vectors: Arrays | None = None) -> dict[str, Peak]:
    """Peaks of series over the times of the steps (s), (steps,) or (steps, cylinders), by name.

    ``vectors``: vectors, (steps, 3), of the series that are their magnitudes, by name.
    """
    peaks = {name: _peak(times, values.reshape(len(times), -1)) for name, values in series.items()}
    for name, of in (vectors or {}).items():
        if name in peaks:
            least, time = smallest_size(times, of)
            peaks[name] = peaks[name]._replace(smallest=least, smallest_time=time)
    return peaks


def within(histories: Arrays, peaks: dict[str, Peak], sizes: Collection[str]) -> Arrays:
    """Histories at the outputs, limited to the peaks over all steps.

    ``sizes``: names of magnitudes, which may be nearer to zero between steps than at any step.
    """
    return {
        name: np.clip(histories[name], 0.0 if name in sizes else peak.smallest, peak.largest)
        for name, peak in peaks.items()
        if name in histories
    }


def _peak(times: FloatArray, values: FloatArray) -> Peak:
    """Peaks of columns, by the parabola through three steps about each extremum."""
    found: list[float] = []
    for sign in (1.0, -1.0):
        k, c = np.unravel_index(int((sign * values).argmax()), values.shape)
        best = [(float(values[k, c]), float(times[k])), _vertex(times, values, sign)]
        value, time = max(best, key=lambda one: sign * one[0])
        found += [value, time]
    if values.min() >= 0.0:  # a magnitude
        found[2] = max(found[2], 0.0)
    return Peak(*found)


def _vertex(times: FloatArray, values: FloatArray, sign: float) -> tuple[float, float]:
    """The highest vertex of all triples of steps about an extremum of a column, and its time.

    It is the first value if there is no extremum. At an event, there are two values at one time, and no
    parabola across it is used. Where a value drops suddenly after being constant, the parabola has a vertex
    that is too high by up to an eighth of the drop. The parabola through the vertex's two steps and the step
    before them limits it; a smooth peak has the same vertex by either, up to an error of third order in the
    step.
    """
    a, b, c = sign * values[:-2], sign * values[1:-1], sign * values[2:]
    intervals = np.diff(times)
    unbroken = (intervals[:-1] > 0.0) & (intervals[1:] > 0.0)
    step, column = np.nonzero((b >= a) & (b >= c) & ((b > a) | (b > c)) & unbroken[:, None])
    if not len(step):
        return float(values[0, 0]), float(times[0])
    place = step + 1
    a, b, c = (of[step, column] for of in (a, b, c))
    h, k = intervals[step], intervals[place]
    left, right = (b - a) / h, (c - b) / k
    bend = (right - left) / (h + k)
    slope = left + bend * h
    away = -0.5 * slope / bend  # time from the middle step to the vertex
    tops = b - 0.25 * slope**2 / bend
    tops = np.minimum(tops, _by_the_other_side(times, sign * values, (place, column), away, b))
    best = int(tops.argmax())
    return sign * float(tops[best]), float(times[place[best]] + away[best])


def _by_the_other_side(
    times: FloatArray,
    values: FloatArray,
    middle: tuple[NDArray[np.int64], NDArray[np.int64]],
    away: FloatArray,
    least: FloatArray,
) -> FloatArray:
    """Largest value allowed at the vertices: of the parabola through a vertex's two steps and the next one.

    ``middle``: step and column of the middle of each triple. ``away``: time from it to the vertex (s).
    ``least``: values at the middle steps, below which the limit does not fall. Infinite where there is no
    such step.
    """
    place, column = middle
    side = np.where(away < 0.0, -1, 1)
    near, far = place + side, place + 2 * side
    known = (far >= 0) & (far < len(times))
    far = np.where(known, far, near)
    to_near, to_far = times[near] - times[place], times[far] - times[place]
    known &= to_near != to_far  # there is no event between them
    apart = np.where(known, to_far - to_near, 1.0)
    slope = (values[near, column] - values[place, column]) / to_near
    beyond = (values[far, column] - values[near, column]) / apart
    bend = (beyond - slope) / np.where(known, to_far, 1.0)
    limit = values[place, column] + away * (slope + bend * (away - to_near))
    return np.where(known, np.maximum(limit, least), np.inf)
