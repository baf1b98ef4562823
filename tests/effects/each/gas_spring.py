"""Gas spring: a case, and the plain version."""

from __future__ import annotations

from surroundings import Case, cylinders, pair

from riserstudy.effects.gas_spring import GasSpring


def gas_spring(record, s):
    left = record.volume - record.area * s.reach
    return {"pull": record.area * record.pressure * (record.volume / left) ** record.exponent}


CASES = {
    GasSpring: Case(
        lambda d: GasSpring(pair(0.17, 0.16), pair(190e5, 180e5), pair(3.2, 3.0), pair(1.4, 1.2)),
        lambda d: [cylinders(d)],
    )
}

PLAIN = {GasSpring: [("law", gas_spring)]}
