"""Distributed loads: from values per length at the nodes to forces on the nodes.

A segment with coefficient c gives its lower node c (own q_lower + other q_upper), and its upper node
the mirror image. With own = 5/12 and other = 1/12 this integrates a parabola against the hat function
of a node; with 1/2 and 0 it is lumping.
"""

from __future__ import annotations

from riserstudy.jit import inner


@inner
def spread(s, coefficient, own, other, q, into):
    """Add the nodal forces of a load ``q`` (d, n+1) times ``coefficient`` (n,) to ``into``."""
    n = coefficient.shape[0]
    for k in range(len(s.dim)):
        into[k, 0] += coefficient[0] * (own * q[k, 0] + other * q[k, 1])
        into[k, n] += coefficient[n - 1] * (own * q[k, n] + other * q[k, n - 1])
        for i in range(1, n):
            into[k, i] += coefficient[i - 1] * (own * q[k, i] + other * q[k, i - 1])
            into[k, i] += coefficient[i] * (own * q[k, i] + other * q[k, i + 1])


@inner
def spread_stiffness(s, coefficient, own, other):
    """Add the stiffness of such a load, whose value at node i changes by -``s.block[i]`` with it."""
    n = coefficient.shape[0]
    block, k_node, k_up, k_low = s.block, s.k_node, s.k_up, s.k_low
    for c in range(len(s.dim) ** 2):
        k_node[0, c] += own * coefficient[0] * block[0, c]
        k_node[n, c] += own * coefficient[n - 1] * block[n, c]
    for i in range(1, n):
        near = own * (coefficient[i - 1] + coefficient[i])
        for c in range(len(s.dim) ** 2):
            k_node[i, c] += near * block[i, c]
    if other == 0.0:
        return
    for e in range(n):
        far = other * coefficient[e]
        for c in range(len(s.dim) ** 2):
            k_up[e, c] += far * block[e + 1, c]
            k_low[e, c] += far * block[e, c]
