"""Platform motion: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case

from riserstudy.effects.platform_motion import Cruise, Encountered, Harmonic, Position, Series


def splines(d: int) -> Series:
    coefficient = np.random.default_rng(3).normal(size=(4, 5)) * [[1e-3], [1e-2], [0.1], [1.0]]
    return Series(2, np.array([0.0, 2.0, 3.0, 5.5, 8.0, 10.0]), coefficient)


def position(record, t):
    return record.displacement


def harmonic(record, t):
    out = np.zeros(6)
    ramp = np.where(record.ramp > 0.0, record.ramp, 1e-300)
    grown = np.where(t < ramp, 0.5 * (1.0 - np.cos(np.pi * np.minimum(t / ramp, 1.0))), 1.0)
    value = record.amplitude * np.sin(record.frequency * t + record.phase) * grown
    np.add.at(out, record.motion, value)
    return out


def sailed(ramp, t):
    """Distance for a speed of 1 m/s."""
    return 0.5 * t**2 / ramp if t < ramp else t - 0.5 * ramp


def encountered(record, t):
    late = record.phase - record.delay * record.speed * sailed(record.over, t)
    return harmonic(record._replace(phase=late), t)


def cruise(record, t):
    out = np.zeros(6)
    out[record.motion] = record.speed * sailed(record.ramp, t)
    return out


def series(record, t):
    out = np.zeros(6)
    t = np.clip(t, record.time[0], record.time[-1])
    k = min(np.searchsorted(record.time, t, side="right") - 1, len(record.time) - 2)
    out[record.motion] = np.polyval(record.coefficient[:, k], t - record.time[k])
    return out


def motions():
    """Which motion, amplitude, frequency, phase and ramp."""
    return (
        np.array([0, 2, 0]),
        np.array([2.0, 1.0, 0.5]),
        np.array([0.4, 0.6, 1.1]),
        np.array([0.3, 0.0, -1.0]),
        np.array([15.0, 0.0, 3.0]),
    )


CASES = {
    Position: Case(lambda d: Position(np.linspace(0.1, 0.6, 6))),
    Harmonic: Case(lambda d: Harmonic(*motions())),
    Encountered: Case(lambda d: Encountered(*motions(), np.array([0.02, -0.04, 0.12]), 1.5, 12.0)),
    Cruise: Case(lambda d: Cruise(0, 1.5, 12.0)),
    Series: Case(splines),
}

MOTIONS = {Position: position, Harmonic: harmonic, Encountered: encountered, Cruise: cruise, Series: series}

# without a load, in a plane on n segments
UNLOADED = {"platform position": lambda n: Position(np.zeros(6))}
