"""Vessel: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import by_angle, of_hull
from surroundings import Case, N, pair

from riserstudy.effects.vessel import Vessel


def hull(d: int) -> Vessel:
    """In the plane it keeps its heading."""
    yaw = N + 1 if d == 3 else 0
    return Vessel(
        *(N, yaw, 50.0, 0.4 if d == 3 else 0.0, pair(5e7, 8e7), 6e7, pair(2.5e5, 9e5), 3e5),
        *(pair(0.5, 0.3), 2e3, pair(-9.0, 4.0), pair(1e5, -6e4), 0, 0),
    )


def vessel(record, s):
    axes, _, v, _ = of_hull(record, s)
    water, air = record.current - v, record.wind - v
    total = record.drift + record.area * np.linalg.norm(air) * air
    total = total + (record.hull * np.linalg.norm(water) * (axes @ water)) @ axes
    out = np.zeros_like(s.force)
    out[: len(out) - 1, record.node] = total[: len(out) - 1]
    if record.yaw:
        out[-1, -1] = -record.spin * abs(s.v[-1, -1]) * s.v[-1, -1]
    return {"force": out}


def mass_tensor(record, angle):
    axes = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return axes.T @ np.diag(record.mass) @ axes


def vessel_inertia(record, s):
    axes, rate, v, a = of_hull(record, s)
    angle = np.arctan2(axes[0, 1], axes[0, 0])
    tensor = mass_tensor(record, angle)
    turned = by_angle(lambda x: mass_tensor(record, x), angle)
    out = np.zeros_like(s.force)
    out[: len(out) - 1, record.node] = -(tensor @ a + rate * turned @ v)[: len(out) - 1]
    if record.yaw:
        out[-1, -1] = -record.turning * s.a[-1, -1] + 0.5 * v @ turned @ v / record.radius
    return {"force": out}


CASES = {Vessel: Case(hull, directions=(2, 3), loose=1)}

PLAIN = {Vessel: [("device", vessel), ("device_inertia", vessel_inertia)]}
