"""The length of implicit time steps: a graded start, and halving of a step that fails."""

from __future__ import annotations

import numpy as np

from riserstudy.solve.evaluate import move
from riserstudy.solve.jit import inner
from riserstudy.solve.newton import NODE, SIZE
from riserstudy.solve.sums import HALVED, fail

LENGTH, DONE_STEPS, LEVEL, LEFT = 0, 1, 2, 3  # entries of a pace


@inner
def elapsed(step, start):
    """Time after a number of steps, in units of the full step.

    A graded start replaces ``start`` steps by ``3 start`` steps of increasing length, because after a jump of
    velocity or acceleration, moments grow like a root of time.
    """
    if step >= 3 * start:
        return float(step - 2 * start)
    share = step / (3.0 * start)
    return start * share * share * share


@inner
def new_pace(method):
    """A pace: length of the next step (s), full steps done, halvings of the present step, its parts left."""
    pace = np.zeros(4)
    pace[LENGTH] = method.step * elapsed(1.0, method.start)
    pace[LEFT] = 1.0
    return pace


@inner
def under_way(pace, method):
    """Whether steps are left."""
    return pace[DONE_STEPS] < method.steps + 2 * method.start


@inner
def advance(s, pace, method, begin):
    """Count a completed part of a step; a completed step sets the clock, without accumulated rounding."""
    pace[LEFT] -= 1.0
    if pace[LEFT] == 0.0:
        pace[DONE_STEPS] += 1.0
        pace[LEVEL], pace[LEFT] = 0.0, 1.0
        done = elapsed(pace[DONE_STEPS], method.start)
        pace[LENGTH] = method.step * (elapsed(pace[DONE_STEPS] + 1.0, method.start) - done)
        s.clock[0] = begin + done * method.step


@inner
def halve(p, s, t, pace, method, memory, sums):
    """Return to the time ``t`` and halve the step; returns False after the largest number of halvings."""
    s.clock[0] = t
    if pace[LEVEL] == method.halvings:
        move(p, s, t)
        fail(sums, t, memory[NODE], memory[SIZE])
        return False
    pace[LEVEL] += 1.0
    pace[LEFT] *= 2.0
    pace[LENGTH] *= 0.5
    sums.count[HALVED] += 1
    return True
