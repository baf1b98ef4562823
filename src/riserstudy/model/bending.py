"""Bending of the string, and the joints and clamps that hold the direction of its ends."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.bending import Bending
from riserstudy.effects.bending_damping import BendingDamping
from riserstudy.effects.bending_in_space import SpatialBending
from riserstudy.effects.flex_joint import FlexJoint
from riserstudy.effects.foreshortening import Foreshortening
from riserstudy.model.layout import Layout, flexibility_of
from riserstudy.model.model import Effect
from riserstudy.solve.state import OTHER, OWN


def flexibility(of: Layout) -> NDArray[np.float64]:
    """Flexibility l/EI of each segment, (n,), rad/(N m)."""
    joint = of.scene.top.telescopic_joint
    stiff = joint.bending_stiffness if joint else 0.0
    return of.mesh.l0 / of.per_segment(lambda k: of.sections[k].bending, stiff)


def shared_flexibility(of: Layout) -> NDArray[np.float64]:
    """Rotation of a segment's end per moment at this end and per moment at the far end, (n, 2), rad/(N m).

    The moment is a parabola over three nodes; it is linear in segments next to a corner or to a held end.
    """
    own, other = np.full(of.last, OWN), np.full(of.last, OTHER)
    straight = [0] if flexibility_of(of.scene.bottom.rotation) is not None else []
    straight += [-1] if flexibility_of(of.scene.top.rotation) is not None else []
    straight += [-1, -2] if of.scene.top.telescopic_joint else []  # the moment has a corner at the ring
    for k in of.cornered:
        straight += [of.mesh.foot(k) - 1, of.mesh.foot(k)]
    own[straight], other[straight] = 1.0 / 3.0, 1.0 / 6.0
    return np.stack([own, other], axis=1) * flexibility(of)[:, None]


def bending(of: Layout, relaxation: float) -> Iterator[Effect]:
    """Bending, its damping with the relaxation time (s) of structural damping, and the end joints."""
    why = "riser.young_modulus or bending_stiffness"
    own, other = shared_flexibility(of).T
    flex = np.zeros(of.last + 1)
    flex[:-1] += own
    flex[1:] += own
    record: Any = (Bending if of.m == 1 else SpatialBending)(flex, other.copy())
    yield Effect("bending", record, why)
    yield Effect("foreshortening", Foreshortening(of.axial * flexibility(of) ** 2 / 72.0), why)
    joints = list(_end_joints(of))
    if relaxation:
        pipe = flex.copy()
        pipe[:-1] += other
        pipe[1:] += other
        yield _damping(of, relaxation, pipe, [joint.record for joint in joints])
    yield from joints


def _damping(of: Layout, relaxation: float, pipe: NDArray[np.float64], joints: list[Any]) -> Effect:
    """Damping of the pipe, but not of its joints.

    ``relaxation``: relaxation time (s); ``pipe``: angle at each node due to equal moments at it and at its
    neighbours, (n + 1,), rad/(N m); ``joints``: records of the joints and clamps at the ends.
    """
    soft, free = np.zeros(of.last + 1), np.zeros((3, 3))
    held = {0: free, of.last: free}
    for joint in joints:
        soft[joint.node] = joint.flex
        held[joint.node] = joint.held
    for k, section in enumerate(of.scene.riser):
        if section.flex_joint_below:
            soft[of.mesh.foot(k)] = 1.0 / section.flex_joint_below.stiffness
    time = relaxation * pipe / (pipe + soft)
    scratch = np.zeros((2, of.m, of.last + 1))
    record = BendingDamping(time, held[0], held[of.last], *scratch)
    return Effect("bending damping", record, "riser.structural_damping")


def _end_joints(of: Layout) -> Iterator[Effect]:
    bottom, top = of.scene.bottom, of.scene.top
    for node, end, name in ((0, bottom, "bottom"), (of.last, top, "top")):
        soft = flexibility_of(end.rotation)
        if soft is None:
            continue
        follows = end is top and of.scene.platform is not None and top.x in ("platform", "vessel")
        upwards = np.array([0.0, 0.0, 1.0])
        held = np.stack([upwards, *np.zeros((2, 3))])
        record = FlexJoint(node, soft, upwards, int(follows), held)
        yield Effect("flex joint" if soft > 0.0 else "clamp", record, f"{name}.rotation")
