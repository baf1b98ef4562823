r"""Pull of a tensioner cylinder from a table over its extension, interpolated by monotone cubics.

.. math:: F(x) = a_k t^3 + b_k t^2 + c_k t + d_k, \qquad t = x - x_k

Here x is the extension of the cylinder, and the index k denotes an interval of the table. The cubics of
Fritsch and Butland (1984) have a continuous slope and increase wherever the table increases. The first and
the last piece are straight lines, which continue beyond the table.

References
----------
Fritsch and Butland (1984), "A method for constructing local monotone piecewise cubic interpolants", *SIAM
Journal on Scientific and Statistical Computing* 5, 300-304.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner


class TabulatedLaw(NamedTuple):
    """One table for all cylinders."""

    reach: np.ndarray  # (p+1,) reach at which pieces begin and end (m)
    force: np.ndarray  # (4, p) a, b, c, d of each piece (N, m)
    energy: np.ndarray  # (5, p) the same for the integral of the force, zero at mid-stroke (J, m)
    working: np.ndarray  # (c,) 1 for a cylinder that works, 0 for one that failed


@inner
def _piece(law, x):
    """Index of the piece at a reach; the first and the last piece continue beyond the table."""
    low, high = 0, law.force.shape[1] - 1
    while low < high:
        middle = (low + high + 1) // 2
        if x >= law.reach[middle]:
            low = middle
        else:
            high = middle - 1
    return low


@inner
def force(law, s):
    """Pull by the cubic of the table, and its slope."""
    for c in range(law.working.shape[0]):
        k = _piece(law, s.reach[c])
        t = s.reach[c] - law.reach[k]
        pull = ((law.force[0, k] * t + law.force[1, k]) * t + law.force[2, k]) * t + law.force[3, k]
        slope = (3.0 * law.force[0, k] * t + 2.0 * law.force[1, k]) * t + law.force[2, k]
        s.pull[c] += law.working[c] * pull
        s.k_pull[c] += law.working[c] * slope
    return 0.0


@inner
def energy(law, s):
    """Work stored since mid-stroke (J)."""
    total = 0.0
    for c in range(law.working.shape[0]):
        k = _piece(law, s.reach[c])
        t = s.reach[c] - law.reach[k]
        stored = 0.0
        for row in range(5):
            stored = stored * t + law.energy[row, k]
        total += law.working[c] * stored
    return total


register(TabulatedLaw, Called("tabulated tensioner", "top.tensioners.table"), law=force, potential=energy)
