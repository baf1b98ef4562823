"""Wave force: a case, the plain version, and a deep wave on an upright and on a moving pipe."""

from __future__ import annotations

import numpy as np
import pytest
from plain import across, at_nodes, spread
from surroundings import SEGMENTS, Case, N, sea

from riserstudy.effects.wave import CONSTANT, NONE, Wave
from riserstudy.effects.wave_force import WaveForce
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.solve.evaluate import forces_and_tangent, one_call
from riserstudy.solve.state import SUPPLIED


def wave_force(record, s):
    return {"force": spread(record.mass, across(s.water_rate, at_nodes(s)))}


CASES = {
    WaveForce: Case(lambda d: WaveForce(8e3 * SEGMENTS, np.zeros((d, N + 1))), lambda d: [sea(d, CONSTANT)])
}

PLAIN = {WaveForce: [("string", wave_force)]}

# without a load, in a plane on n segments
UNLOADED = {"wave force": lambda n: WaveForce(np.zeros(n), np.zeros((2, n + 1)))}


GRAVITY = 9.81


@pytest.mark.parametrize("frequency", [0.5, 1.1])
def test_a_deep_wave_pushes_an_upright_pipe_alike_at_any_frequency(frequency):
    """The sum over the depth of c a w^2 exp(k z) sin(p - w t) is c g a sin(p - w t), since w^2 = g k.

    c: displaced mass per length, with added mass. The pipe ends where the wave has died out.
    """
    mass, amplitude, phase, n = 900.0, 1.7, 0.4, 600
    number = frequency**2 / GRAVITY
    step = 15.0 / number / n
    one = [np.array([x]) for x in (amplitude, frequency, number, phase)]
    records = [
        Wave(*one, np.ones(1), 0.0, 1e5, 0.0, NONE, np.zeros((3, 1))),
        WaveForce(np.full(n, mass * step), np.zeros((2, n + 1))),
    ]
    model = Model(Unknowns(np.full(n, step), 2, 0), [Effect(type(r).__name__, r, "") for r in records])
    model.s.r[-1] = -step * np.arange(n, -1, -1)
    model.s.v[0] = 0.7
    for time in (1.0, 4.2, 7.7):
        model.s.clock[0] = time
        forces_and_tangent(model.programs, model.state)
        pushed = mass * GRAVITY * amplitude * np.sin(phase - frequency * time)
        # nodes of 0.025 / k: the trapezoidal sum errs by a twelfth of its square, 5e-5
        assert model.s.force[0].sum() == pytest.approx(pushed, abs=1e-4 * mass * GRAVITY * amplitude)
        np.testing.assert_allclose(model.s.force[1], 0.0, atol=1e-9)
        model.s.flow[:] = 0.0
        one_call(model.programs.value.power, model.state)
        assert model.s.flow[SUPPLIED] == pytest.approx(0.7 * model.s.force[0].sum(), rel=1e-12)
