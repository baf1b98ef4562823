"""The effect that probably caused a failure, from the forces of each effect alone at one node."""

from __future__ import annotations

import math

import numpy as np

from riserstudy.effects.registry import ROLES
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.model.stops import MEET
from riserstudy.records.numerals import newtons, plain
from riserstudy.solve.evaluate import force_of, shape_of
from riserstudy.solve.program import assemble
from riserstudy.solve.sums import EVALUATIONS, Sums


def suspect(model: Model, node: int) -> str:
    """Name of the effect with the largest, or an undefined, force at a node."""
    worst, name = -1.0, "none"
    state = model.s
    for effect, record in zip(model.effects, model.records, strict=True):
        roles = ROLES[type(effect.record)]
        call = roles.get("string") or roles.get("law") or roles.get("device")
        if call is None:
            continue
        shape_of(model.programs, model.state)
        state.pull[:] = 0.0  # only the pull of this effect
        force_of(assemble([(call, record)], model.state), model.state)
        size = float(np.abs(state.force[:, node]).max() + np.abs(state.pull).sum())
        if not size <= worst:
            worst, name = size, f"{effect.name} ({newtons(size)})"
        if not np.isfinite(size):
            return f"{effect.name} (undefined)"
    return name


def why(model: Model, mesh: Mesh, sums: Sums) -> str:
    """The message about a failed time step: time, node, effect and remedy."""
    time, node, size = sums.failure
    how = "Newton's iteration did not converge even after halving the step"
    if sums.count[EVALUATIONS]:
        how = "velocities grow without bound"
    last = f"was {plain(size)} m" if math.isfinite(size) else "was undefined"
    short = collapsed(model, mesh)  # before the forces of one effect alone
    return (
        f"the run stopped at t = {time:.6g} s at node {int(node)} (s = {mesh.s[int(node)]:.4g} m): {how}; "
        f"the last correction {last}, the largest force at this node comes from "
        f"{suspect(model, int(node))}. {short}Use a smaller time step, give sudden motions a ramp, or check "
        "stroke and tension"
    )


def collapsed(model: Model, mesh: Mesh) -> str:
    """A sentence about a telescopic joint that is far shorter than its length; else empty."""
    if not mesh.joint:
        return ""
    shape_of(model.programs, model.state)  # of the last completed step
    length, drawn = float(mesh.l0[-1]), float(model.s.length[-1])
    if drawn > MEET * length:
        return ""
    return (
        f"The telescopic joint is compressed from {length:.3g} m to {drawn:.3g} m: give "
        "top.telescopic_joint.stop with a collapse. "
    )
