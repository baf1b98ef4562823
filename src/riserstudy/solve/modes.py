"""Natural frequencies and shapes about an equilibrium, and the largest stable explicit time step.

Both follow from the engine's tangent and mass; moments are eliminated, so the stiffness includes bending.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import block_array, coo_array, csc_array, csr_array
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from riserstudy.solve.evaluate import forces_and_tangent, one_call
from riserstudy.solve.program import Packed
from riserstudy.solve.state import ACCELERATION, VELOCITY

# unknowns up to which computing all eigenvalues is faster than computing the largest alone
FEW = 300
VECTORS = 40  # vectors kept in the search for the largest eigenvalue
TIGHT = 1e-5  # relative tolerance of the largest eigenvalue


class LinearisedModel(NamedTuple):
    """A model linearised about its present state, for the free positions; symmetric parts of the matrices."""

    stiff: csr_array  # (k, k) without bending
    turn: csr_array  # (a, k) derivatives of the turning angles at nodes that carry a moment
    flexibility: csc_array  # (a, a)
    damping: csr_array  # (k, k)
    mass: csr_array  # (k, k)
    free: np.ndarray  # (k, 2) their nodes and directions

    def stiffness(self) -> Callable[[np.ndarray], np.ndarray]:
        """Function that multiplies by the stiffness, bending included."""
        if not self.turn.shape[0]:
            return self.stiff.__matmul__
        bend = splu(self.flexibility).solve
        return lambda x: self.stiff @ x + self.turn.T @ bend(self.turn @ x)


def linearise(programs: Packed, state: Packed, fixed: np.ndarray) -> LinearisedModel:
    """A linearised model; ``fixed``: (node, unknown) pairs, (k, 2), moments numbered before positions."""
    s = state.value
    d, m, nodes = len(s.dim), len(s.dof) - len(s.dim), s.r.shape[1]

    def at_rate(velocity: float) -> csr_array:
        s.rate[VELOCITY], s.rate[ACCELERATION] = velocity, 0.0
        forces_and_tangent(programs, state)
        return _stiffness(s, d)

    stiff = at_rate(0.0)
    turn, flexibility = _bending(s, d, m)  # of the angles at rest, before they include rates
    damping = at_rate(1.0) - stiff
    for array in (s.k_segment, s.k_node, s.k_up, s.k_low):
        array[:] = 0.0
    s.rate[ACCELERATION] = 1.0
    one_call(programs.value.mass, state)
    mass = _stiffness(s, d)
    s.rate[:] = 0.0

    free = np.ones((nodes, m + d), bool)
    free[tuple(fixed.T)] = False
    bent, moved = free[:, :m].ravel(), free[:, m:].ravel()
    stiff, damping, mass = ((0.5 * (a + a.T)).tocsr()[moved][:, moved] for a in (stiff, damping, mass))
    turn, flexibility = turn[bent][:, moved], flexibility[bent][:, bent].tocsc()
    return LinearisedModel(stiff, turn, flexibility, damping, mass, np.argwhere(free[:, m:]))


def matrices(programs: Packed, state: Packed, fixed: np.ndarray):
    """Stiffness, damping and mass over the free positions, and their (node, direction) pairs.

    Returns
    -------
    stiffness, damping, mass : (k, k) arrays, symmetric parts.
    free : (k, 2) array of node and direction.
    """
    model = linearise(programs, state, fixed)
    stiff = model.stiffness()(np.eye(len(model.free)))
    return stiff, model.damping.toarray(), model.mass.toarray(), model.free


def _stiffness(s, d) -> csr_array:
    """Stiffness with respect to positions alone, of all nodes."""
    k = s.k_segment.reshape(-1, d, d)
    node = s.k_node.reshape(-1, d, d).copy()
    node[:-1] += k
    node[1:] += k
    i = np.arange(len(node))
    return _blocks(
        [node, s.k_up.reshape(k.shape) - k, s.k_low.reshape(k.shape) - k],
        [(i, i), (i[:-1], i[1:]), (i[1:], i[:-1])],
        len(node),
    )


def _bending(s, d, m) -> tuple[csr_array, csr_array]:
    """Derivatives of the turning angles by positions, and the flexibility matrix; of all nodes."""
    nodes = s.r.shape[1]
    low, up = (by.reshape(nodes - 1, d, m).transpose(0, 2, 1) for by in (s.turn_low, s.turn_up))
    e, i = np.arange(nodes - 1), np.arange(nodes)
    places = [(e, e + 1), (e, e), (e + 1, e + 1), (e + 1, e)]
    turn = _blocks([low, -low, up, -up], places, nodes)
    own, other = (np.eye(m) * by[:, None, None] for by in (s.flex, s.flex_up))
    return turn, _blocks([own, other, other], [(i, i), (e, e + 1), (e + 1, e)], nodes)


def _blocks(blocks, places, nodes) -> csr_array:
    """Sparse matrix of blocks (count, p, q) at (rows, columns) of nodes; blocks at one place are added."""
    p, q = blocks[0].shape[1:]
    data, rows, columns = [], [], []
    for block, (row, column) in zip(blocks, places, strict=True):
        shape = block.shape
        data.append(block.ravel())
        rows.append(np.broadcast_to(row[:, None, None] * p + np.arange(p)[:, None], shape).ravel())
        columns.append(np.broadcast_to(column[:, None, None] * q + np.arange(q), shape).ravel())
    where = np.concatenate(rows), np.concatenate(columns)
    return coo_array((np.concatenate(data), where), shape=(nodes * p, nodes * q)).tocsr()


def natural_modes(programs: Packed, state: Packed, fixed: np.ndarray, count: int):
    """Lowest natural frequencies (rad/s) and shapes about the present state.

    Returns
    -------
    frequency : (k,) array; an imaginary frequency (unstable direction) is returned as a negative number.
    shape : (k, d, n+1) array, largest component 1.
    """
    stiff, _, mass, free = matrices(programs, state, fixed)
    square, vectors = eigh(stiff, mass)
    s = state.value
    k = min(count, len(square))
    shapes = np.zeros((k, *s.r.shape))
    for j in range(k):
        shapes[j, free[:, 1], free[:, 0]] = vectors[:, j] / np.abs(vectors[:, j]).max()
    return np.sign(square[:k]) * np.sqrt(np.abs(square[:k])), shapes[:, :, : len(s.l0) + 1]


def _linearised_with_mass(programs: Packed, state: Packed, fixed: np.ndarray) -> LinearisedModel:
    """The linearised model; LinAlgError when a free node has no mass."""
    model = linearise(programs, state, fixed)
    if not (model.mass.diagonal() > 0.0).all():
        raise np.linalg.LinAlgError("a node that moves has no mass")
    return model


def lowest_squares(
    programs: Packed, state: Packed, fixed: np.ndarray, count: int, below: float
) -> np.ndarray:
    """Squares (rad2/s2) of the lowest natural frequencies about the present state, (k,), ascending.

    ``below`` (rad2/s2): a number below all of them; the nearer to the lowest, the faster. The moments stay
    unknowns, so that the matrices are banded.

    Raises
    ------
    numpy.linalg.LinAlgError
        When a free node has no mass.
    """
    model = _linearised_with_mass(programs, state, fixed)
    size = model.mass.shape[0]
    if size <= FEW or 2 * count >= size:
        last = [0, min(count, size) - 1]
        stiff = model.stiffness()(np.eye(size))
        return eigh(stiff, model.mass.toarray(), eigvals_only=True, subset_by_index=last)
    shifted = block_array(
        [[model.stiff - below * model.mass, model.turn.T], [model.turn, -model.flexibility]], format="csc"
    )
    solve, zeros = splu(shifted).solve, np.zeros(model.turn.shape[0])
    inverse = LinearOperator((size, size), lambda x: solve(np.concatenate([x.ravel(), zeros]))[:size])
    squares = eigsh(
        LinearOperator((size, size), model.stiffness()),
        k=count,
        M=model.mass,
        sigma=below,
        OPinv=inverse,
        v0=np.random.default_rng(0).normal(size=size),
        return_eigenvectors=False,
    )
    return np.sort(squares)


def stable_step(programs: Packed, state: Packed, fixed: np.ndarray) -> float:
    """Largest stable step of the explicit method about the present state (s); infinite without stiffness.

    ``fixed`` as in `linear`, (k, 2).

    Steps h are stable if h^2 K + 2 h C < 4 M in every direction, because damping uses the velocity half a
    step earlier. For a mode of frequency w and damping ratio z, h must be below 2 (sqrt(1 + z^2) - z) / w.

    Raises
    ------
    numpy.linalg.LinAlgError
        When a free node has no mass.
    """
    model = _linearised_with_mass(programs, state, fixed)
    stiff = model.stiffness()
    highest, _ = _largest(stiff, model.mass)
    if highest <= 0.0:
        return math.inf
    longest, step = 2.0 / math.sqrt(highest), math.inf
    while longest < (1.0 - TIGHT) * step:
        step = longest
        both = partial(_both, step, stiff, model.damping)
        _, x = _largest(both, model.mass)
        # for this direction alone, the limit is an upper bound, which converges to the limit for all
        square, rate = float(x @ stiff(x)), float(x @ (model.damping @ x))
        longest = 4.0 / (rate + math.sqrt(rate * rate + 4.0 * square))
    return (1.0 - TIGHT) * min(longest, step)


def _both(step, stiff, damping, x):
    return step * step * stiff(x) + 2.0 * step * (damping @ x)


def _largest(operator, mass: csr_array) -> tuple[float, np.ndarray]:
    """Largest eigenvalue of a symmetric operator with a mass, and its vector x with x' M x = 1."""
    size = mass.shape[0]
    if size <= FEW:
        last = [size - 1, size - 1]
        values, vectors = eigh(operator(np.eye(size)), mass.toarray(), subset_by_index=last)
    else:
        shape = (size, size)
        values, vectors = eigsh(
            LinearOperator(shape, operator),
            k=1,
            M=mass,
            Minv=LinearOperator(shape, splu(mass.tocsc()).solve),
            which="LA",
            v0=np.random.default_rng(0).normal(size=size),  # the same in every run
            ncv=VECTORS,
            tol=TIGHT,
        )
    return float(values[0]), vectors[:, 0]
