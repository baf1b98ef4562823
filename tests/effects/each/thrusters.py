"""Thrusters: a case, the plain version, and what lagging, damping, limited and rising thrust moves."""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion
from surroundings import Case, N, pair
from vessel_alone import alone

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


def test_thrust_that_lags_comes_up_exponentially(tmp_path):
    """tau F' + F = F_c: F = F_c (1 - exp(-t / tau)), and the platform follows from rest."""
    run = alone(tmp_path, **{"vessel.sway": None, "vessel.yaw": None, "vessel.thrusters.yaw": None})
    t, tau = run["time"], 8.0
    grown = -np.expm1(-t / tau)
    np.testing.assert_allclose(run["thrust_x"], 1e6 * grown, atol=100.0)
    surge = 1e6 / 1e7 * (0.5 * t**2 - tau * t + tau**2 * grown)
    np.testing.assert_allclose(run["platform_surge"], surge, atol=1e-4 * float(surge.max()))


def test_thrusters_are_spring_and_damper_between_the_vessel_and_the_commanded_place(tmp_path):
    """Step response of an oscillator: x_c (1 - exp(-zeta w t) (cos w_d t + zeta w / w_d sin w_d t))."""
    mass, gain, ratio, command = 1e7, 1e6, 0.3, 10.0
    w = np.sqrt(gain / mass)
    control = {"gain": f"{gain} N/m", "command": f"{command} m"}
    control |= {"velocity_gain": f"{2.0 * ratio * w * mass} N*s/m"}
    steps = {"analysis.step": "0.1 s", "analysis.output.interval": "0.5 s"}
    changes = {"vessel.thrusters": control, "vessel.sway": None, "vessel.yaw": None}
    run = alone(tmp_path, **changes, **steps)
    t, damped = run["time"].values, w * np.sqrt(1.0 - ratio**2)
    swing = np.cos(damped * t) + ratio * w / damped * np.sin(damped * t)
    expected = command * (1.0 - np.exp(-ratio * w * t) * swing)
    np.testing.assert_allclose(run["platform_surge"], expected, atol=1e-3 * command)


def pushed(gain, rise, saturation):
    """Motion over 10 s, and energy, of a body whose commanded place is far away obliquely."""
    far = 1e9 * np.array([0.6, 0.8])
    control = gain * np.eye(2), np.zeros((2, 2)), far
    record = Thrusters(UPPER, 0, 2, *control, rise, saturation, 0.0, 1e6, 1.0, 0)
    model = bodies(record, mass=1e6, probes="ab")
    return motion(model, 10.0, 500), energy(model)


@pytest.mark.long
def test_thrust_is_limited_along_the_way_to_the_commanded_place():
    found, stored = pushed(gain=1.0, rise=0.0, saturation=2e5)
    way = 0.5 * 2e5 / 1e6 * found.time**2
    np.testing.assert_allclose(found.place[:, :2, UPPER], np.outer(way, [0.6, 0.8]), atol=1e-6 * way[-1])
    assert found.supplied == pytest.approx(2e5 * way[-1], rel=1e-6)
    assert found.supplied == pytest.approx(stored, rel=1e-6)


def test_thrust_rises_exponentially_with_the_command():
    """m x'' = F (1 - exp(-t / tau)), F the thrust of the whole way."""
    thrust, tau = 2e5, 3.0
    found, _ = pushed(gain=thrust / 1e9, rise=tau, saturation=np.inf)
    t = found.time
    way = thrust / 1e6 * (0.5 * t**2 - tau * t + tau**2 * -np.expm1(-t / tau))
    # of second order in steps of a hundred-and-fiftieth of the rise
    np.testing.assert_allclose(found.place[:, :2, UPPER], np.outer(way, [0.6, 0.8]), atol=1e-4 * way[-1])
