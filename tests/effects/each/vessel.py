"""Vessel: a case, the plain version, a hull without loads, and hulls in water and wind.

tests/verification/test_drive_off.py lets a vessel pull a string and drive off with a riser.
"""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion
from plain import by_angle, of_hull
from surroundings import Case, N, pair
from vessel_alone import alone

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


HEADING, RADIUS, MASS, TURNING = 0.4, 50.0, pair(5e7, 8e7), 6e7
HULL = np.array([[np.cos(HEADING), np.sin(HEADING)], [-np.sin(HEADING), np.cos(HEADING)]])  # its axes


def floating(drag=(0.0, 0.0), spin=0.0, drift=(0.0, 0.0)):
    """A hull in still water and air."""
    record = Vessel(
        *(UPPER, UPPER + 1, RADIUS, HEADING, MASS, TURNING, np.array(drag), spin),
        *(np.zeros(2), 0.0, np.zeros(2), np.array(drift), 0, 0),
    )
    return bodies(record, held=[(UPPER, 2)], yaw=True, probes="abcdefg")


def test_a_hull_without_loads_keeps_momentum_spin_and_energy():
    """Kirchhoff: momentum is the mass along and across the hull, by its velocities along and across."""

    def momenta(model):
        angle = HEADING + model.s.r[2, UPPER + 1] / RADIUS
        tensor, v = mass_tensor(Vessel(*[None] * 4, MASS, *[None] * 9), angle), model.s.v[:2, UPPER]
        x, y = model.s.r[:2, UPPER]
        p, q = tensor @ v
        return p, q, TURNING * RADIUS * model.s.v[2, UPPER + 1] + x * q - y * p

    model = floating()
    model.s.v[:2, UPPER] = 1.0, 0.4
    model.s.v[2, UPPER + 1] = 0.5
    begun, stored = momenta(model), energy(model)
    motion(model, 300.0, 3000)
    assert model.s.r[2, UPPER + 1] / RADIUS > 2.0  # rad
    # of second order in the step, which is a hundredth of the time in which the hull turns by a radian
    np.testing.assert_allclose(momenta(model), begun, rtol=2e-4)
    assert energy(model) == pytest.approx(stored, rel=2e-4)


@pytest.mark.long
@pytest.mark.parametrize("axis", [0, 1])
def test_a_hull_slows_down_as_one_over_time(axis):
    """x = m / C log(1 + C v t / m) along or across the hull, and the water has the energy that it lost."""
    drag, speed = (2e5, 9e5), 3.0
    model = floating(drag)
    model.s.v[:2, UPPER] = speed * HULL[axis]
    before = energy(model)
    found = motion(model, 200.0, 2000)
    slow = MASS[axis] / drag[axis]
    expected = np.outer(slow * np.log1p(speed * found.time / slow), HULL[axis])
    np.testing.assert_allclose(found.place[:, :2, UPPER], expected, atol=1e-4 * np.abs(expected).max())
    assert found.dissipated == pytest.approx(before - energy(model), rel=1e-4)


def test_a_turning_hull_slows_down_as_one_over_time():
    spin, speed = 3e5, 2.0
    model = floating(spin=spin)
    model.s.v[2, UPPER + 1] = speed
    before = energy(model)
    found = motion(model, 200.0, 2000)
    slow = TURNING / spin
    assert model.s.r[2, UPPER + 1] == pytest.approx(slow * np.log1p(speed * 200.0 / slow), rel=1e-4)
    assert found.dissipated == pytest.approx(before - energy(model), rel=1e-4)


def test_wave_drift_drives_a_hull_to_the_speed_at_which_the_water_resists_as_much():
    """x = V tau log cosh(t / tau) across the hull, V = sqrt(F / C), tau = m V / F; it supplies F x."""
    drag, push = 9e5, 4e5
    model = floating((0.0, drag), drift=push * HULL[1])
    speed = np.sqrt(push / drag)
    tau = MASS[1] * speed / push
    found = motion(model, 4.0 * tau, 2000)
    expected = np.outer(speed * tau * np.log(np.cosh(found.time / tau)), HULL[1])
    np.testing.assert_allclose(found.place[:, :2, UPPER], expected, atol=1e-4 * np.abs(expected).max())
    assert found.supplied == pytest.approx(push * np.linalg.norm(expected[-1]), rel=1e-4)
    assert found.supplied - found.dissipated == pytest.approx(energy(model), rel=1e-4)


@pytest.mark.parametrize("heading", [0.0, 40.0])
def test_wind_drives_a_vessel_to_where_air_and_water_press_alike(tmp_path, heading):
    """C_w (W - v)^2 = C (v - U)^2: v is the mean of both flows, weighted with roots of the coefficients."""
    water, air, current, wind = 2e5, 2e3, 0.5, 20.0
    drag, towards = f"{water} N*s^2/m^2", f"{heading} deg"
    profile = [{"elevation": z, "speed": f"{current} m/s"} for z in ("0 m", "1000 m")]
    changes = {
        "water": {"density": "1025 kg/m^3", "surface": "1000 m"},
        "current": {"profile": profile, "heading": towards},
        "vessel.thrusters": None,
        "vessel.hull_drag": drag,
        "vessel.added_mass": "1e7 kg",
        "vessel.sway.hull_drag": drag,
        "vessel.wind": {"drag": f"{air} N*s^2/m^2", "speed": f"{wind} m/s", "heading": towards},
        "vessel.yaw": None,
        "riser[0].shear_modulus": None,
        "analysis.duration": "300 s",
        "analysis.step": "0.5 s",
    }
    run = alone(tmp_path, **changes).sel(time=[250.0, 300.0])
    weights = np.sqrt([water, air])
    speed = weights @ [current, wind] / weights.sum()
    for name, share in (("platform_surge", np.cos), ("platform_sway", np.sin)):
        if name in run:
            drifted = float(run[name].diff("time")[0]) / 50.0
            assert drifted == pytest.approx(speed * share(np.deg2rad(heading)), rel=1e-3)
