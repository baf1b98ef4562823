"""What a march adds up, and how it ends."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.jit import inner

DONE, NOT_CONVERGED = 0, 1


class Ledger(NamedTuple):
    """What a run adds up."""

    work: np.ndarray  # (5,) J: by supports, by water and devices, dissipated, numerical, exchanged
    count: np.ndarray  # (4,) steps, Newton iterations, halved steps, explicit evaluations
    failure: np.ndarray  # (3,) time (s), node, size of its last correction (m)


def new_ledger() -> Ledger:
    """All zero."""
    return Ledger(np.zeros(5), np.zeros(4, np.int64), np.zeros(3))


@inner
def enter(ledger, held, given, lost, numerical):
    """Enter one step: work of supports, of water and devices, dissipated by physics and by the method."""
    ledger.work[0] += held
    ledger.work[1] += given
    ledger.work[2] += lost
    ledger.work[3] += numerical
    ledger.work[4] += abs(held) + abs(given) + abs(lost)
    ledger.count[0] += 1
