"""Varying drag of vortices: a case, the plain version, and steady drag at its largest.

tests/effects/test_vortex_drag.py has closed forms of a rigid cylinder, and its equations solved by others.
"""

from __future__ import annotations

import numpy as np
from plain import spread

from each.vortex_lift import case, drag_and_vortices, past, phases_along
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


def test_varying_drag_at_its_largest_is_drag_of_its_coefficient():
    drag, varying, _ = drag_and_vortices(CASES[VortexDrag])
    assert np.abs(drag).min() > 0.0
    np.testing.assert_allclose(varying, drag, rtol=1e-12)
