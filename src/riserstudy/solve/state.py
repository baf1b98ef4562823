"""The state of a riser model during a solution: positions, forces, and their derivatives.

Nodes i = 0 ... n carry the mass, segments e = 0 ... n-1 join node e to node e + 1, from the bottom up.
A segment pulls its lower node with the force ``segment[:, e]`` and its upper node with the opposite:
tension along it and shear across it. Bending moments are separate unknowns at the nodes. Shear is their
difference divided by the segment's length. The angle by which the riser turns at a node equals the moments
times the flexibility of the segments around it.

Nodes beyond n are loose: unknowns of the vessel that holds the top, its yaw or its thrusters' lag. No segment
connects them; each is coupled to the previous node by ``k_up`` and ``k_low`` alone.

Arrays that couple a node to the next (from ``k_segment`` to ``turn_up``, and ``flex_up``) have a row of zeros
in memory before the first and after the last row. The solver may therefore read beyond the ends.

Distributed quantities (mass, added mass, drag, flexibility) are shared between the nodes of a segment:
5/12 to the near node, 1/12 to the far node. This is the integral of a parabola against the hat function of a
node, and makes displacement and moment fourth-order accurate on even meshes. Shares of 1/2 and 0 are plain
lumping, which explicit stepping requires for the mass.
"""

from __future__ import annotations

from itertools import accumulate, pairwise
from math import prod
from typing import NamedTuple

import numpy as np

from riserstudy.solve.jit import inner
from riserstudy.solve.vec import at, mul, norm, plus, put, sub, upward

OWN, OTHER = 5.0 / 12.0, 1.0 / 12.0

VELOCITY, ACCELERATION = 0, 1  # entries of `rate`
DISSIPATED, SUPPLIED = 0, 1  # entries of `flow`
#: share of a ramp after which it counts as ended, so that rounding of times has no effect
ENDED = 1.0 - 5e-13


