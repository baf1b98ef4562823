r"""What the length of a run leaves open of the statistics of a vibration: their standard errors, by blocks.

A vibration that is not periodic has other statistics over another stretch of the same length. The time that
is judged is cut into B blocks; with :math:`\sigma_B` the scatter of a statistic from block to block, its
standard error over the whole is :math:`\sigma_B / \sqrt B`, once blocks are longer than the vibration
remembers. That length is not known: the largest over several B counts. A periodic vibration has next to none.

References
----------
Flyvbjerg and Petersen (1989), "Error estimates on averages of correlated data", *Journal of Chemical
Physics* 91, 461-466.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
BLOCKS = (4, 8, 16)
FEWEST = 8  # outputs of a block
#: two runs of the same vibration, each by chance; their difference counts as chance up to twice that
TWO_RUNS, DOUBTFUL = math.sqrt(2.0), 2.0


def standard_error(statistic: Callable[[slice], Array], outputs: int, least: int = 0) -> Array:
    """Standard error of a mean over some outputs, of each of its values.

    Parameters
    ----------
    statistic : of a block of outputs, (k,), such that its mean over blocks is that of all outputs.
    outputs : their number.
    least : of the outputs of a block, but that there are four blocks.

    Returns
    -------
    (k,), infinite where there are too few outputs.
    """
    found = np.array(math.inf)
    for blocks in BLOCKS:
        size = outputs // blocks
        if size < FEWEST or (size < least and blocks > BLOCKS[0]):
            break
        each = np.array([statistic(slice(k * size, (k + 1) * size)) for k in range(blocks)])
        error = each.std(axis=0, ddof=1) / math.sqrt(blocks)
        found = error if np.isinf(found).all() else np.maximum(found, error)
    return np.asarray(found)


def of_two_runs(sampling: dict[str, float]) -> dict[str, float]:
    """Relative differences by chance between two runs, one standard deviation, by quantity."""
    return {name: TWO_RUNS * value for name, value in sampling.items()}


def floor(sampling: dict[str, float]) -> dict[str, float]:
    """Relative differences of two runs up to which they show nothing but chance, by quantity."""
    return {name: DOUBTFUL * value for name, value in of_two_runs(sampling).items()}
