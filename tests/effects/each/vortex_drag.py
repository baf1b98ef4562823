"""Varying drag of vortices: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import spread
from scipy.optimize import brentq
from surroundings import SEGMENTS, Case, N, sheared

from each.vortex_lift import DIAMETERS, left_of_a_mean, left_of_a_phase, past, rate
from riserstudy.effects.vortex_drag import VortexDrag

SHED = np.array([0.36, 0.14, 0.16, 20.0])


def vortex_drag(record, s, tangent=None):
    """Varying drag of phases as they are."""
    u, speed, _ = past(s, tangent)
    grown = np.sin(0.5 * np.pi * min(1.0, s.clock[0] / record.ramp)) ** 2
    q = grown * speed * u * np.cos(s.internal[record.first])
    return {"force": spread(record.low, q, record.up)}


def phases(record, s):
    """Internal variables at the end of a time for which their rates count, each by itself."""
    u, speeds, _ = past(s)
    share, known = s.internal_share[0], s.internal_known
    out, rates = known.copy(), np.zeros_like(known)
    for i in np.flatnonzero(record.diameter):
        n = u[:, i] / speeds[i]
        y_v, y_a = s.v[:, i] @ n, s.a[:, i] @ n
        pace = speeds[i] / (20.0 * record.diameter[i])
        for row, y in ((1, y_v), (2, y_a)):
            held = known[row, i], share * pace, y * y
            out[row, i] = brentq(left_of_a_mean, 0.0, 1e3, args=held, xtol=1e-14)
            rates[row, i] = pace * (y * y - out[row, i])
        moved = (speeds[i], record.diameter[i]), y_v, y_a, *out[1:, i], SHED
        held = known[0, i], share, moved
        out[0, i] = brentq(left_of_a_phase, -9.0, 99.0, args=held, xtol=1e-14)
        rates[0, i] = rate(out[0, i], *moved)
    return {"internal": out, "internal_rate": rates}


CASES = {
    VortexDrag: Case(
        lambda d: VortexDrag(
            2e2 * SEGMENTS,
            3e2 * SEGMENTS,
            np.zeros((d, N + 1)),
            DIAMETERS,
            np.repeat(SHED[:, np.newaxis], N + 1, axis=1),
            6.0,
            0,
            np.zeros((3, N + 1)),
        ),
        lambda d: [sheared(d)],
        directions=(3,),
        internal=3,
    ),
}

PLAIN = {
    VortexDrag: [("internal", phases), ("string", vortex_drag)],
}
