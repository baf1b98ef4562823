"""Support: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import carried
from surroundings import TOP, Case, N

from riserstudy.effects.support import Support
from riserstudy.model.layout import AXES


def support(record, s):
    """Accelerations by differences: compared apart."""
    moved = s.platform[:, :3] + carried(s.platform, record.arm)
    moved[0] += record.place - record.arm
    out = {name: getattr(s, name).copy() for name in ("r",)}
    for k, axis in enumerate(record.axis):
        if record.held[k]:
            out["r"][k, record.node] = moved[0, axis]
    return out


CASES = {
    Support: Case(
        lambda d: Support(
            N,
            np.array([1.0, -2.0, TOP]),
            np.array(AXES[d]),
            np.ones(d, np.int64),
            np.ones(d, np.int64),
            np.array([3.0, -1.0, 20.0]),
            np.zeros((3, 3)),
        )
    )
}

PLAIN = {Support: [("place", support)]}
