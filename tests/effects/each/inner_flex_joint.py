"""Inner flex joint: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case, pipe

from riserstudy.effects.inner_flex_joint import InnerFlexJoint


def inner_flex_joint(record, s):
    out = s.probe.copy()
    moment = s.moment[0, record.node] if len(s.dim) == 2 else np.linalg.norm(s.moment[:, record.node])
    out[record.probe] = record.flex * moment
    if len(s.dim) == 3:
        out[record.probe + 1 : record.probe + 4] = record.flex * s.moment[:, record.node]
    return {"probe": out}


CASES = {InnerFlexJoint: Case(lambda d: InnerFlexJoint(3, 2e-7, 0), lambda d: [pipe(d)], (2, 3))}

PLAIN = {InnerFlexJoint: [("probe", inner_flex_joint)]}
