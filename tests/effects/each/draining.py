"""Draining contents: a case, and the plain version.

The closed forms of the column, and of what hangs while it drains, are in tests/verification/test_recoil.py.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from surroundings import L0, Case, N

from riserstudy.effects.added_mass import AddedMass
from riserstudy.effects.draining import Draining
from riserstudy.effects.weight import Weight

CONTENTS, SEA, GRAVITY = 1400.0, 1025.0, 9.81
BORE = np.linspace(0.15, 0.22, N)[np.argsort(np.cos(7.0 * np.arange(N)))]  # another one for each segment
FOOT = np.append(0.0, np.cumsum(L0)[:-1])
FULL = BORE * CONTENTS * L0


def held(level, water):
    """Mass inside the segments, sampled at ten thousand places each."""
    place = FOOT[:, None] + L0[:, None] * (np.arange(10_000) + 0.5) / 10_000
    density = np.where(place < water, SEA, np.where(place < level, CONTENTS, 0.0))
    return BORE * L0 * density.mean(axis=1)


def draining(record, s):
    time = s.clock[0]
    inside = held(*(np.interp(time, record.time, row) for row in (record.top, record.water)))
    return {"force": along(record, s, inside)}


def along(record, s, mass):
    """Newton's second law for the fluid of each segment, and for what passes from one bore into another."""
    time = s.clock[0]
    top, water, rate, square = (
        np.interp(time, record.time, row)
        for row in (record.top, record.water, record.acceleration, record.square)
    )
    push = mass / BORE * rate * s.tangent
    out = np.zeros_like(s.force)
    out[:, :N] += 0.5 * push
    out[:, 1 : N + 1] += 0.5 * push
    for i in range(1, N):
        density = SEA if FOOT[i] < water else CONTENTS if FOOT[i] < top else 0.0
        faster = math.sqrt(square) / BORE[i - 1] - math.sqrt(square) / BORE[i]
        mean = 0.5 * (s.tangent[:, i - 1] + s.tangent[:, i])
        out[:, i] += density * math.sqrt(square) * faster * mean
    return out


@cache
def others(d: int) -> tuple[Weight, AddedMass]:
    """What the column writes: each case has one set of arrays."""
    return Weight(d - 1, np.zeros(N + 1), 55.0), AddedMass(FULL.copy(), -FULL, 0)


def _column(d: int) -> Draining:
    weight, inside = others(d)
    time = 1.0 + 0.5 * np.arange(14)
    return Draining(
        time=time,
        acceleration=0.2 * (5.0 - time),
        square=(0.3 * (time - 1.0)) ** 2,
        top=55.0 - 0.4 * (time - 1.0) ** 2,
        water=np.maximum(3.0 * (time - 3.0), 0.0),
        foot=FOOT,
        bore=BORE,
        steps=np.concatenate([[0.0], 1.0 / BORE[:-1] - 1.0 / BORE[1:], [0.0]]),
        densities=(CONTENTS, SEA),
        gravity=GRAVITY,
        mass=FULL.copy(),
        change=np.zeros(N),
        full=FULL,
        load=weight.load,
        dead=np.linspace(-3e5, -1e5, N + 1),
        inside=inside.mass,
        minus=inside.minus,
        level=weight.level,
    )


CASES = {Draining: Case(_column, lambda d: list(others(d)))}

PLAIN = {Draining: [("string", draining)]}
