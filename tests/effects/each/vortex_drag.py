"""Varying drag of vortices: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import spread

from each.vortex_lift import case, past, phases_along
from riserstudy.effects.vortex_drag import VortexDrag

SHED = np.array([0.36, 0.14, 0.16, 20.0])


def vortex_drag(record, s, tangent=None):
    """Varying drag of phases as they are."""
    u, speed, _ = past(s, tangent)
    grown = np.sin(0.5 * np.pi * min(1.0, s.clock[0] / record.ramp)) ** 2
    q = grown * speed * u * np.cos(s.internal[record.first])
    return {"force": spread(record.low, q, record.up)}


def phases(record, s):
    """Those of varying drag, which acts along the flow."""
    u, speeds, _ = past(s)
    return phases_along(record, s, u, speeds, SHED)


CASES = {VortexDrag: case(VortexDrag, SHED)}

PLAIN = {VortexDrag: [("internal", phases), ("string", vortex_drag)]}
