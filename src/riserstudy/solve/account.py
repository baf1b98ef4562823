"""What a march adds up, and how it ends."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.solve.jit import inner

DONE, NOT_CONVERGED = 0, 1


class Account(NamedTuple):
    """What a run adds up."""

    work: np.ndarray  # (5,) J: by supports, by water and devices, dissipated, numerical, exchanged
    count: np.ndarray  # (4,) steps, Newton iterations, halved steps, explicit evaluations
    failure: np.ndarray  # (3,) time (s), node, size of its last correction (m)


def new_account() -> Account:
    """All zero."""
    return Account(np.zeros(5), np.zeros(4, np.int64), np.zeros(3))


@inner
def enter(account, held, given, lost, numerical):
    """Enter one step: work of supports, of water and devices, dissipated by physics and by the method."""
    account.work[0] += held
    account.work[1] += given
    account.work[2] += lost
    account.work[3] += numerical
    account.work[4] += abs(held) + abs(given) + abs(lost)
    account.count[0] += 1
