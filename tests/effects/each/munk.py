"""Munk: a case, the plain version, a hull that turns broadside, and a current that is only a moving frame."""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion
from plain import by_angle, of_hull
from surroundings import Case, N, pair
from vessel_alone import alone

from riserstudy.effects.munk import Munk
from riserstudy.effects.vessel import Vessel


def munk(record, s):
    axes, rate, v, _ = of_hull(record, s)

    def tensor(angle):
        ahead = np.array([np.cos(angle), np.sin(angle)])
        return record.difference * np.outer(ahead, ahead)

    turned = by_angle(tensor, np.arctan2(axes[0, 1], axes[0, 0]))
    out = np.zeros_like(s.force)
    out[:2, record.node] = rate * turned @ record.current
    out[2, -1] = (0.5 * record.current - v) @ turned @ record.current / record.radius
    return {"force": out}


CASES = {Munk: Case(lambda d: Munk(N, N + 1, 50.0, 0.4, -3e7, pair(0.5, 0.3)), directions=(3,), loose=1)}

PLAIN = {Munk: [("device", munk)]}


def test_a_hull_turns_broadside_to_the_current(tmp_path):
    """Turns p of a hull at p0 to it: I p'' = D U^2 (p0 + p) - D U^2 p D / m, D the difference of mass.

    The last term is what it gives way sideways, with the mass m across.
    """
    current = {"profile": [{"elevation": z, "speed": "1 m/s"} for z in ("0 m", "1000 m")]}
    scene = {
        "water": {"density": "1025 kg/m^3", "surface": "1000 m"},
        "current": current,
        "vessel.thrusters": None,
        "vessel.hull_drag": "1e-3 N*s^2/m^2",
        "vessel.heading": "0.001 deg",
        "vessel.sway.added_mass": "4e7 kg",
        "analysis.duration": "200 s",
    }
    run = alone(tmp_path, **scene, **{"riser[0].shear_modulus": None})
    push, share = 4e7 * 1.0**2 / 3e10, 1.0 - 4e7 / 5e7
    turn = np.deg2rad(0.001) / share * (np.cosh(np.sqrt(push * share) * run["time"]) - 1.0)
    assert float(turn.max()) > 50 * np.deg2rad(0.001)
    np.testing.assert_allclose(run["platform_yaw"], turn, atol=2e-3 * float(turn.max()))


def test_a_hull_in_a_current_moves_as_in_still_water_seen_from_the_current():
    """Without drag, a velocity of all water and of the hull changes nothing but the place."""
    mass, current = pair(5e7, 9e7), pair(1.5, -0.8)
    hull = Vessel(
        *(UPPER, UPPER + 1, 50.0, 0.4, mass, 6e7, np.zeros(2), 0.0),
        *(current, 0.0, np.zeros(2), np.zeros(2), 0, 0),
    )
    munk = Munk(UPPER, UPPER + 1, 50.0, 0.4, mass[0] - mass[1], current)
    found, turned = [], []
    for records, water in (((hull, munk), current), ((hull,), np.zeros(2))):
        model = bodies(*records, held=[(UPPER, 2)], yaw=True, probes="abcdefg")
        model.s.v[:2, UPPER] = water + pair(0.3, 0.6)
        model.s.v[2, UPPER + 1] = 1.0
        before = energy(model)
        moved = motion(model, 150.0, 3000)
        found.append(moved.place[:, :2, UPPER] - np.outer(moved.time, water))
        turned.append(model.s.r[2, UPPER + 1] / 50.0)
        assert energy(model) == pytest.approx(before, rel=1e-4)
    assert turned[1] > 2.0  # rad
    assert turned[0] == pytest.approx(turned[1], rel=1e-4)
    np.testing.assert_allclose(found[0], found[1], atol=1e-4 * np.abs(found[1]).max())
