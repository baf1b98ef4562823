"""Distributed loads: from values per length at the nodes to forces on the nodes.

A segment with coefficient c loads its lower node with c (own q_lower + other q_upper), and its upper node
with c (own q_upper + other q_lower). With own = 5/12 and other = 1/12, this integrates a parabola against the
hat function of a node; with 1/2 and 0 it is lumping. A coefficient that varies within the segment has one
mean for its lower node, ``low``, and one for its upper node, ``up``, each weighted by the node's hat
function.
"""

from __future__ import annotations

from riserstudy.solve.jit import inner
from riserstudy.solve.state import SUPPLIED
from riserstudy.solve.vec import at, dot


@inner
def spread(s, low, up, own, other, q, into):
    """Add the nodal forces of a load ``q`` (d, n+1) times coefficients (n,) to ``into``."""
    n = low.shape[0]
    for k in range(len(s.dim)):
        into[k, 0] += low[0] * (own * q[k, 0] + other * q[k, 1])
        into[k, n] += up[n - 1] * (own * q[k, n] + other * q[k, n - 1])
        for i in range(1, n):
            into[k, i] += up[i - 1] * (own * q[k, i] + other * q[k, i - 1])
            into[k, i] += low[i] * (own * q[k, i] + other * q[k, i + 1])


@inner
def spread_and_keep(s, low, up, own, other, q, kept, into):
    """As `spread`; the nodal forces are also written to ``kept``."""
    n = low.shape[0]
    for k in range(len(s.dim)):
        kept[k, 0] = low[0] * (own * q[k, 0] + other * q[k, 1])
        kept[k, n] = up[n - 1] * (own * q[k, n] + other * q[k, n - 1])
        for i in range(1, n):
            near = own * (up[i - 1] + low[i]) * q[k, i]
            kept[k, i] = near + other * (up[i - 1] * q[k, i - 1] + low[i] * q[k, i + 1])
        for i in range(n + 1):
            into[k, i] += kept[k, i]


@inner
def supplied(load, s):
    """Power that the water supplies (W) by the nodal forces that `spread_and_keep` wrote."""
    for i in range(s.l0.shape[0] + 1):
        s.flow[SUPPLIED] += dot(at(s.dim, load.force, i), at(s.dim, s.v, i))
    return 0.0


@inner
def spread_stiffness(s, low, up, own, other):
    """Add the stiffness of a spread load whose derivative by the position of node i is -``s.block[i]``."""
    n = low.shape[0]
    block, k_node, k_up, k_low = s.block, s.k_node, s.k_up, s.k_low
    for c in range(len(s.dim) ** 2):
        k_node[0, c] += own * low[0] * block[0, c]
        k_node[n, c] += own * up[n - 1] * block[n, c]
    for i in range(1, n):
        near = own * (up[i - 1] + low[i])
        for c in range(len(s.dim) ** 2):
            k_node[i, c] += near * block[i, c]
    if other == 0.0:
        return
    for e in range(n):
        above, below = other * low[e], other * up[e]
        for c in range(len(s.dim) ** 2):
            k_up[e, c] += above * block[e + 1, c]
            k_low[e, c] += below * block[e, c]
