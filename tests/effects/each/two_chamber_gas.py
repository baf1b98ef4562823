"""Two chamber gas: a case, and the plain version."""

from __future__ import annotations

from surroundings import Case, cylinders, pair

from riserstudy.effects.two_chamber_gas import TwoChamberGas


def two_chamber_gas(record, s):
    high = 1.0 - record.high_area * s.reach / record.high_volume
    low = 1.0 + record.low_area * s.reach / record.low_volume
    up = record.high_area * record.high_pressure * high**-record.exponent
    down = record.low_area * record.low_pressure * low**-record.exponent
    return {"pull": up - down - record.weight}


CASES = {
    TwoChamberGas: Case(
        lambda d: TwoChamberGas(
            *(pair(0.20, 0.21), pair(20e5, 21e5), pair(9.4, 9.0)),
            *(pair(0.25, 0.24), pair(1.5e5, 1.4e5), pair(2.2, 2.3)),
            *(pair(1.4, 1.2), pair(9.9e3, 5.9e4)),
        ),
        lambda d: [cylinders(d)],
    )
}

PLAIN = {TwoChamberGas: [("law", two_chamber_gas)]}
