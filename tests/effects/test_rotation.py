"""The rotation that takes one direction into another by the shortest way, and its slopes."""

import numba
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from riserstudy.effects.rotation import rotation, rotation_by_first, rotation_by_second


@numba.njit
def all_three(a, b):
    """`rotation` and its derivatives, which only kernels can call."""
    return rotation(a, b), rotation_by_first(a, b), rotation_by_second(a, b)


def of(a, b):
    vector, first, second = all_three(tuple(a), tuple(b))
    return np.array(vector), np.array(first).reshape(3, 3), np.array(second).reshape(3, 3)


def two_directions(angle, seed):
    """Unit vectors at an angle (rad)."""
    axes = Rotation.random(rng=np.random.default_rng(seed)).as_matrix()
    return axes[0], np.cos(angle) * axes[0] + np.sin(angle) * axes[1], axes[2]


# the series in the tangent of the half angle ends at 0.1 rad
ANGLES = (0.0, 1e-9, 1e-3, 0.0999, 0.1001, 1.0, 2.5)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("seed", range(3))
def test_it_takes_the_one_into_the_other_about_their_normal(angle, seed):
    a, b, normal = two_directions(angle, seed)
    vector, _, _ = of(a, b)
    np.testing.assert_allclose(vector, angle * normal, atol=1e-12)
    np.testing.assert_allclose(Rotation.from_rotvec(vector).apply(a), b, atol=1e-12)
    np.testing.assert_allclose(of(b, a)[0], -vector, atol=1e-12)  # and back


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("which", [0, 1])
def test_its_derivatives_are_its_slopes(angle, which):
    """Along all three axes, since directions are not divided by their lengths here."""
    pair = np.array(two_directions(angle, 7)[:2])
    block = of(*pair)[1 + which]

    def moved(by):
        return of(*(pair + np.outer(np.eye(2)[which], by)))[0]

    h = 1e-3
    for k, step in enumerate(h * np.eye(3)):
        slope = (moved(-2 * step) - 8 * moved(-step) + 8 * moved(step) - moved(2 * step)) / (12 * h)
        # fourth order in a thousandth
        np.testing.assert_allclose(block[:, k], slope, atol=1e-8)
