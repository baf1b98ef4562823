"""Tension loss: a case, the plain version, and a free body that it accelerates.

tests/verification/test_loss_of_tension.py and test_recoil.py follow the wave that it sends down a bar.
"""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion
from surroundings import Case

from riserstudy.effects.tension_loss import TensionLoss


def tension_loss(record, s):
    gone = np.clip((s.clock[0] - record.start) / record.over, 0.0, 1.0)
    out = np.zeros_like(s.force)
    out[:, record.node] = record.load * np.sin(0.5 * np.pi * gone) ** 2
    return {"force": out}


CASES = {TensionLoss: Case(lambda d: TensionLoss(2, -np.linspace(3e5, 2e6, d), 2.0, 4.5))}

PLAIN = {TensionLoss: [("device", tension_loss)]}

# without a load, in a plane on n segments
UNLOADED = {"tension loss": lambda n: TensionLoss(n, np.zeros(2), 1.0, 1.0)}


def test_a_free_body_has_the_momentum_and_the_energy_of_the_load():
    """m v is the load times the time since the middle of the loss, and m v^2 / 2 is what it supplied."""
    mass, load, start, over, end = 4e4, np.array([3e4, -2e4, -1e5]), 0.5, 1.2, 4.0
    model = bodies(TensionLoss(UPPER, load, start, over), mass=mass)
    found = motion(model, end, 2000)
    momentum = mass * model.s.v[:, UPPER]
    np.testing.assert_allclose(momentum, load * (end - start - 0.5 * over), rtol=1e-5)
    assert found.supplied == pytest.approx(energy(model), rel=1e-5)
    still = found.time <= start
    assert not (found.place[still, :, UPPER] - found.place[0, :, UPPER]).any()
