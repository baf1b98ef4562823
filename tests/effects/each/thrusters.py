"""Thrusters: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case, N, pair

from riserstudy.effects.thrusters import Thrusters


def some_thrusters(d: int) -> Thrusters:
    """Limited in space; their lag is that of a mass small enough for the tangent to show it."""
    gain, damping = np.array([[6.5e4, 1e4], [1e4, 9e4]]), np.array([[1e6, 1e5], [1e5, 2e6]])
    saturation = 1e6 if d == 3 else np.inf
    return Thrusters(N, 0, d - 1, gain, damping, pair(100.0, 30.0), 7.0, saturation, 4.0, 30.0, 1.0, 0)


def thrusters(record, s):
    told = record.command * -np.expm1(-s.clock[0] / record.rise)
    n, k = record.node, record.count
    gain, damping = record.gain[:k, :k], record.damping[:k, :k]
    wanted = gain @ (told[:k] - s.r[:k, n]) - damping @ s.v[:k, n]
    size = np.linalg.norm(wanted)
    limited = wanted * min(1.0, record.saturation / size)
    out = np.zeros_like(s.force)
    out[:k, n] = record.mass / record.lag * s.v[:k, n + 1]
    out[:k, n + 1] = limited / record.mass - s.v[:k, n + 1] / record.lag
    return {"force": out}


def thrusters_inertia(record, s):
    out = np.zeros_like(s.force)
    out[: record.count, record.node + 1] = -s.a[: record.count, record.node + 1]
    return {"force": out}


CASES = {Thrusters: Case(some_thrusters, directions=(2, 3), loose=1)}

PLAIN = {Thrusters: [("device", thrusters), ("device_inertia", thrusters_inertia)]}
