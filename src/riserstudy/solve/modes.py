"""Natural frequencies and shapes about an equilibrium, and the explicit step that stays stable.

Both come from the engine's own tangent and mass, made dense: moments are eliminated, so the stiffness
includes bending.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh

from riserstudy.solve.evaluate import forces_and_tangent, one_call
from riserstudy.solve.program import Frozen


def matrices(programs: Frozen, state: Frozen, fixed: np.ndarray):
    """Stiffness, damping and mass over the free positions, and their (node, direction) pairs.

    Returns
    -------
    stiffness, damping, mass : (k, k) arrays, symmetric parts.
    free : (k, 2) array of node and direction.
    """
    s = state.value
    d, m, n = len(s.dim), len(s.dof) - len(s.dim), s.r.shape[1] - 1

    def tangent(velocity: float) -> np.ndarray:
        s.rate[0], s.rate[1] = velocity, 0.0
        forces_and_tangent(programs, state)
        return _dense(s, d, n)

    stiff = tangent(0.0)
    turn, flexibility = _bending(s, d, m, n)  # of the angles at rest, before rates enter them
    damping = tangent(1.0) - stiff
    if m:
        carried = np.ones(m * (n + 1), bool)
        for node, unknown in fixed:
            if unknown < m:
                carried[node * m + unknown] = False
        turn, flexibility = turn[carried], flexibility[np.ix_(carried, carried)]
        stiff = stiff + turn.T @ np.linalg.solve(flexibility, turn)
    for array in (s.k_segment, s.k_node, s.k_up, s.k_low):
        array[:] = 0.0
    s.rate[1] = 1.0
    one_call(programs.value.mass, state)
    mass = _dense(s, d, n)
    s.rate[:] = 0.0
    held = {(int(node), int(unknown) - m) for node, unknown in fixed if unknown >= m}
    free = [(i, c) for i in range(n + 1) for c in range(d) if (i, c) not in held]
    index = [i * d + c for i, c in free]
    take = np.ix_(index, index)
    parts = [0.5 * (a + a.T)[take] for a in (stiff, damping, mass)]
    return *parts, np.array(free)


def _dense(s, d, n):
    """Position stiffness as a dense matrix."""
    full = np.zeros((d * (n + 1), d * (n + 1)))
    for i in range(n + 1):
        a = slice(d * i, d * i + d)
        full[a, a] += s.k_node[i].reshape(d, d)
        if i < n:
            b = slice(d * i + d, d * i + 2 * d)
            k = s.k_segment[i].reshape(d, d)
            full[a, a] += k
            full[b, b] += k
            full[a, b] += s.k_up[i].reshape(d, d) - k
            full[b, a] += s.k_low[i].reshape(d, d) - k
    return full


def _bending(s, d, m, n):
    """Slopes of the turning angles by positions, (m (n+1), d (n+1)), and the flexibility matrix."""
    turn = np.zeros((m * (n + 1), d * (n + 1)))
    flexibility = np.zeros((m * (n + 1), m * (n + 1)))
    for i in range(n + 1):
        for u in range(m):
            flexibility[i * m + u, i * m + u] = s.flex[i]
            if i < n:
                flexibility[i * m + u, (i + 1) * m + u] = s.flex_up[i]
                flexibility[(i + 1) * m + u, i * m + u] = s.flex_up[i]
    for e in range(n):
        for node, by in ((e, s.turn_low[e]), (e + 1, s.turn_up[e])):
            rows = slice(node * m, node * m + m)
            slope = by.reshape(d, m).T
            turn[rows, (e + 1) * d : (e + 2) * d] += slope
            turn[rows, e * d : (e + 1) * d] -= slope
    return turn, flexibility


def natural_modes(programs: Frozen, state: Frozen, fixed: np.ndarray, count: int):
    """Lowest natural frequencies (rad/s) and shapes about the present state.

    Returns
    -------
    frequency : (k,) array; imaginary ones (unstable directions) come as negative numbers.
    shape : (k, d, n+1) array, largest displacement 1.
    """
    stiff, _, mass, free = matrices(programs, state, fixed)
    square, vectors = eigh(stiff, mass)
    s = state.value
    k = min(count, len(square))
    shapes = np.zeros((k, *s.r.shape))
    for j in range(k):
        shapes[j, free[:, 1], free[:, 0]] = vectors[:, j] / np.abs(vectors[:, j]).max()
    return np.sign(square[:k]) * np.sqrt(np.abs(square[:k])), shapes[:, :, : len(s.l0) + 1]


def stable_step(programs: Frozen, state: Frozen, fixed: np.ndarray) -> float:
    """Largest stable step of the explicit method about the present state (s).

    A mode of frequency w and damping ratio z is stable below 2 (sqrt(1 + z^2) - z) / w, because damping
    acts with the velocity of half a step ago.
    """
    stiff, damping, mass, _ = matrices(programs, state, fixed)
    square, vectors = eigh(stiff, mass)
    modal = np.einsum("ij,ik,kj->j", vectors, damping, vectors)
    moving = square > 0.0
    w = np.sqrt(square[moving])
    z = 0.5 * modal[moving] / w
    return float(np.min(2.0 * (np.sqrt(1.0 + z * z) - z) / w))
