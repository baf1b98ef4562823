"""Derivatives of effects compared with finite differences."""

import numpy as np
from rig import PAIRS

from riserstudy.effects.registry import ROLES

# Finite differences of fourth order with steps of 1e-3 m or 1e-3 m/s: truncation and rounding of
# forces up to 1e8 N leave a relative 1e-8 or so of the largest entry.
DIFFERENCES = 1e-7
WITH = {role: [p for p in PAIRS if role in ROLES[p[0]]] for role in ("potential", "power", "mass")}


def relative(found, expected, least=1e-300):
    """Largest difference over the largest expected value, or over ``least``."""
    return np.abs(np.asarray(found) - expected).max() / max(np.abs(expected).max(), least)


def check_blocks(rig, tangent, slope):
    """Turning angles and forces apart, for their sizes differ by many orders.

    A slope that vanishes is compared with the force itself a metre, or an angle of 0.1 rad a metre.
    """
    split = rig.m * rig.s.r.shape[1]
    tangent = tangent[:, split:]
    force = np.abs(rig.evaluate()[rig.m :]).max()
    assert relative(-tangent[split:], slope[split:], max(force, 1.0)) < DIFFERENCES
    if split:  # hinged ends have no equation of their own
        carried = np.tile(~rig.model.hinged, rig.m)
        assert relative(-tangent[:split][carried], slope[:split][carried], 0.1) < DIFFERENCES
