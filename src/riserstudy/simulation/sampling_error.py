r"""Standard errors of a vibration's statistics due to the limited length of a run, from blocks.

A vibration that is not periodic has different statistics in different time windows of the same length. The
evaluated time is divided into B blocks. With the standard deviation :math:`\sigma_B` of a statistic from
block to block, its standard error over the whole time is :math:`\sigma_B / \sqrt B`, if blocks are longer
than the correlation time of the vibration. This time is not known, so the largest value for several B is
used. The standard error of a periodic vibration is almost zero.

References
----------
Flyvbjerg and Petersen (1989), "Error estimates on averages of correlated data", *Journal of Chemical
Physics* 91, 461-466.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from riserstudy.records.arrays import FloatArray

BLOCKS = (4, 8, 16)
FEWEST = 8  # smallest number of outputs in a block
#: factor for the difference of two independent runs; a difference up to DOUBTFUL times this counts as chance
TWO_RUNS, DOUBTFUL = math.sqrt(2.0), 2.0


def standard_error(statistic: Callable[[slice], FloatArray], outputs: int, least: int = 0) -> FloatArray:
    """Standard error of a mean over some outputs, of each of its values.

    Parameters
    ----------
    statistic : function of a block of outputs, (k,), whose mean over blocks is the statistic of all outputs.
    outputs : number of outputs.
    least : smallest number of outputs in a block, as long as there are four blocks.

    Returns
    -------
    (k,), in the unit of the statistic; infinite for too few outputs.
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
    """Standard deviation of relative differences by chance between two runs, by quantity."""
    return {name: TWO_RUNS * value for name, value in sampling.items()}


def floor(sampling: dict[str, float]) -> dict[str, float]:
    """Relative differences of two runs that may be chance, by quantity."""
    return {name: DOUBTFUL * value for name, value in of_two_runs(sampling).items()}
