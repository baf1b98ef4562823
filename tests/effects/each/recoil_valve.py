"""Recoil valve: a case, the plain version, and bodies that a throttled pull raises.

tests/verification/test_recoil.py throttles the tensioners of a string that disconnects.
"""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion, on_two_cylinders
from surroundings import Case, cylinders, pair

from riserstudy.effects.linear_spring import LinearSpring
from riserstudy.effects.recoil_valve import RecoilValve


def recoil_valve(record, s):
    """Half closed: the mean of what it is open and closed, at the state's own time."""
    gone = np.clip((s.clock[0] - record.start) / record.over, 0.0, 1.0)
    opening = 1.0 - (1.0 - record.residual) * np.sin(0.5 * np.pi * gone) ** 2
    drop = record.resistance * s.reach_rate * np.abs(s.reach_rate) / opening**2
    return {"pull": np.maximum(drop, -np.maximum(s.pull, 0.0))}


def _valve(d: int) -> RecoilValve:
    return RecoilValve(pair(2e4, 3e4), pair(0.3, 1.0), 2.0, 4.5, np.zeros(2))


CASES = {RecoilValve: Case(_valve, lambda d: [cylinders(d), LinearSpring(pair(1e6, 2e6), pair(1e5, 2e5))])}

PLAIN = {RecoilValve: [("law", recoil_valve)]}


MASS, WEIGHT, RESISTANCE = 2e4, 3e5, pair(4e4, 6e4)  # kg, N, N s2/m2


def raised(pull, residual, start=-2.0):
    """A body on a constant pull through valves, which have closed if they start to close before the run."""
    records = (
        LinearSpring(pair(0.5, 0.5) * pull, np.zeros(2)),
        RecoilValve(RESISTANCE, residual * np.ones(2), start, 1.0, np.zeros(2)),
        on_two_cylinders(),
    )
    return bodies(*records, mass=MASS, weight=WEIGHT, cylinders=2)


@pytest.mark.parametrize("residual, start", [(0.3, 100.0), (0.3, -2.0), (1.0, -2.0)])
def test_a_body_rises_to_the_speed_at_which_the_oil_takes_the_overpull(residual, start):
    """v = V tanh(t / tau); V is the share of the opening times sqrt(overpull / resistance), tau = m V / F."""
    overpull = 1e5
    model = raised(WEIGHT + overpull, residual, start)
    before = energy(model)
    speed = (1.0 if start > 0.0 else residual) * np.sqrt(overpull / RESISTANCE.sum())
    tau = MASS * speed / overpull
    found = motion(model, 5.0 * tau, 1000)
    risen = found.place[:, -1, UPPER] - 1.0
    np.testing.assert_allclose(risen, speed * tau * np.log(np.cosh(found.time / tau)), atol=1e-4 * risen[-1])
    assert found.dissipated == pytest.approx(before - energy(model), rel=1e-4)


def test_a_body_that_is_faster_than_the_gas_feels_its_weight_alone():
    model = raised(2e4, 0.3)
    speed = 5.0
    model.s.v[-1, UPPER] = speed
    found = motion(model, 0.25, 100)
    fallen = 1.0 + speed * found.time - 0.5 * WEIGHT / MASS * found.time**2
    np.testing.assert_allclose(found.place[:, -1, UPPER], fallen, rtol=1e-5)
