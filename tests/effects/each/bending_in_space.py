"""Bending in space: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import along, rotations
from surroundings import Case, flexibility, nodes, pipe

from riserstudy.effects.bending_in_space import SpatialBending


def spatial_bending(record, s):
    length, t = along(s)
    turn = np.zeros_like(s.turn)
    turn[:, 1:-1] = rotations(t[:, :-1], t[:, 1:])
    turn -= s.moment @ flexibility(s)
    return {"turn": turn, "force": nodes(np.cross(t, np.diff(s.moment, axis=1), axis=0) / length)}


CASES = {SpatialBending: Case(pipe, directions=(3,))}

PLAIN = {SpatialBending: [("turn string", spatial_bending)]}
