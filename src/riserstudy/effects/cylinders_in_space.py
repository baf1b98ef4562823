r"""Tensioner cylinders in space, between points of the deck and points of the tension ring.

The reach of a cylinder is the distance between its ends, minus its length at mid-stroke. The cylinder pulls
the ring along its axis. The ring rotates with the top of the riser below it. Unequal pulls cause a moment
:math:`m = \sum_c a_c \times F_c` about the centre of the ring, with the lever arm :math:`a_c` and the pull
:math:`F_c` of each cylinder. If the riser has the bending moment M below the ring, the telescopic joint
therefore has the bending moment :math:`M - m` above the ring. The component of m along the axis of the ring
is a torque. The torque has no effect, because the riser is free to twist.

The deck moves with a platform of prescribed motion, or horizontally with a freely floating vessel. A freely
floating vessel is the top node of the riser, and carries the horizontal component of the pulls. The
prescribed motion of a platform is added to the motion of the vessel.

The static stiffness omits the derivative of the moment m, because this derivative is small compared with the
stiffness of the riser. In motion, the derivative is not small. Over a time step h, dampers with the
coefficient c at the radius a resist a rotation of the ring like a spring of about c a^2 / h. In motion, the
tangent matrix therefore includes the derivative of m with respect to the direction of the riser below the
ring, but not the effect of this derivative at the upper end of the telescopic joint.

References
----------
Elementary: force along a line, moment of a force about a point, equilibrium of moments at the ring.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.effects.attitude import turned
from riserstudy.effects.cylinder import probe
from riserstudy.effects.registry import register
from riserstudy.solve.jit import inner
from riserstudy.solve.state import SUPPLIED, VELOCITY, of_pulls


class CylindersInSpace(NamedTuple):
    """Positions of the cylinders; the ring is a node with one segment below and one above it."""

    node: int  # tension ring
    vessel: int  # node of the vessel that the deck moves with, 0 if its motion is prescribed
    # (3,) centre of rotation at rest (m), x and y relative to a vessel if there is one
    centre: np.ndarray
    deck: np.ndarray  # (3, c) deck points relative to that centre (m)
    ring: np.ndarray  # (3, c) ring points from the ring's centre, riser upright (m)
    length: np.ndarray  # (c,) at mid-stroke (m)
    # (2,) rotation of the upper end of the segment below, per moment there and at its far end
    below: np.ndarray
    above: np.ndarray  # (2,) the same of the segment above, at its lower end (rad/(N m))
    work: np.ndarray  # (3, 3) scratch
    base: np.ndarray  # (2, 3) scratch: place and velocity of the vessel


@inner
def place(cylinders, s):
    """Deck points at this time, relative to a vessel if there is one."""
    point, w = s.deck, cylinders.work
    for c in range(cylinders.length.shape[0]):
        for k in range(3):
            w[0, k] = cylinders.deck[k, c]
        turned(s.platform, w[0], w[1], w[2])
        for k in range(3):
            point[0, k, c] = cylinders.centre[k] + s.platform[0, k] + w[0, k]
            point[1, k, c] = s.platform[1, k] + w[1, k]
            point[2, k, c] = s.platform[2, k] + w[2, k]
    return 0.0


@inner
def _lay(s, source, e, into):
    """Convert a vector of the model's directions to x, y, z."""
    d = len(s.dim)
    into[0] = source[0, e] if d > 1 else 0.0
    into[1] = source[1, e] if d > 2 else 0.0
    into[2] = source[d - 1, e]


@inner
def _tilt(cylinders, s, w):
    """Write the direction of the ring's axis, the riser's tangent at its top, to w[0]."""
    d, i = len(s.dim), cylinders.node
    _lay(s, s.tangent, i - 1, w[0])
    own, far = cylinders.below[0], cylinders.below[1]
    m = len(s.dof) - d
    if m == 1:
        bend = own * s.moment[0, i] + far * s.moment[0, i - 1]
        w[0, 0], w[0, 2] = w[0, 0] + bend * w[0, 2], w[0, 2] - bend * w[0, 0]
    if m == 3:
        for k in range(3):
            w[1, k] = own * s.moment[k, i] + far * s.moment[k, i - 1]
        x, y, z = w[0, 0], w[0, 1], w[0, 2]
        w[0, 0] += w[1, 1] * z - w[1, 2] * y
        w[0, 1] += w[1, 2] * x - w[1, 0] * z
        w[0, 2] += w[1, 0] * y - w[1, 1] * x
    size = sqrt(w[0, 0] ** 2 + w[0, 1] ** 2 + w[0, 2] ** 2)
    for k in range(3):
        w[0, k] /= size


