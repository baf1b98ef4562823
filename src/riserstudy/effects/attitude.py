r"""Positions of points on a rotated platform.

The platform rotates first by roll about x, then by pitch about y, then by yaw about z. A positive pitch leans
the vertical axis of the platform towards +x. A point or direction ``a`` that is fixed to the platform has,
after these rotations, the position or direction

.. math:: p = R_z(\psi)\,R_y(\theta)\,R_x(\varphi)\,a

This file also computes the velocity and the acceleration of p.
"""

from __future__ import annotations

from math import cos, sin

from riserstudy.solve.jit import inner


@inner
def _about(k, angle, rate, bend, p, v, a):
    """Rotate a moving vector (position p, velocity v, acceleration a) about axis k by a moving angle."""
    i, j = (k + 1) % 3, (k + 2) % 3
    c, s = cos(angle), sin(angle)
    pi, pj = c * p[i] - s * p[j], s * p[i] + c * p[j]
    vi, vj = c * v[i] - s * v[j], s * v[i] + c * v[j]
    ai, aj = c * a[i] - s * a[j], s * a[i] + c * a[j]
    a[i] = ai - 2.0 * rate * vj - bend * pj - rate * rate * pi
    a[j] = aj + 2.0 * rate * vi + bend * pi - rate * rate * pj
    v[i], v[j] = vi - rate * pj, vj + rate * pi
    p[i], p[j] = pi, pj


@inner
def turned(platform, p, v, a):
    """Rotate a vector fixed to the platform, (3,), in place; its velocity and acceleration go to v and a."""
    for k in range(3):
        v[k], a[k] = 0.0, 0.0
    for k in range(3):
        angle, rate, bend = platform[0, 3 + k], platform[1, 3 + k], platform[2, 3 + k]
        if angle != 0.0 or rate != 0.0 or bend != 0.0:
            _about(k, angle, rate, bend, p, v, a)
