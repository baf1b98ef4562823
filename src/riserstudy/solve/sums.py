"""Sums over a simulation, such as work and counts, and the reason why it ended."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.solve.jit import inner

DONE, NOT_CONVERGED, STOPPED = 0, 1, 2
# entries of `work`: by supports, by water and devices, dissipated, numerically dissipated, exchanged in all
HELD, GIVEN, LOST, NUMERICAL, EXCHANGED = 0, 1, 2, 3, 4
STEPS, ITERATIONS, HALVED, EVALUATIONS = 0, 1, 2, 3  # entries of `count`


class Sums(NamedTuple):
    """Sums over a run."""

    work: np.ndarray  # (5,) J
    count: np.ndarray  # (4,) steps, Newton iterations, halved steps, evaluations of explicit stepping
    failure: np.ndarray  # (3,) time (s), node, size of its last correction (m)
    stop: np.ndarray  # (1,) not 0 to interrupt the march; another thread may set it


def new_sums() -> Sums:
    """Sums that are all zero."""
    return Sums(np.zeros(5), np.zeros(4, np.int64), np.zeros(3), np.zeros(1, np.int64))


@inner
def enter(sums, held, given, lost, numerical):
    """Add one step: work of supports, of water and devices, physical and numerical dissipation."""
    sums.work[HELD] += held
    sums.work[GIVEN] += given
    sums.work[LOST] += lost
    sums.work[NUMERICAL] += numerical
    sums.work[EXCHANGED] += abs(held) + abs(given) + abs(lost)
    sums.count[STEPS] += 1


@inner
def fail(sums, time, node, size):
    """Record time and node of a failed step, and the size of its last correction."""
    sums.failure[0], sums.failure[1], sums.failure[2] = time, node, size
