"""A small riser for each effect: uneven, bent, stretched, moving, in a sheared current."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from riserstudy.effects.bending import Bending
from riserstudy.effects.bending_in_space import SpatialBending
from riserstudy.effects.current import Current
from riserstudy.effects.cylinder import Upright
from riserstudy.effects.wave import STRETCHED, Wave
from riserstudy.solve.state import OTHER, OWN, State

L0 = np.array([12.0, 9.0, 15.0, 11.0, 8.0, 14.0])
N = len(L0)
SEGMENTS = np.linspace(1.0, 1.5, N)  # what makes the segments differ
CYLINDERS = 2
PROBES = "abcd"  # beside those of the cylinders
TOP = 60.0  # elevation of the ring at mid-stroke (m)


class Case(NamedTuple):
    """One effect and what must stand beside it to act."""

    record: Callable[[int], Any]  # by number of directions
    beside: Callable[[int], list[Any]] = lambda d: []
    directions: tuple[int, ...] = (1, 2, 3)
    loose: int = 0  # nodes beyond the riser's
    internal: int = 0  # internal variables a node


def pipe(d: int) -> Bending | SpatialBending:
    flexibility = L0 / (2.7e8 * SEGMENTS)
    flex = np.zeros(N + 1)
    flex[:-1] += OWN * flexibility
    flex[1:] += OWN * flexibility
    return (Bending if d == 2 else SpatialBending)(flex, OTHER * flexibility)


def sheared(d: int) -> Current:
    heading = np.array([1.0] if d == 2 else [0.6, 0.8][: d - 1])
    elevation, speed = np.array([[-50.0, 20.0, 41.0, 75.0], [0.3, 1.0, 0.5, 1.7]])
    return Current(elevation, speed, heading, np.zeros(N + 1, np.int64), 8.0)


def uniform(d: int) -> Current:
    heading = np.array([1.0, 0.0][: d - 1])
    near = np.zeros(N + 1, np.int64)
    return Current(np.array([0.0, 1.0]), np.array([0.7, 0.7]), heading, near, 0.0)


def sea(d: int, above: int = STRETCHED) -> Wave:
    heading = np.array([0.6, 0.8][: d - 1])
    return Wave(
        np.array([1.5, 2.0]), np.array([0.8, 0.5]), np.array([0.07, 0.03]), np.array([0.3, -1.0]),
        heading, 45.0, 60.0, 9.0, above, np.zeros((3, 2)),
    )  # fmt: skip


def cylinders(d: int) -> Upright:
    return Upright(N, TOP + np.array([0.0, 0.5]), np.array([7.0, -4.0, 2.0]), np.zeros((3, 3)))


def pair(a: float, b: float) -> np.ndarray:
    return np.array([a, b])


def stirred(*shape: int) -> np.ndarray:
    return np.random.default_rng(4).normal(size=shape)


MOMENTS = {1: 0, 2: 1, 3: 3}  # by directions, as in risers that bend, whose kernels are compiled


def flexibility(s: State) -> np.ndarray:
    return np.diag(s.flex) + np.diag(s.flex_up, 1) + np.diag(s.flex_up, -1)


def nodes(segment: np.ndarray) -> np.ndarray:
    """What segments do to their nodes: plus at the lower, minus at the upper."""
    out = np.zeros((segment.shape[0], segment.shape[1] + 1))
    out[:, :-1] += segment
    out[:, 1:] -= segment
    return out
