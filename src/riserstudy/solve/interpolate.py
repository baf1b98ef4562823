"""States between two time steps: positions by a cubic through both, forces by a parabola through three steps.

An interpolated state is not in equilibrium: forces computed from it would be interpolation errors.
"""

from __future__ import annotations

from riserstudy.solve.envelopes import UNEVEN
from riserstudy.solve.jit import inner
from riserstudy.solve.state import know_internal
from riserstudy.solve.tabulate import sizes


@inner
def interpolate(so, before, t0, after, t1, time):
    """Cubic interpolation of positions between two steps; velocity is its derivative.

    ``before``, ``after``: r, v and a at the times t0 and t1 (s). ``so``: the state at ``time``.
    """
    h = t1 - t0
    x = (time - t0) / h
    for k in range(len(so.dim)):
        for i in range(so.r.shape[1]):
            d = after.r[k, i] - before.r[k, i]
            slope, twist = h * before.v[k, i] - d, d - h * after.v[k, i]
            bump = slope * (1.0 - x) + twist * x
            so.r[k, i] = before.r[k, i] + x * d + x * (1.0 - x) * bump
            so.v[k, i] = (d + (1.0 - 2.0 * x) * bump + x * (1.0 - x) * (twist - slope)) / h
            so.a[k, i] = (1.0 - x) * before.a[k, i] + x * after.a[k, i]


@inner
def interpolate_carried(s, carried0, t0, carried1, t1, time):
    """The same for first-order motion; the top without this motion is then on a cubic, too."""
    h = t1 - t0
    x = (time - t0) / h
    for k in range(len(s.dim)):
        d = carried1[0, k] - carried0[0, k]
        slope, twist = h * carried0[1, k] - d, d - h * carried1[1, k]
        bump = slope * (1.0 - x) + twist * x
        s.carried[0, k] = carried0[0, k] + x * d + x * (1.0 - x) * bump
        s.carried[1, k] = (d + (1.0 - 2.0 * x) * bump + x * (1.0 - x) * (twist - slope)) / h
        s.carried[2, k] = (1.0 - x) * carried0[2, k] + x * carried1[2, k]


@inner
def interpolate_internal(so, before, t0, s, t1, time):
    """The same for internal variables, by their rates."""
    h = t1 - t0
    x = (time - t0) / h
    for k in range(s.internal.shape[0]):
        for i in range(s.internal.shape[1]):
            d = s.internal[k, i] - before.internal[k, i]
            slope = h * before.internal_rate[k, i] - d
            twist = d - h * s.internal_rate[k, i]
            bump = slope * (1.0 - x) + twist * x
            so.internal[k, i] = before.internal[k, i] + x * d + x * (1.0 - x) * bump
    know_internal(so)


@inner
def forces_of_steps(s, record, time):
    """Forces at a time within the last step: parabola through three steps, or linear after the first step."""
    d, values, past, when = len(s.dim), record.values, record.past, record.when
    x = (time - when[1]) / (when[2] - when[1])
    bend = 0.0
    if record.seen[0] >= 2 and when[2] - when[1] < UNEVEN * (when[1] - when[0]):
        bend = (time - when[1]) * (time - when[2]) / (when[2] - when[0])
    for c in range(d, values.shape[0]):
        for i in range(values.shape[1]):
            rise = values[c, i] - past[1, c, i]
            value = past[1, c, i] + x * rise
            if bend != 0.0:
                slope, before = rise / (when[2] - when[1]), past[1, c, i] - past[0, c, i]
                value += bend * (slope - before / (when[1] - when[0]))
            record.between[c, i] = value
    if len(s.dof) - d == 3:
        sizes(record.between, d, record.largest.shape[0])
