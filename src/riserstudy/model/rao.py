r"""Platform motion in a wave or sea: every component times the response amplitude operators.

.. math:: S(t) = \sum_j a_j\,|R(\omega_j)| \cos(\omega_j t - \varepsilon_j + \varphi(\omega_j))

for a surface :math:`\sum_j a_j \cos(\omega_j t - \varepsilon_j)` at the platform (Liu et al. 2020, Eq. 12;
its constant offset is the platform's position). Between the lines of the table R is linear over
frequency and heading in its real and imaginary parts, so that phases cross 180 degrees without harm.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError
from riserstudy.model.sea import components_of
from riserstudy.scene.rao import Operator, Response
from riserstudy.scene.sea import Storm, Swell, Wave

FloatArray = NDArray[np.float64]

CLOSE = 1e-9  # headings that are one (rad)
WIDEST = 0.5 * math.pi  # gap between headings that is filled (rad)


class Harmonics(NamedTuple):
    """Motions amplitude sin(frequency t + phase), one row each."""

    motion: list[str]
    amplitude: FloatArray  # m or rad
    frequency: FloatArray  # rad/s
    phase: FloatArray  # rad


def operator(
    response: Response, motion: str, frequency: FloatArray, heading: float = 0.0
) -> NDArray[np.complex128]:
    """R of one motion in waves that go to a heading (rad), leading phases positive.

    It has the shape of the frequencies (rad/s); per metre of wave, m/m or rad/m.

    Raises
    ------
    InputError
        When the operators do not reach the heading.
    """
    tables = response.by_heading
    if None in tables:
        return _over_frequency(response, tables[None], motion, frequency)
    turns = {
        math.remainder(known, 2.0 * math.pi) + turn: rows
        for known, rows in tables.items()
        if known is not None
        for turn in (-2.0 * math.pi, 0.0, 2.0 * math.pi)
    }
    heading = math.remainder(heading, 2.0 * math.pi)
    below = max((known for known in turns if known <= heading + CLOSE), default=math.nan)
    above = min((known for known in turns if known >= heading - CLOSE), default=math.nan)
    if not above - below <= WIDEST + CLOSE:
        listed = ", ".join(
            f"{math.degrees(math.remainder(known or 0.0, 2.0 * math.pi)):g}" for known in tables
        )
        raise InputError(
            "scene",
            "platform.response.operators",
            f"waves that go to {math.degrees(heading):.4g} deg lie between no two headings",
            f"allowed are headings up to a quarter turn apart; those of the operators go to {listed} deg",
        )
    share = (heading - below) / (above - below) if above - below > CLOSE else 0.0
    ends = [_over_frequency(response, turns[known], motion, frequency) for known in (below, above)]
    return np.asarray((1.0 - share) * ends[0] + share * ends[1])


def _over_frequency(
    response: Response, rows: list[Operator], motion: str, frequency: FloatArray
) -> NDArray[np.complex128]:
    sign = 1.0 if response.phases == "lead" else -1.0
    at = np.array([row.circular for row in rows])
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
        When the operators do not reach a period or the heading of the wave.
    """
    amplitude, frequency, phase = components_of(wave)
    known = next(iter(response.by_heading.values()))
    low, high = 2.0 * math.pi / known[-1].circular, 2.0 * math.pi / known[0].circular
    periods = 2.0 * math.pi / frequency
    beyond = periods[(periods < low * (1.0 - 1e-9)) | (periods > high * (1.0 + 1e-9))]
    if beyond.size:
        raise InputError(
            "scene",
            "platform.response.operators",
            f"a wave of {beyond[0]:.4g} s lies outside the operators",
            f"allowed is from {low:g} s to {high:g} s",
        )
    heading = (wave.heading if isinstance(wave, Wave) else response.heading) or 0.0
    found = {name: operator(response, name, frequency, heading) for name in response.moving}
    # cos(w t - e + phi) as a sine
    return Harmonics(
        [name for name in found for _ in frequency],
        np.concatenate([amplitude * np.abs(r) for r in found.values()]),
        np.tile(frequency, len(found)),
        np.concatenate([np.angle(r) - phase + 0.5 * math.pi for r in found.values()]),
    )
