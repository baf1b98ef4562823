r"""A flex joint between two sections of the riser.

.. math:: \alpha_{above} - \alpha_{below} = M / K

The angles are the angles of the riser just above and just below the joint, M is the bending moment, and K is
the stiffness of the joint. Because moments are unknowns of the solver, the model represents the joint by an
additional flexibility 1/K of its node.

References
----------
Elementary: Hooke's law of a rotational spring, as a flexibility.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner


class InnerFlexJoint(NamedTuple):
    """One joint within the riser."""

    node: int
    flex: float  # 1/K (rad/(N m))
    probe: int  # probe of the angle; in space, the rotations about x, y and z are the next ones


@inner
def _square(joint, s):
    total = 0.0
    for u in range(len(s.dof) - len(s.dim)):
        total += s.moment[u, joint.node] ** 2
    return total


@inner
def compliance(joint, s):
    """Add the flexibility of the joint."""
    s.flex[joint.node] += joint.flex
    return 0.0


@inner
def energy(joint, s):
    """Energy in the joint's spring (J)."""
    return 0.5 * joint.flex * _square(joint, s)


@inner
def probe(joint, s):
    """Report the angle (rad): in a plane, positive towards +x; in space, its magnitude and the rotation."""
    moment = s.moment[0, joint.node] if len(s.dim) == 2 else sqrt(_square(joint, s))
    s.probe[joint.probe] = joint.flex * moment
    if len(s.dim) == 3:
        for u in range(len(s.dof) - len(s.dim)):
            s.probe[joint.probe + 1 + u] = joint.flex * s.moment[u, joint.node]
    return 0.0


register(
    InnerFlexJoint,
    Called("inner flex joint", "riser.flex_joint_below"),
    compliance=compliance,
    potential=energy,
    probe=probe,
)
