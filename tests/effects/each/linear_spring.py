"""Linear spring: a case, and the plain version."""

from __future__ import annotations

from surroundings import Case, cylinders, pair

from riserstudy.effects.linear_spring import LinearSpring


def linear_spring(record, s):
    return {"pull": record.tension + record.stiffness * s.reach}


CASES = {LinearSpring: Case(lambda d: LinearSpring(pair(8e5, 7e5), pair(3e4, 2e4)), lambda d: [cylinders(d)])}

PLAIN = {LinearSpring: [("law", linear_spring)]}
