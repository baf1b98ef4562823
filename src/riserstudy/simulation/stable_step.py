"""The longest stable time step of the explicit method, for all positions of the platform."""

from __future__ import annotations

import math

import numpy as np

from riserstudy.model.model import Model
from riserstudy.scene.resolve import Resolved
from riserstudy.solve.evaluate import move_to
from riserstudy.solve.modes import stable_step

INSTANTS = 16  # number of times in the period of each motion at which platform positions are examined


def explicit_limit(scene: Resolved, model: Model) -> float:
    """Stable explicit step (s): the shortest of the limits at all positions of the platform.

    Gas and end stops are stiffest where the platform is lowest. The riser is kept at rest, although it would
    follow the platform; the stroke is therefore rather too large than too small.
    """
    state = model.s
    limit = float(stable_step(model.programs, model.state, model.fixed))
    platform = scene.platform
    if scene.top.tensioners is None or platform is None:
        return limit
    periods = [motion.period for _, motion in platform.harmonics]
    ramps = [motion.ramp or 0.0 for _, motion in platform.harmonics]
    if not periods:
        return limit
    kept = [array.copy() for array in (state.r, state.v, state.a)]
    # at times in the longest period alone, a motion of a sixteenth of it would always be at one phase
    for after in sorted({period * k / INSTANTS for period in periods for k in range(INSTANTS)}):
        move_to(model.programs, model.state, max(ramps) + after)
        state.r[:], state.v[:] = kept[0], 0.0
        longest = float(stable_step(model.programs, model.state, model.fixed))
        limit = min(limit, longest) if math.isfinite(longest) else limit
    move_to(model.programs, model.state, 0.0)
    for array, values in zip((state.r, state.v, state.a), kept, strict=True):
        np.copyto(array, values)
    return limit
