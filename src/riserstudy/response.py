r"""Platform motion in a wave or sea: every component times the response amplitude operators.

.. math:: S(t) = \sum_j a_j\,|R(\omega_j)| \cos(\omega_j t - \varepsilon_j + \varphi(\omega_j))

for a surface :math:`\sum_j a_j \cos(\omega_j t - \varepsilon_j)` at the platform (Liu et al. 2020, Eq. 12;
its constant offset is the platform's position). Between the lines of the table R is linear over
frequency in its real and imaginary parts, so that phases cross 180 degrees without harm.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError
from riserstudy.scene.response import Response
from riserstudy.scene.sea import Storm, Swell
from riserstudy.sea import components_of

FloatArray = NDArray[np.float64]


class Harmonics(NamedTuple):
    """Motions amplitude sin(frequency t + phase), one row each."""

    motion: list[str]
    amplitude: FloatArray  # m or rad
    frequency: FloatArray  # rad/s
    phase: FloatArray  # rad


def operator(response: Response, motion: str, frequency: FloatArray) -> NDArray[np.complex128]:
    """R of one motion at frequencies (rad/s), leading phases positive."""
    sign = 1.0 if response.phases == "lead" else -1.0
    rows = response.operators[::-1]  # frequencies rise
    at = np.array([2.0 * math.pi / row.period for row in rows])
    values = np.array(
        [getattr(row, motion) * np.exp(1j * sign * getattr(row, f"{motion}_phase")) for row in rows]
    )
    real, imaginary = (np.interp(frequency, at, part) for part in (values.real, values.imag))
    return np.asarray(real + 1j * imaginary)


def harmonics(response: Response, wave: Swell | Storm) -> Harmonics:
    """Harmonic motions that a wave or sea gives the platform.

    Raises
    ------
    InputError
        When the operators do not reach a period of the wave.
    """
    amplitude, frequency, phase = components_of(wave)
    low, high = response.operators[0].period, response.operators[-1].period
    periods = 2.0 * math.pi / frequency
    beyond = periods[(periods < low * (1.0 - 1e-9)) | (periods > high * (1.0 + 1e-9))]
    if beyond.size:
        raise InputError(
            "scene",
            "platform.response.operators",
            f"a wave of {beyond[0]:.4g} s lies outside the operators",
            f"allowed is from {low:g} s to {high:g} s",
        )
    found = {name: operator(response, name, frequency) for name in response.moving}
    # cos(w t - e + phi) as a sine
    return Harmonics(
        [name for name in found for _ in frequency],
        np.concatenate([amplitude * np.abs(r) for r in found.values()]),
        np.tile(frequency, len(found)),
        np.concatenate([np.angle(r) - phase + 0.5 * math.pi for r in found.values()]),
    )
