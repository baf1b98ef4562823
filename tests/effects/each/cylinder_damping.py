"""Cylinder damping: a case, and the plain version."""

from __future__ import annotations

from surroundings import Case, cylinders, pair

from riserstudy.effects.cylinder_damping import CylinderDamping


def cylinder_damping(record, s):
    return {"pull": record.damping * s.reach_rate}


CASES = {CylinderDamping: Case(lambda d: CylinderDamping(pair(967.0, 2e4)), lambda d: [cylinders(d)])}

PLAIN = {CylinderDamping: [("law", cylinder_damping)]}
