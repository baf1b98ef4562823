"""Flex joint: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import along, angles, carried, rotations
from surroundings import Case, N, pipe

from riserstudy.effects.flex_joint import FlexJoint


def flex_joint(record, s):
    out = np.zeros(s.turn.shape)
    held = carried(s.platform, record.lean)[0]
    _, t = along(s)
    if len(t) == 3:
        out[:, -1:] = rotations(t[:, -1:], held[:, None])
    else:
        out[0, -1] = np.arctan2(held[0], held[2]) - angles(s)[-1]
    return {"turn": out}


CASES = {
    FlexJoint: Case(
        lambda d: FlexJoint(
            N, 1e-7, np.array([0.06, -0.08, np.sqrt(0.99)] if d > 2 else [0.6, 0.0, 0.8]), 1, np.zeros((3, 3))
        ),
        lambda d: [pipe(d)],
        (2, 3),
    )
}

PLAIN = {FlexJoint: [("place turn", flex_joint)]}
