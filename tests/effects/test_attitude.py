"""Points of a turned platform: positions by rotation matrices, rates by differences."""

import numba
import numpy as np
import pytest
from numpy.testing import assert_allclose
from plain import carried

from riserstudy.effects.attitude import turned


@numba.njit
def turn(platform, p, v, a):
    """`turned`, which only kernels can call."""
    turned(platform, p, v, a)


ARM = np.array([3.0, -1.0, 20.0])


@pytest.mark.parametrize("axes", [[], [3], [4], [5], [3, 4], [3, 4, 5]])
def test_points_turn_with_roll_pitch_and_yaw_in_this_order(axes):
    platform = np.zeros((3, 6))
    platform[:, axes] = np.random.default_rng(1).normal(size=(3, len(axes)))
    found = np.zeros((3, 3))
    found[0] = ARM
    turn(platform, *found)
    assert_allclose(found, carried(platform, ARM), rtol=0, atol=1e-7)  # of differences


def test_pitch_leans_the_vertical_towards_x_and_roll_towards_minus_y():
    for motion, axis, sign in ((4, 0, 1.0), (3, 1, -1.0)):
        platform = np.zeros((3, 6))
        platform[0, motion] = 0.1
        vertical, rate, bend = np.array([0.0, 0.0, 1.0]), np.zeros(3), np.zeros(3)
        turn(platform, vertical, rate, bend)
        assert vertical[axis] == pytest.approx(sign * np.sin(0.1))
        assert vertical[2] == pytest.approx(np.cos(0.1))
