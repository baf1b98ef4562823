"""Wave: a case, the plain version, and the energy of a wave.

tests/effects/test_wave.py compares the flow with the equations of a potential, and with a textbook's wave.
"""

from __future__ import annotations

import numpy as np
import pytest
from surroundings import Case, sea

from riserstudy.effects.wave import NONE, STRETCHED, Wave
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.model.sea import wave_number
from riserstudy.solve.evaluate import shape_of


def wave(record, s):
    """Velocity and acceleration of the water, component by component, from the potential's formulas."""
    t, d = s.clock[0], record.depth
    p = np.pi / record.ramp if t < record.ramp else 0.0
    grown, rate = (0.5 * (1 - np.cos(p * t)), 0.5 * p * np.sin(p * t)) if p else (1.0, 0.0)
    water, water_rate = np.zeros((2, *s.r.shape))
    for i in range(s.r.shape[1]):
        x = record.heading @ s.r[:-1, i]
        z = s.r[-1, i] - record.surface
        angle = record.number * x - record.frequency * t + record.phase
        eta = grown * (record.amplitude * np.cos(angle)).sum()
        if record.above == STRETCHED:
            z = (min(z, eta) + d) * d / (d + eta) - d
        z = min(z, 0.0)
        speed, kd = record.amplitude * record.frequency, record.number * d
        u = speed * np.cosh(record.number * (z + d)) / np.sinh(kd)
        w = speed * np.sinh(record.number * (z + d)) / np.sinh(kd)
        water[:-1, i] = record.heading * grown * (u * np.cos(angle)).sum()
        water[-1, i] = grown * (w * np.sin(angle)).sum()
        f = record.frequency
        along = (u * (grown * f * np.sin(angle) + rate * np.cos(angle))).sum()
        water_rate[:-1, i] = record.heading * along
        water_rate[-1, i] = (w * (rate * np.sin(angle) - grown * f * np.cos(angle))).sum()
    return {"water": water, "water_rate": water_rate}


CASES = {Wave: Case(sea)}

PLAIN = {Wave: [("drive", wave)]}


GRAVITY, NODES, INSTANTS = 9.81, 64, 16


@pytest.mark.parametrize("depth", [10.0, 60.0, 2000.0])
@pytest.mark.parametrize("d", [2, 3])
def test_a_wave_has_as_much_kinetic_energy_as_its_elevation_has_potential_energy(d, depth):
    """The mean over a period of half of u^2 + w^2, integrated over the depth, is g a^2 / 4 at any depth.

    By the dispersion relation, which the effect does not know. Accelerations have w^2 times these squares.
    """
    w, a = 0.9, 1.3
    number = wave_number(w, depth, GRAVITY)
    heading = np.array([0.6, 0.8])[: d - 1] if d == 3 else np.ones(1)
    one = [np.array([x]) for x in (a, w, number, 0.4)]
    record = Wave(*one, heading, 45.0, depth, 0.0, NONE, np.zeros((3, 1)))
    model = Model(Unknowns(np.ones(NODES - 1), d, 0), [Effect("wave", record, "")])
    # Gauss's quadrature over the depth that moves, at any place of each node aside
    reach = min(depth, 30.0 / number)
    at, weight = np.polynomial.legendre.leggauss(NODES)
    model.s.r[-1] = 45.0 + 0.5 * reach * (at - 1.0)
    model.s.r[:-1] = np.random.default_rng(5).normal(size=(d - 1, NODES))
    squares = np.zeros((2, NODES))
    for k in range(INSTANTS):
        model.s.clock[0] = 3.0 + 2.0 * np.pi / w * k / INSTANTS
        shape_of(model.programs, model.state)
        squares += [(model.s.water**2).sum(axis=0), (model.s.water_rate**2).sum(axis=0)]
    kinetic, accelerated = 0.5 * squares / INSTANTS @ weight * 0.5 * reach
    assert kinetic == pytest.approx(0.25 * GRAVITY * a**2, rel=1e-9)
    assert accelerated == pytest.approx(w**2 * kinetic, rel=1e-9)


def test_water_of_a_deep_wave_moves_in_circles():
    """Each half of the kinetic energy: at every depth the speed is the same at all times."""
    w, a = 0.9, 1.3
    one = [np.array([x]) for x in (a, w, w**2 / GRAVITY, 0.4)]
    record = Wave(*one, np.ones(1), 45.0, 2000.0, 0.0, NONE, np.zeros((3, 1)))
    model = Model(Unknowns(np.ones(9), 2, 0), [Effect("wave", record, "")])
    depth = np.linspace(0.0, 40.0, 10)
    model.s.r[-1] = 45.0 - depth
    for time in (3.0, 3.7, 5.1):
        model.s.clock[0] = time
        shape_of(model.programs, model.state)
        circle = a * np.exp(-(w**2) / GRAVITY * depth)
        np.testing.assert_allclose(np.hypot(*model.s.water), w * circle, rtol=1e-9)
        np.testing.assert_allclose(np.hypot(*model.s.water_rate), w**2 * circle, rtol=1e-9)
        # towards the centre of the circle, a quarter of a turn from the velocity
        np.testing.assert_allclose((model.s.water * model.s.water_rate).sum(axis=0), 0.0, atol=1e-9)