class State(NamedTuple):
    """Arrays are component-major; d directions, m moments per node (0, 1 or 3), n segments.

    There are N nodes in total: the n + 1 of the riser, then the loose nodes.
    """

    dim: tuple[float, ...]  # d zeros: gives compiled code the number of directions
    dof: tuple[float, ...]  # m + d zeros: unknowns per node

    # (2,) time (s); share of the current that acts (1 except during static loading)
    clock: np.ndarray
    rate: np.ndarray  # (2,) dv/dr (1/s) and da/dr (1/s2) of the integrator, 0 in statics
    share: np.ndarray  # (2,) shares of a segment's mass: near node, far node
    l0: np.ndarray  # (n,) unstretched lengths (m)

    r: np.ndarray  # (d, N) positions (m)
    v: np.ndarray  # (d, N) velocities (m/s)
    a: np.ndarray  # (d, N) accelerations (m/s2)
    moment: np.ndarray  # (m, N) bending moments (N m)

    tangent: np.ndarray  # (d, n) unit vectors along segments
    length: np.ndarray  # (n,) stretched lengths (m)
    inverse_length: np.ndarray  # (n,) 1 / length (1/m)
    direction: np.ndarray  # (d, n+1) unit tangents at nodes
    platform: np.ndarray  # (3, 6) displacement, velocity, acceleration: surge ... heave ... yaw
    level: np.ndarray  # (n+1,) height of the water surface above the mean level, at the nodes (m)
    water: np.ndarray  # (d, n+1) water velocity at the nodes (m/s)
    shear: np.ndarray  # (d, n+1) its change with elevation (1/s)
    water_rate: np.ndarray  # (d, n+1) water acceleration at the nodes (m/s2)

    blend: np.ndarray  # (n+1,) share of the segment above in the tension at a node
    kink: np.ndarray  # (n+1,) force of a change of weight at a node, added to this tension (N)

    density: np.ndarray  # (d, n+1) scratch: a load per length at the nodes
    block: np.ndarray  # (n+1, d*d) scratch: minus its derivative by the position of the node

    segment: np.ndarray  # (d, n) force of a segment on its lower node (N)
    force: np.ndarray  # (d, N) force on the nodes (N)
    # (2, 2, d) forces of the string alone at its ends: force, inertia; bottom, top (N)
    ends: np.ndarray
    turn: np.ndarray  # (m, N) turning angle minus flexibility times moment (rad)

    k_segment: np.ndarray  # (N-1, d*d) d segment / d (r upper - r lower)
    k_node: np.ndarray  # (N, d*d) -d force / d r of the same node
    k_up: np.ndarray  # (N-1, d*d) -d force of the lower node / d r of the upper
    k_low: np.ndarray  # (N-1, d*d) -d force of the upper node / d r of the lower
    by_low: np.ndarray  # (N-1, d*m) d segment / d moment of the lower node
    by_up: np.ndarray  # (N-1, d*m) d segment / d moment of the upper node
    turn_low: np.ndarray  # (N-1, d*m) d turn of the lower node / d (r upper - r lower)
    turn_up: np.ndarray  # (N-1, d*m) d turn of the upper node / d (r upper - r lower)
    flex: np.ndarray  # (N,) flexibility of a node: angle per moment at this node (rad/(N m))
    flex_up: np.ndarray  # (N-1,) angle per moment at the next node (rad/(N m))
    flex_inverse: np.ndarray  # (N,) factors of the flexibility matrix, 0 at hinges
    flex_factor: np.ndarray  # (N-1,)

    reach: np.ndarray  # (cylinders,) extension from mid-stroke (m)
    reach_rate: np.ndarray  # (cylinders,) its rate (m/s)
    # (3, 3, cylinders) deck points relative to a vessel, velocities, accelerations
    deck: np.ndarray
    arm: np.ndarray  # (3, cylinders) ring points from the ring's centre (m)
    line: np.ndarray  # (3, cylinders) unit vectors from ring to deck
    distance: np.ndarray  # (cylinders,) length of the cylinders (m)
    ring_moment: np.ndarray  # (3,) moment of the pulls about the ring's centre (N m)
    pull: np.ndarray  # (cylinders,) force on the ring towards the deck (N)
    k_pull: np.ndarray  # (cylinders,) d pull / d reach, including the effect of its rate (N/m)

    lump: np.ndarray  # (d*d, N) lumped mass of a node (kg), row by row, upper triangle

    # internal variables q of effects at the riser's nodes, q' = G(q, r, v, a), see `Programs.internal`
    internal: np.ndarray  # (k, n+1) q
    internal_rate: np.ndarray  # (k, n+1) G
    internal_known: np.ndarray  # (k, n+1) q without the contribution of the present rate
    # (1,) time by which the present rate is multiplied (s), 0 if q is known
    internal_share: np.ndarray

    # first-order motion, which is added to the top's low-frequency motion: position (m), velocity (m/s),
    # acceleration (m/s2); and the inertial force of the mass at the top that does not have this motion (N)
    carried: np.ndarray  # (4, d)

    # Arrays that are cleared together are adjacent in memory; each of these covers one such group.
    loads: np.ndarray  # (its parts,) force, segment, turn, pull, k_pull
    seas: np.ndarray  # (its parts,) level, water, shear, water_rate
    lumps: np.ndarray  # (its parts,) lump
    slopes: np.ndarray  # (its parts,) k_segment, k_node, k_up, k_low, by_low, by_up, turn_low, turn_up

    flow: np.ndarray  # (2,) power dissipated, power supplied by water and devices (W)
    probe: np.ndarray  # (probes,) scalars that effects report at output times


