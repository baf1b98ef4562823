"""Peaks over all time steps of outputs with one value per time: angles, strokes, tensioner forces."""

from __future__ import annotations

import math
from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.model import Model
from riserstudy.records.seen import Peak
from riserstudy.solve.record import Record

FloatArray = NDArray[np.float64]
Arrays = dict[str, FloatArray]
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


def peaks_of(times: FloatArray, series: Arrays) -> dict[str, Peak]:
    """Peaks of series over the times of the steps (s), (steps,) or (steps, cylinders), by name."""
    return {name: _peak(times, values.reshape(len(times), -1)) for name, values in series.items()}


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
        best = [(float(values[k, c]), float(times[k]))]
        best += [_vertex(times, values[:, column], sign) for column in range(values.shape[1])]
        value, time = max(best, key=lambda one: sign * one[0])
        found += [value, time]
    if values.min() >= 0.0:  # a magnitude
        found[2] = max(found[2], 0.0)
    return Peak(*found)


def _vertex(times: FloatArray, values: FloatArray, sign: float) -> tuple[float, float]:
    """The highest vertex of all triples of steps about an extremum, and its time; else the first value.

    At an event, there are two values at one time, and no parabola across it is used.
    """
    a, b, c = sign * values[:-2], sign * values[1:-1], sign * values[2:]
    h, k = np.diff(times)[:-1], np.diff(times)[1:]
    turning = (b >= a) & (b >= c) & ((b > a) | (b > c)) & (h > 0.0) & (k > 0.0)
    if not turning.any():
        return float(values[0]), float(times[0])
    a, b, c, h, k = (of[turning] for of in (a, b, c, h, k))
    left, right = (b - a) / h, (c - b) / k
    bend = (right - left) / (h + k)
    slope = left + bend * h
    tops = b - 0.25 * slope**2 / bend
    best = int(tops.argmax())
    middle = times[1:-1][turning][best]
    return sign * float(tops[best]), float(middle - 0.5 * slope[best] / bend[best])
