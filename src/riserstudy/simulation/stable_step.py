"""The longest stable time step of the explicit method, for all positions of the platform."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.model import Model
from riserstudy.scene.resolve import Resolved
from riserstudy.solve.evaluate import move_to, shape_of
from riserstudy.solve.modes import stable_step

INSTANTS = 16  # number of times in the period of each harmonic motion at which strokes are sampled
SAMPLES = 2000  # smallest number of times in a run at which strokes are sampled
APART = 0.5  # longest interval between them (s)


def explicit_limit(scene: Resolved, model: Model) -> float:
    """Stable explicit step (s): the shortest of the limits at the extreme strokes of all cylinders.

    Gas and end stops are stiffest there. The riser is kept at rest, although it would follow the platform;
    the stroke is therefore rather too large than too small. The motion of a `vessel` is unknown before the
    run: its riser has the limit at rest.
    """
    state = model.s
    limit = float(stable_step(model.programs, model.state, model.fixed))
    if scene.top.tensioners is None or scene.platform is None:
        return limit
    kept = [array.copy() for array in (state.r, state.v, state.a)]
    times = _sampled_times(scene)
    strokes = np.zeros((len(times), scene.top.tensioners.count))
    for k, time in enumerate(times):
        _move_platform(model, time, kept[0])
        shape_of(model.programs, model.state)
        strokes[k] = state.reach[: strokes.shape[1]]
    for k in {*map(int, strokes.argmin(axis=0)), *map(int, strokes.argmax(axis=0))}:
        _move_platform(model, times[k], kept[0])
        longest = float(stable_step(model.programs, model.state, model.fixed))
        limit = min(limit, longest) if math.isfinite(longest) else limit
    move_to(model.programs, model.state, 0.0)
    for array, values in zip((state.r, state.v, state.a), kept, strict=True):
        np.copyto(array, values)
    return limit


def _move_platform(model: Model, time: float, positions: NDArray[np.float64]) -> None:
    """Put the platform where it is at a time (s), and keep the riser at rest at positions (m)."""
    move_to(model.programs, model.state, time)
    model.s.r[:], model.s.v[:] = positions, 0.0


def _sampled_times(scene: Resolved) -> NDArray[np.float64]:
    """Times (s) of the run, and in the period of each harmonic motion after the ramps, in order."""
    motions = [motion for _, motion in scene.platform.harmonics] if scene.platform else []
    ramp = max([motion.ramp or 0.0 for motion in motions], default=0.0)
    phases = [ramp + motion.period * k / INSTANTS for motion in motions for k in range(INSTANTS)]
    duration = scene.analysis.duration or 0.0
    times = np.linspace(0.0, duration, max(SAMPLES, math.ceil(duration / APART)))
    return np.unique([*times, *phases])