def new_state(
    l0, directions, moments, cylinders=0, probes=0, share=(OWN, OTHER), loose=0, internal=0
) -> State:
    """Zeroed state for unstretched segment lengths ``l0``, shape (n,), m."""
    n, d, m, c, k = len(l0), directions, moments, cylinders, internal
    nodes = n + 1 + loose

    def zeros(*shape):
        return np.zeros(shape)

    loads, (force, segment, turn, pull, k_pull) = _together((d, nodes), (d, n), (m, nodes), (c,), (c,))
    seas, (level, water, shear, water_rate) = _together((n + 1,), *[(d, n + 1)] * 3)
    lumps, (lump,) = _together((d * d, nodes))
    slopes, (k_node, *joining) = _together(
        (nodes, d * d), *[(nodes + 1, d * d)] * 3, *[(nodes + 1, d * m)] * 4
    )
    k_segment, k_up, k_low, by_low, by_up, turn_low, turn_up = (x[1:-1] for x in joining)
    return State(
        dim=(0.0,) * d,
        dof=(0.0,) * (m + d),
        clock=np.array([0.0, 1.0]),
        rate=zeros(2),
        share=np.array(share, float),
        l0=np.array(l0, float),
        r=zeros(d, nodes),
        v=zeros(d, nodes),
        a=zeros(d, nodes),
        moment=zeros(m, nodes),
        tangent=zeros(d, n),
        length=zeros(n),
        inverse_length=zeros(n),
        direction=zeros(d, n + 1),
        platform=zeros(3, 6),
        level=level,
        water=water,
        shear=shear,
        water_rate=water_rate,
        blend=zeros(n + 1),
        kink=zeros(n + 1),
        density=zeros(d, n + 1),
        block=zeros(n + 1, d * d),
        segment=segment,
        force=force,
        ends=zeros(2, 2, d),
        turn=turn,
        k_segment=k_segment,
        k_node=k_node,
        k_up=k_up,
        k_low=k_low,
        by_low=by_low,
        by_up=by_up,
        turn_low=turn_low,
        turn_up=turn_up,
        flex=zeros(nodes),
        flex_up=zeros(nodes + 1)[1:-1],
        flex_inverse=zeros(nodes),
        flex_factor=zeros(nodes - 1),
        reach=zeros(c),
        reach_rate=zeros(c),
        deck=zeros(3, 3, c),
        arm=zeros(3, c),
        line=zeros(3, c),
        distance=zeros(c),
        ring_moment=zeros(3),
        pull=pull,
        k_pull=k_pull,
        lump=lump,
        internal=zeros(k, n + 1),
        internal_rate=zeros(k, n + 1),
        internal_known=zeros(k, n + 1),
        internal_share=zeros(1),
        carried=zeros(4, d),
        loads=loads,
        seas=seas,
        lumps=lumps,
        slopes=slopes,
        flow=zeros(2),
        probe=zeros(probes),
    )


def _together(*shapes):
    """Zeros of several shapes, adjacent in memory: all of them as one vector, and each array."""
    ends = [0, *accumulate(map(prod, shapes))]
    whole = np.zeros(ends[-1])
    pieces = zip(pairwise(ends), shapes, strict=True)
    return whole, [whole[a:b].reshape(shape) for (a, b), shape in pieces]


@inner
def measure(s):
    """Lengths and directions of the segments, tangents at the nodes."""
    dim, r, tangent, direction = s.dim, s.r, s.tangent, s.direction
    length, inverse = s.length, s.inverse_length
    n = length.shape[0]
    for e in range(n - 1):
        here, above = at(dim, r, e), at(dim, r, e + 1)
        along, chord = sub(above, here), sub(at(dim, r, e + 2), here)
        stretched, reach = norm(along), norm(chord)
        share = 1.0 / (stretched * reach)  # one division instead of two
        length[e], inverse[e] = stretched, share * reach
        put(tangent, e, mul(share * reach, along))
        put(direction, e + 1, mul(share * stretched, chord))
    along = sub(at(dim, r, n), at(dim, r, n - 1))
    length[n - 1] = norm(along)
    inverse[n - 1] = 1.0 / length[n - 1]
    put(tangent, n - 1, mul(inverse[n - 1], along))
    put(direction, 0, at(dim, tangent, 0))
    put(direction, n, at(dim, tangent, n - 1))


