"""Vortex lift: a case, the plain version, and drag turned aside.

tests/effects/test_vortex_lift.py has closed forms of a rigid cylinder, and its equations solved by others.
"""

from __future__ import annotations

import numpy as np
from plain import across, at_nodes, spread
from scipy.optimize import brentq
from surroundings import SEGMENTS, Case, N, sheared

from riserstudy.effects.drag import Drag
from riserstudy.effects.vortex_lift import VortexLift
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.solve.evaluate import one_call, shape_of

SHED = np.array([0.18, 0.07, 0.08, 20.0])
DIAMETERS = np.append(np.linspace(0.4, 0.6, N), 0.0)  # nothing is shed at the last node


def past(s, tangent=None):
    """Velocity past the pipe, its size, and the unit vector across both, at the nodes."""
    t = at_nodes(s) if tangent is None else tangent
    u = across(s.water - s.v, t)
    return u, np.sqrt((u**2).sum(axis=0)), np.cross(t, u, axis=0)


def vortex_lift(record, s, tangent=None):
    """Lift of phases as they are."""
    _, speed, aside = past(s, tangent)
    grown = np.sin(0.5 * np.pi * min(1.0, s.clock[0] / record.ramp)) ** 2
    q = grown * speed * aside * np.cos(s.internal[record.first])
    return {"force": spread(record.low, q, record.up)}


def rate(phase, flow, y_v, y_a, mean_v, mean_a, shed=SHED):
    """Rate of a phase (rad/s) in a flow of a speed over a diameter (m/s, m)."""
    speed, diameter = flow
    turn = 2.0 * np.pi * speed / diameter
    own = np.hypot(np.sqrt(mean_v), 1e-3 * speed)
    own_a = np.hypot(np.sqrt(mean_a), 1e-3 * speed * shed[0] * turn)
    vector = complex(y_v / own, -y_a / own_a)
    slip = (vector * np.exp(-1j * phase)).imag / np.hypot(abs(vector), 0.05)
    return turn * (shed[0] + slip * (shed[2] if slip > 0.0 else shed[1]))


def left_of_a_mean(mean, known, share, square):
    return mean - known - share * (square - mean)


def left_of_a_phase(phase, known, share, moved):
    return phase - known - share * rate(phase, *moved)


def phases_along(record, s, force, speeds, shed):
    """Internal variables at the end of a time for which their rates count, each by itself.

    ``force``: along the force at the nodes, (d, n+1), of the size of the speed past the pipe.
    """
    share, known = s.internal_share[0], s.internal_known
    out, rates = known.copy(), np.zeros_like(known)
    for i in np.flatnonzero(record.diameter):
        along = force[:, i] / speeds[i]
        y_v, y_a = s.v[:, i] @ along, s.a[:, i] @ along
        pace = speeds[i] / (20.0 * record.diameter[i])
        for row, y in ((1, y_v), (2, y_a)):
            held = known[row, i], share * pace, y * y
            out[row, i] = brentq(left_of_a_mean, 0.0, 1e3, args=held, xtol=1e-14)
            rates[row, i] = pace * (y * y - out[row, i])
        moved = (speeds[i], record.diameter[i]), y_v, y_a, *out[1:, i], shed
        held = known[0, i], share, moved
        out[0, i] = brentq(left_of_a_phase, -9.0, 99.0, args=held, xtol=1e-14)
        rates[0, i] = rate(out[0, i], *moved)
    return {"internal": out, "internal_rate": rates}


def phases(record, s):
    """Those of lift, which acts across the flow."""
    _, speeds, aside = past(s)
    return phases_along(record, s, aside, speeds, SHED)


def case(kind, shed):
    """Vortices at all nodes but the last, in sheared water."""
    return Case(
        lambda d: kind(
            2e2 * SEGMENTS,
            3e2 * SEGMENTS,
            np.zeros((d, N + 1)),
            DIAMETERS,
            np.repeat(shed[:, np.newaxis], N + 1, axis=1),
            6.0,
            0,
            np.zeros((3, N + 1)),
        ),
        lambda d: [sheared(d)],
        directions=(3,),
        internal=3,
    )


CASES = {VortexLift: case(VortexLift, SHED)}

PLAIN = {VortexLift: [("internal", phases), ("string", vortex_lift)]}


def of_phase_zero(record, axis, speeds):
    """Forces (d, n+1) of a record with phase zero on a straight pipe at rest, in water along x."""
    model = Model(Unknowns(np.ones(N), 3, 0, internal=3), [Effect("", record, "")])
    model.s.r[:] = np.outer(axis, np.arange(N + 1))
    shape_of(model.programs, model.state)
    model.s.clock[0] = 100.0
    model.s.water[0] = speeds
    one_call(model.programs.value.string, model.state)
    return model.s.force.copy()


def drag_and_vortices(one):
    """Forces by drag, and by vortices of the same coefficient at phase zero; and the axis of the pipe."""
    axis, speeds = np.array([0.48, 0.64, 0.6]), np.linspace(0.5, 1.4, N + 1)
    record = one.record(3)
    drag = Drag(record.low, record.up, np.zeros((3, N + 1)), 0)
    return of_phase_zero(drag, axis, speeds), of_phase_zero(record, axis, speeds), axis


def test_lift_at_its_largest_is_drag_of_its_coefficient_turned_aside():
    """By a quarter of a turn about a straight pipe, against which water of one direction flows."""
    drag, lift, axis = drag_and_vortices(CASES[VortexLift])
    assert np.abs(drag).min() > 0.0
    np.testing.assert_allclose(lift, np.cross(axis, drag, axis=0), rtol=1e-12, atol=1e-9)
