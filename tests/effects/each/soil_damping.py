"""Damping of soil: a case, the plain version, and an oscillation that decays.

tests/verification/test_soil_damping.py compares a pile with a damped beam on springs, and dashpots with the
hysteresis that they replace.
"""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, motion
from surroundings import Case

from riserstudy.effects.soil import LinearSoil
from riserstudy.effects.soil_damping import SoilDamping


def soil_damping(record, s):
    out = np.zeros_like(s.force)
    np.add.at(out, (slice(-1), record.node), -record.damping * s.v[:-1, record.node])
    return {"force": out}


CASES = {
    SoilDamping: Case(lambda d: SoilDamping(np.arange(4), 3e5 * np.linspace(1.0, 2.0, 4)), directions=(2, 3))
}

PLAIN = {SoilDamping: [("device", soil_damping)]}


def test_an_oscillation_decays_by_the_damping_ratio():
    """x = X exp(-zeta w t) (cos w_d t + zeta w / w_d sin w_d t), zeta = c / (2 sqrt(k m))."""
    mass, ratio, w = 1e4, 0.05, 2.0
    node = np.array([UPPER])
    spring = LinearSoil(node, np.array([mass * w**2]))
    dashpot = SoilDamping(node, np.array([2.0 * ratio * mass * w]))
    model = bodies(spring, dashpot, mass=mass)
    model.s.r[:2, UPPER] = 0.3, 0.4
    found = motion(model, 5.0 * 2.0 * np.pi / w, 2000)
    damped = w * np.sqrt(1.0 - ratio**2)
    t, fading = found.time, np.exp(-ratio * w * found.time)
    shape = fading * (np.cos(damped * t) + ratio * w / damped * np.sin(damped * t))
    # 400 steps a period: the trapezoidal rule delays by 2e-5 of the phase, 31 rad
    np.testing.assert_allclose(found.place[:, :2, UPPER], np.outer(shape, [0.3, 0.4]), atol=1e-3 * 0.5)
    begun = 0.5 * mass * w**2 * 0.5**2
    left = 0.5 * (spring.stiffness[0] * 0.25 * shape[-1] ** 2 + mass * (model.s.v[:2, UPPER] ** 2).sum())
    assert found.dissipated == pytest.approx(begun - left, rel=1e-3)
