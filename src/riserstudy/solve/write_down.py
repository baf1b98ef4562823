"""Writes outputs, and the ends at each step, to a record during a simulation."""

from __future__ import annotations

from math import sqrt

from riserstudy.solve.envelopes import first_output, widen, widen_places
from riserstudy.solve.evaluate import inertia, load, move, shape, true_moments
from riserstudy.solve.interpolate import (
    forces_of_steps,
    interpolate,
    interpolate_carried,
    interpolate_internal,
)
from riserstudy.solve.jit import inner, kernel
from riserstudy.solve.program import call_all
from riserstudy.solve.state import of_pulls
from riserstudy.solve.tabulate import components, tabulate

ROUNDING = 1e-10  # of a time (s)


@inner
def remember(record):
    """Shift the stored steps: the last step becomes the previous one."""
    values, past, when = record.values, record.past, record.when
    for c in range(values.shape[0]):
        for i in range(values.shape[1]):
            past[0, c, i] = past[1, c, i]
            past[1, c, i] = values[c, i]
    when[0], when[1] = when[1], when[2]
    record.seen[0] += 1


@inner
def note(p, s, record, values):
    """Write tabulated values as the next output."""
    k = record.written[0]
    record.written[0] += 1
    d = len(s.dim)
    m = len(s.dof) - d
    call_all(p.probe, s)
    for j in range(record.station.shape[0]):
        i = record.station[j]
        for c in range(d + 1 + min(m, 1)):
            record.history[k, c, j] = values[c, i]
        if m == 3:
            for u in range(3):
                row = components(record.largest.shape[0], 0, u)
                record.history[k, d + 2 + u, j] = values[row, i]
    ends(s, k, record.end, record.top, record.platform, record.probe)


@inner
def ends(s, k, end, top, platform, probe):
    """Write ends, platform and reported values of devices to row k."""
    d, n = len(s.dim), s.l0.shape[0]
    m = len(s.dof) - d
    for c in range(d):
        end[k, 0, c] = s.tangent[c, 0]
        end[k, 1, c] = s.tangent[c, n - 1]
        top[k, c] = s.r[c, n]
    if m == 0:
        string_ends(s, k, end)
    for u in range(m):
        end[k, 0, d + u], end[k, 0, d + m + u] = s.moment[u, 0], s.moment[u, 1]
        # a telescopic joint begins with the ring's moment minus the moment of the cylinders
        end[k, 1, d + u] = s.moment[u, n]
        end[k, 1, d + m + u] = s.moment[u, n - 1] - of_pulls(s, u)
    end[k, 0, d + 2 * m], end[k, 1, d + 2 * m] = s.length[0], s.length[n - 1]
    for c in range(6):
        platform[k, c] = s.platform[0, c]
    for c in range(s.probe.shape[0]):
        probe[k, c] = s.probe[c]


@inner
def string_ends(s, k, end):
    """Directions of a string at its ends: the directions of the forces that hold it there.

    The direction of an end segment is that of its middle; as an end direction it has a first-order error.
    """
    d, n = len(s.dim), s.l0.shape[0]
    for side in range(2):
        sign, e = (1.0, 0) if side == 0 else (-1.0, n - 1)
        square, along = 0.0, 0.0
        for c in range(d):
            force = sign * (s.ends[0, side, c] + s.ends[1, side, c])
            square += force * force
            along += force * s.tangent[c, e]
        size = sqrt(square)
        if along > 0.9 * size:  # otherwise the string is slack, and the force gives no direction
            for c in range(d):
                force = sign * (s.ends[0, side, c] + s.ends[1, side, c])
                end[k, side, c] = force / size


@inner
def note_ends(p, s, record, time):
    """Write the ends of a step if there is room for them."""
    k = record.steps[0]
    if record.step_time.shape[0] == 0:
        return
    record.steps[0] += 1
    if k < record.step_time.shape[0]:
        call_all(p.probe, s)
        record.step_time[k] = time
        ends(s, k, record.step_end, record.step_top, record.step_platform, record.step_probe)


@inner
def due(record, time):
    """Whether the next output is due before a time."""
    k = record.written[0]
    return k < record.time.shape[0] and record.time[k] < time


@inner
def evaluate_and_note(p, s, record):
    """Evaluate and write the next output, of a state with positions, velocities and true accelerations."""
    move(p, s, record.time[record.written[0]])
    evaluate(p, s, record, record.values)
    note(p, s, record, record.values)


@inner
def evaluate(p, s, record, values):
    """Evaluate the forces of the present state, and tabulate them."""
    shape(p, s)
    true_moments(s)
    load(p, s)
    inertia(p, s)
    tabulate(s, record, values)


@kernel
def evaluate_once(p, s, record):
    """Tabulate and write the present state, for callers in Python."""
    evaluate(p, s, record, record.values)
    note(p, s, record, record.values)


@inner
def between(p, s, so, before, t, h, record):
    """Write the outputs due within a step from t to t + h; ``s`` is at t + h and is tabulated.

    ``so`` is a second state of the same model, which receives the interpolated positions.
    """
    while due(record, t + h * (1.0 - 1e-9)):
        time = record.time[record.written[0]]
        x = (time - t) / h
        move(p, so, time)
        interpolate(so, before, t, s, t + h, time)  # held nodes, too, as in `widen_places`
        interpolate_carried(so, before.carried, t, s.carried, t + h, time)
        interpolate_internal(so, before, t, s, t + h, time)
        for u in range(len(s.dof) - len(s.dim)):
            for i in range(s.l0.shape[0] + 1):
                so.moment[u, i] = (1.0 - x) * before.moment[u, i] + x * s.moment[u, i]
        evaluate(p, so, record, record.between)
        forces_of_steps(s, record, time)
        note(p, so, record, record.between)
        if record.written[0] == 1:  # envelopes start with the first output, not with the step after it
            first_output(record)


@inner
def note_start(p, s, record, t):
    """Write the initial state of a march, unless it continues from recorded steps.

    The state just after an event is not written, because the response of a mesh to a jump of acceleration is
    not physical.
    """
    if record.seen[0] > 0:
        return
    record.when[2] = t
    tabulate(s, record, record.values)
    if t >= record.time[0] - ROUNDING:
        widen(record, len(s.dim))
        note_ends(p, s, record, t)
    if due(record, t + ROUNDING):
        note(p, s, record, record.values)
    remember(record)


@inner
def note_step(p, s, so, before, t, h, record):
    """Write a step from t to t + h; ``s`` is evaluated at t + h."""
    record.when[2] = t + h
    tabulate(s, record, record.values)
    between(p, s, so, before, t, h, record)
    if t + h >= record.time[0] - ROUNDING:  # envelopes start with the outputs
        widen(record, len(s.dim))
        widen_places(s, before.r, before.v, t, h, record)
        note_ends(p, s, record, t + h)
    if due(record, t + h * (1.0 + 1e-9)):
        note(p, s, record, record.values)
    remember(record)