@inner
def axis(s, horizontal, i):
    """Unit vector along which the flow causes no force: the pipe's tangent at a node, or the vertical."""
    if horizontal:
        return upward(s.dim)
    return at(s.dim, s.direction, i)


@inner
def gather(s):
    """Add the pull of the segments to the forces on their nodes."""
    dim, force, segment = s.dim, s.force, s.segment
    n = s.length.shape[0]
    plus(force, 0, at(dim, segment, 0))
    plus(force, n, mul(-1.0, at(dim, segment, n - 1)))
    for i in range(1, n):
        plus(force, i, sub(at(dim, segment, i), at(dim, segment, i - 1)))


@inner
def of_pulls(s, u):
    """A component of the moment of the pulls about the ring, by which the moment jumps there."""
    return s.ring_moment[u] if len(s.dof) - len(s.dim) == 3 else s.ring_moment[1]


@inner
def copy(into, array):
    """Copy a matrix (a slice assignment would also compile numpy's broadcasting and its messages)."""
    for c in range(array.shape[0]):
        for i in range(array.shape[1]):
            into[c, i] = array[c, i]


class Before(NamedTuple):
    """Values at the start of a step, of the arrays of the same name in `State`."""

    r: np.ndarray  # (d, N)
    v: np.ndarray  # (d, N)
    a: np.ndarray  # (d, N)
    moment: np.ndarray  # (m, N)
    carried: np.ndarray  # (4, d)
    internal: np.ndarray  # (k, n+1)
    internal_rate: np.ndarray  # (k, n+1)


@inner
def new_before(s):
    """Zeroed values of a state."""
    r, q = np.zeros(s.r.shape), np.zeros(s.internal.shape)
    return Before(r, r.copy(), r.copy(), np.zeros(s.moment.shape), np.zeros(s.carried.shape), q, q.copy())


@inner
def keep(s, before):
    """Save the state before a step."""
    copy(before.r, s.r)
    copy(before.v, s.v)
    copy(before.a, s.a)
    copy(before.moment, s.moment)
    copy(before.carried, s.carried)
    copy(before.internal, s.internal)
    copy(before.internal_rate, s.internal_rate)


@inner
def restore(s, before):
    """Restore the saved state."""
    copy(s.r, before.r)
    copy(s.v, before.v)
    copy(s.a, before.a)
    copy(s.moment, before.moment)
    copy(s.carried, before.carried)
    copy(s.internal, before.internal)
    copy(s.internal_rate, before.internal_rate)
    know_internal(s)


@inner
def know_internal(s):
    """Keep the internal variables constant: evaluations then do not change them."""
    copy(s.internal_known, s.internal)
    s.internal_share[0] = 0.0


@inner
def release(s):
    """Remove the first-order motion from the top's position, until `move` adds it again."""
    top = s.l0.shape[0]
    for k in range(len(s.dim)):
        s.r[k, top] -= s.carried[0, k]
        s.v[k, top] -= s.carried[1, k]
        s.a[k, top] -= s.carried[2, k]
        for row in range(3):
            s.carried[row, k] = 0.0


@inner
def keep_ends(s, ends):
    """Save the forces of the string alone at its ends to ``ends`` (2, d), before devices are added."""
    n = s.l0.shape[0]
    for k in range(len(s.dim)):
        ends[0, k] = s.force[k, 0]
        ends[1, k] = s.force[k, n]


@inner
def clear(array):
    """Fill a vector with zeros."""
    for i in range(array.shape[0]):
        array[i] = 0.0


@inner
def clear_forces(s):
    """Set the forces to zero before an evaluation."""
    clear(s.loads)


@inner
def clear_tangent(s):
    """Set the stiffness to zero before an evaluation."""
    clear(s.slopes)
