"""The length of implicit steps: a graded start, and halving of a step that fails."""

from __future__ import annotations

import numpy as np

from riserstudy.solve.evaluate import move
from riserstudy.solve.jit import inner
from riserstudy.solve.newton import NODE, SIZE
from riserstudy.solve.sums import HALVED, fail

LENGTH, DONE_STEPS, LEVEL, LEFT = 0, 1, 2, 3  # what a pace holds


@inner
def elapsed(step, start):
    """Time after so many steps, in steps.

    A graded start takes ``3 start`` steps over ``start``, ever longer ones: a motion that begins with
    a jolt has moments that grow like a root of time.
    """
    if step >= 3 * start:
        return float(step - 2 * start)
    share = step / (3.0 * start)
    return start * share * share * share


@inner
def new_pace(method):
    """Length of the next step (s), full steps done, halvings of this one, parts of it left."""
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
    """Count a part of a step that was made; a whole one sets the clock, free of rounding."""
    pace[LEFT] -= 1.0
    if pace[LEFT] == 0.0:
        pace[DONE_STEPS] += 1.0
        pace[LEVEL], pace[LEFT] = 0.0, 1.0
        done = elapsed(pace[DONE_STEPS], method.start)
        pace[LENGTH] = method.step * (elapsed(pace[DONE_STEPS] + 1.0, method.start) - done)
        s.clock[0] = begin + done * method.step


@inner
def halve(p, s, t, pace, method, memory, sums):
    """Go back to the time ``t`` and halve the step; returns False where it was halved often enough."""
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
