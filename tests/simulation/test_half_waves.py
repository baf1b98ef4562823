"""The wave number of a beam under tension, from the natural frequencies of a beam between two hinges."""

import numpy as np
import pytest
from scipy.linalg import eigh

from riserstudy.simulation.half_waves import wave_number

LENGTH = 60.0  # m
MASS = 450.0  # kg/m
ELEMENTS = 40


def frequencies(bending, tension):
    """Of a beam between two hinges (rad/s), by finite elements of cubic shape functions."""
    h = LENGTH / ELEMENTS
    size = 2 * (ELEMENTS + 1)
    stiff, mass = np.zeros((size, size)), np.zeros((size, size))
    bend = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2]])
    bend = np.vstack([bend, [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]]) / h**3
    pull = np.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -(h**2)]])
    pull = np.vstack([pull, [-36, -3 * h, 36, -3 * h], [3 * h, -(h**2), -3 * h, 4 * h**2]]) / (30 * h)
    own = np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2]])
    own = np.vstack([own, [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]]) * h / 420
    for k in range(ELEMENTS):
        at = slice(2 * k, 2 * k + 4)
        stiff[at, at] += bending * bend + tension * pull
        mass[at, at] += MASS * own
    free = [k for k in range(size) if k not in (0, size - 2)]
    return np.sqrt(eigh(stiff[np.ix_(free, free)], mass[np.ix_(free, free)], eigvals_only=True))


@pytest.mark.parametrize(
    "bending, tension", [(4e8, 0.0), (4e8, 2e6), (4e8, -5e5), (2e6, 2e6), (3e7, 1e5), (1e-3, 2e6)]
)
@pytest.mark.parametrize("number", [1, 2, 5])
def test_a_mode_of_so_many_half_waves_has_their_length(bending, tension, number):
    frequency = frequencies(bending, tension)[number - 1]
    half = np.pi / wave_number(bending, tension, MASS, frequency)
    assert half == pytest.approx(LENGTH / number, rel=1e-3)


def test_a_string_has_the_speed_of_its_waves_and_without_tension_no_length():
    assert 2.0 * np.pi / wave_number(0.0, 1.8e6, MASS, 2.0 * np.pi / 7.0) == pytest.approx(7.0 * 4000.0**0.5)
    assert wave_number(0.0, 0.0, MASS, 1.0) == np.inf