@inner
def _base(cylinders, s, into):
    """Position and velocity (x, y, z) of a vessel without first-order motion; zeros without a vessel."""
    i = cylinders.vessel
    for row in range(2):
        for k in range(3):
            into[row, k] = 0.0
    for k in range(len(s.dim) - 1 if i > 0 else 0):
        into[0, k] = s.r[k, i] - s.carried[0, k]
        into[1, k] = s.v[k, i] - s.carried[1, k]


@inner
def drive(cylinders, s):
    """Reach of the cylinders, its rate, and their axes."""
    i, w, arm, line = cylinders.node, cylinders.work, s.arm, s.line
    d, base = len(s.dim), cylinders.base
    _base(cylinders, s, base)
    _tilt(cylinders, s, w)
    tx, ty, tz = w[0, 0], w[0, 1], w[0, 2]
    for c in range(cylinders.length.shape[0]):  # the smallest rotation that takes z into (tx, ty, tz)
        x, y, z = cylinders.ring[0, c], cylinders.ring[1, c], cylinders.ring[2, c]
        turn = (tx * x + ty * y) / (1.0 + tz)
        arm[0, c] = x + tx * z - tx * turn
        arm[1, c] = y + ty * z - ty * turn
        arm[2, c] = tz * z - tx * x - ty * y
    # the ring rotates as the segment below
    _lay(s, s.v, i, w[1])
    _lay(s, s.v, i - 1, w[2])
    rx, ry, rz = 0.0, 0.0, 0.0
    if d > 1:
        inverse = s.inverse_length[i - 1]
        vx, vy, vz = w[1, 0] - w[2, 0], w[1, 1] - w[2, 1], w[1, 2] - w[2, 2]
        rx, ry, rz = (
            inverse * (ty * vz - tz * vy),
            inverse * (tz * vx - tx * vz),
            inverse * (tx * vy - ty * vx),
        )
    _lay(s, s.r, i, w[2])
    for c in range(cylinders.length.shape[0]):
        square = 0.0
        for k in range(3):
            line[k, c] = s.deck[0, k, c] + base[0, k] - w[2, k] - arm[k, c]
            square += line[k, c] ** 2
        s.distance[c] = sqrt(square)
        s.reach[c] = s.distance[c] - cylinders.length[c]
        ax, ay, az = arm[0, c], arm[1, c], arm[2, c]
        w[0, 0], w[0, 1], w[0, 2] = ry * az - rz * ay, rz * ax - rx * az, rx * ay - ry * ax
        s.reach_rate[c] = 0.0
        for k in range(3):
            line[k, c] /= s.distance[c]
            rate = s.deck[1, k, c] + base[1, k] - w[1, k] - w[0, k]
            s.reach_rate[c] += line[k, c] * rate
    return 0.0


@inner
def turn(cylinders, s):
    """The moment of the pulls about the ring's centre, and the angles that it adds in the joint above."""
    arm, line, moment = s.arm, s.line, s.ring_moment
    moment[:] = 0.0
    for c in range(cylinders.length.shape[0]):
        pull = s.pull[c]
        moment[0] += pull * (arm[1, c] * line[2, c] - arm[2, c] * line[1, c])
        moment[1] += pull * (arm[2, c] * line[0, c] - arm[0, c] * line[2, c])
        moment[2] += pull * (arm[0, c] * line[1, c] - arm[1, c] * line[0, c])
    m, i = len(s.dof) - len(s.dim), cylinders.node
    if m == 3 and i > 0:  # torsion is free: a torque about the ring's axis has no effect
        tx, ty, tz = s.tangent[0, i - 1], s.tangent[1, i - 1], s.tangent[2, i - 1]
        torque = tx * moment[0] + ty * moment[1] + tz * moment[2]
        moment[0] -= torque * tx
        moment[1] -= torque * ty
        moment[2] -= torque * tz
    if i == s.length.shape[0]:  # no joint above, and no moment
        return 0.0
    for u in range(m):
        about = of_pulls(s, u)
        s.turn[u, i] += cylinders.above[0] * about
        s.turn[u, i + 1] += cylinders.above[1] * about
    return 0.0


@inner
def shear(s, e):
    """Shear (x, y, z) that the moment of the pulls adds at the upper end of the joint, segment e."""
    d, m, inverse = len(s.dim), s.ring_moment, s.inverse_length[e]
    tx, ty, tz = s.tangent[0, e], s.tangent[1, e] if d > 2 else 0.0, s.tangent[d - 1, e]
    return (
        inverse * (m[1] * tz - m[2] * ty),
        inverse * (m[2] * tx - m[0] * tz),
        inverse * (m[0] * ty - m[1] * tx),
    )


