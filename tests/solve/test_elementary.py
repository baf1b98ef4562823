"""Exponential, sine and cosine of the kernels are those of the library, to rounding."""

import numpy as np
import pytest

from riserstudy.solve.elementary import exponential, sine_and_cosine, within_a_turn
from riserstudy.solve.jit import kernel


@kernel
def _tried(x, angle):
    exponentials, sines, cosines, turns = np.empty((4, len(x)))
    for k in range(len(x)):
        exponentials[k] = exponential(x[k])
        sines[k], cosines[k] = sine_and_cosine(angle[k])
        turns[k] = within_a_turn(angle[k])
    return exponentials, sines, cosines, turns


def test_they_are_the_librarys_to_rounding():
    x = np.concatenate([-np.geomspace(80.0, 1e-12, 2000), [0.0, -0.0]])
    angle = np.linspace(-50.0, 50.0, len(x))
    exponentials, sines, cosines, turns = _tried(x, angle)
    np.testing.assert_allclose(exponentials, np.exp(x), rtol=2e-13)  # eight squarings
    np.testing.assert_allclose(sines, np.sin(angle), atol=1e-14)
    np.testing.assert_allclose(cosines, np.cos(angle), atol=1e-14)
    assert abs(turns).max() <= np.pi * (1.0 + 1e-15)
    np.testing.assert_allclose(np.cos(turns), np.cos(angle), atol=1e-14)


@pytest.mark.parametrize("size", [1e3, 1e6])
def test_large_angles_are_as_exact_as_they_are_told(size):
    angle = size * np.linspace(-1.0, 1.0, 1001)
    _, sines, cosines, _ = _tried(-np.ones(1001), angle)
    rounding = 4.0 * np.finfo(float).eps * size
    np.testing.assert_allclose(sines, np.sin(angle), atol=rounding + 1e-14)
    np.testing.assert_allclose(cosines, np.cos(angle), atol=rounding + 1e-14)


def test_what_is_no_number_stays_none():
    for strange in (np.nan, np.inf, -np.inf):
        _, sines, cosines, _ = _tried(-np.ones(1), np.array([strange]))
        assert np.isnan([sines[0], cosines[0]]).all()
