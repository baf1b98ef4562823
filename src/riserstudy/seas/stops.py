"""Rows of a record in operation: operations that stopped resume only under stricter limits on the sea."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Flags = NDArray[np.bool_]


def in_operation(met: Flags, resuming: Flags, joined: Flags) -> Flags:
    """For each row, whether operations continue or resume in it, (rows,).

    Operations stop in a row that does not meet the limits of operation. They resume in the next row that
    also meets the limits for resuming. Before the record, and in its gaps, they are stopped.

    Parameters
    ----------
    met : (rows,) whether a row meets the limits of operation.
    resuming : (rows,) whether it meets the limits for resuming.
    joined : (rows - 1,) whether no gap is between a row and the next.
    """
    resumes = met & resuming
    stops = ~met | np.concatenate([np.ones(min(len(met), 1), bool), ~joined])
    last = np.maximum.accumulate(np.where(resumes | stops, np.arange(len(met)), 0))
    return np.asarray(resumes[last])
