"""Stack contact: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case

from riserstudy.effects.stack_contact import StackContact


def stack_contact(record, s):
    out = np.zeros_like(s.force)
    below = record.elevation - s.r[-1, 0]
    out[-1, 0] = record.stiffness * below if below > 0.0 else 0.0
    return {"force": out}


CASES = {StackContact: Case(lambda d: StackContact(1.0, 3e6))}

PLAIN = {StackContact: [("device", stack_contact)]}

# without a load, in a plane on n segments
UNLOADED = {"stack contact": lambda n: StackContact(-1e9, 1e6)}