@inner
def force(cylinders, s):
    """The pulls on the ring, and the shear that their moment adds in the joint above."""
    d, i = len(s.dim), cylinders.node
    for c in range(cylinders.length.shape[0]):
        for k in range(d):
            axis = 2 if k == d - 1 else k
            s.force[k, i] += s.pull[c] * s.line[axis, c]
            if cylinders.vessel > 0 and k < d - 1:
                s.force[k, cylinders.vessel] -= s.pull[c] * s.line[axis, c]
    if len(s.dof) > d and i < s.length.shape[0]:
        fx, fy, fz = shear(s, i)
        for k in range(d):
            f = fz if k == d - 1 else (fx if k == 0 else fy)
            s.force[k, i] -= f
            s.force[k, i + 1] += f
    return 0.0


@inner
def tangent(cylinders, s):
    """Stiffness of all cylinders at the ring, and between the ring and a vessel above it."""
    d, i, vessel = len(s.dim), cylinders.node, cylinders.vessel
    for c in range(cylinders.length.shape[0]):
        across = s.pull[c] / s.distance[c]
        for p in range(d):
            lp = s.line[2 if p == d - 1 else p, c]
            for q in range(d):
                lq = s.line[2 if q == d - 1 else q, c]
                stiff = (s.k_pull[c] - across) * lp * lq
                if p == q:
                    stiff += across
                if (
                    vessel != i or p == q == d - 1
                ):  # a ring on the vessel moves only vertically relative to it
                    s.k_node[i, p * d + q] += stiff
                if vessel == i + 1:
                    if q < d - 1:
                        s.k_up[i, p * d + q] -= stiff
                    if p < d - 1:
                        s.k_low[i, p * d + q] -= stiff
                    if p < d - 1 and q < d - 1:
                        s.k_node[vessel, p * d + q] += stiff
    if len(s.dof) > d and 0 < i < s.length.shape[0] and s.rate[VELOCITY] > 0.0:
        for c in range(cylinders.length.shape[0]):
            _turning(cylinders, s, c)
    return 0.0


@inner
def _turning(cylinders, s, c):
    """Derivative of the moment of a cylinder by the chord of the segment below the ring."""
    d, i, w, arm, line = len(s.dim), cylinders.node, cylinders.work, s.arm, s.line
    m = len(s.dof) - d
    _lay(s, s.tangent, i - 1, w[0])
    tx, ty, tz = w[0, 0], w[0, 1], w[0, 2]
    gx = arm[1, c] * line[2, c] - arm[2, c] * line[1, c]
    gy = arm[2, c] * line[0, c] - arm[0, c] * line[2, c]
    gz = arm[0, c] * line[1, c] - arm[1, c] * line[0, c]
    torque = tx * gx + ty * gy + tz * gz if m == 3 else 0.0
    gx, gy, gz = gx - torque * tx, gy - torque * ty, gz - torque * tz
    stiff = -s.k_pull[c] * s.inverse_length[i - 1]
    w[1, 0], w[1, 1], w[1, 2] = gx, gy, gz
    w[2, 0], w[2, 1], w[2, 2] = gy * tz - gz * ty, gz * tx - gx * tz, gx * ty - gy * tx
    for u in range(m):
        about = w[1, u] if m == 3 else w[1, 1]
        for p in range(d):
            by = w[2, 2 if p == d - 1 else p]
            s.turn_up[i - 1, p * m + u] += cylinders.above[0] * stiff * about * by
    _lay(s, s.tangent, i, w[0])
    tx, ty, tz = w[0, 0], w[0, 1], w[0, 2]
    w[1, 0], w[1, 1], w[1, 2] = gy * tz - gz * ty, gz * tx - gx * tz, gx * ty - gy * tx
    for p in range(d):
        for q in range(d):
            by = stiff * w[2, 2 if q == d - 1 else q]
            part = s.inverse_length[i] * w[1, 2 if p == d - 1 else p] * by
            s.k_node[i, p * d + q] += part
            s.k_low[i - 1, p * d + q] -= part


@inner
def energy(cylinders, s):
    """Correction of the strain energy of the joint above (J), which bends under M - m instead of M."""
    total = 0.0
    m, i = len(s.dof) - len(s.dim), cylinders.node
    if i == s.length.shape[0]:
        return 0.0
    for u in range(m):
        about = of_pulls(s, u)
        total += cylinders.above[0] * about * (0.5 * about - s.moment[u, i])
        total -= cylinders.above[1] * about * s.moment[u, i + 1]
    return total


@inner
def power(cylinders, s):
    """Power that the prescribed motion of the platform supplies through the cylinders (W).

    A vessel transfers the pull on its deck to the riser's top, which is its node.
    """
    for c in range(cylinders.length.shape[0]):
        for k in range(3):
            speed = s.deck[1, k, c]
            if cylinders.vessel > 0 and k < len(s.dim) - 1:
                speed -= s.carried[1, k]
            s.flow[SUPPLIED] += s.pull[c] * s.line[k, c] * speed
    return 0.0


register(
    CylindersInSpace,
    "tensioner cylinders",
    place=place,
    drive=drive,
    turn=turn,
    device=force,
    tangent=tangent,
    potential=energy,
    power=power,
    probe=probe,
)
