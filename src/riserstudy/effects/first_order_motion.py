r"""First-order (wave-frequency) motion of a freely floating platform, added to its slow drift.

.. math:: x = X(t) + \xi(t),\qquad \xi = \eta + R(\varphi)\,a - a

The position x is the position of the riser's top. X is the low-frequency position of the vessel, an unknown.
The prescribed motions are the displacement :math:`\eta` and the rotation :math:`\varphi`. The vector a points
from the centre of rotation, which drifts with X, to the riser's top. The effects `vessel` and `thrusters`
depend on X alone: inertia, drag and control of the hull do not respond to the first-order motions, which the
RAOs or the scene prescribe.

The position of the riser's top contains both motions. This effect stores :math:`\xi` with its derivatives in
``State.carried``, and changes the position by the change of :math:`\xi`. The solvers integrate X.

References
----------
Elementary: superposition of the first-order motion and of the slow drift of a moored or drifting vessel.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.attitude import turned
from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner


class FirstOrderMotion(NamedTuple):
    """First-order motion of the riser's top, in addition to the motion of the vessel."""

    node: int  # the riser's top
    free: int  # horizontal directions in which the vessel is free to move, 1 or 2
    rest: np.ndarray  # (2,) the vessel at rest, in x and y (m)
    arm: np.ndarray  # (3,) from the platform's centre of rotation (m)
    point: np.ndarray  # (3, 3) scratch: arm turned, its velocity and acceleration
    probe: int  # first of its probes


@inner
def place(motion, s):
    """Replace the previous first-order motion in the top's position by the present one."""
    i, point = motion.node, motion.point
    for c in range(3):
        point[0, c] = motion.arm[c]
    turned(s.platform, point[0], point[1], point[2])
    for k in range(len(s.dim) - 1):
        point[0, k] -= motion.arm[k]
        for row in range(3):
            point[row, k] += s.platform[row, k]
        if k < motion.free:
            s.r[k, i] += point[0, k] - s.carried[0, k]
            s.v[k, i] += point[1, k] - s.carried[1, k]
            s.a[k, i] += point[2, k] - s.carried[2, k]
        for row in range(3):
            s.carried[row, k] = point[row, k]
    return 0.0


@inner
def probe(motion, s):
    """Report the low-frequency displacement and speed of the vessel, by direction."""
    for k in range(motion.free):
        s.probe[motion.probe + 2 * k] = s.r[k, motion.node] - s.carried[0, k] - motion.rest[k]
        s.probe[motion.probe + 2 * k + 1] = s.v[k, motion.node] - s.carried[1, k]
    return 0.0


register(FirstOrderMotion, Called("first-order motion", "vessel, and a platform"), place=place, probe=probe)
