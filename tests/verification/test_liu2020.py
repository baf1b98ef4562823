"""Liu et al. 2020 by the engine and by the methods beside it."""

import numpy as np
import pytest

from riserstudy.derived.methods import Beamlike, by_collocation, by_hermite_elements

LENGTH = 533.0


def beam(tension, speed, stiffness=2.2e7, weight=0.0):
    return Beamlike(
        LENGTH, stiffness, tension, weight, 200.0, np.array([0.0, LENGTH]), np.array([speed, speed])
    )


@pytest.mark.parametrize("solve", [by_hermite_elements, by_collocation])
def test_methods_beside_the_engine_agree_with_a_tensioned_beam_under_uniform_load(solve):
    tension, speed = 5e5, 0.8
    s = np.linspace(0.0, LENGTH, 11)
    load, k = 200.0 * speed**2, np.sqrt(tension / 2.2e7)
    bent = 1.0 - np.cosh(k * (s - 0.5 * LENGTH)) / np.cosh(0.5 * k * LENGTH)
    exact = load * (0.5 * s * (LENGTH - s) / tension - bent / (tension * k**2))
    np.testing.assert_allclose(solve(beam(tension, speed), s), exact, atol=2e-6 * exact.max())


def test_methods_beside_the_engine_agree_where_tension_varies():
    heavy = beam(9e5, 1.0, weight=1.1e3)
    s = np.linspace(0.0, LENGTH, 41)
    one, other = by_hermite_elements(heavy, s), by_collocation(heavy, s)
    np.testing.assert_allclose(one, other, atol=1e-5 * other.max())
