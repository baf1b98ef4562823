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
from riserstudy.records.arrays import FloatArray
from riserstudy.records.warning import RunWarning, Value, sentence, warning
from riserstudy.scene.rao import TILTS, Operator, Response
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sea import Storm, Swell
from riserstudy.scene.units import GRAVITY

# largest plausible median ratio of angle to wave slope; degrees read as radians give about 57
STEEP = 5.0
TURNS = 4.0 * math.pi  # rad, largest plausible phase
PATH = "platform.response.operators"


class Harmonics(NamedTuple):
    """Motions amplitude sin(frequency t + phase), one row each."""

    motion: list[str]
    amplitude: FloatArray  # m or rad
    frequency: FloatArray  # rad/s
    phase: FloatArray  # rad


def operator(
    response: Response, motion: str, frequency: FloatArray, heading: float = 0.0
) -> NDArray[np.complex128]:
    """R of one motion in waves that travel to a heading (rad), with leading phases positive.

    R has the shape of the frequencies (rad/s), and is per metre of wave amplitude, in m/m or rad/m. Raises
    InputError when the operators do not cover the heading.
    """
    parts = response.around(heading)
    if not parts:
        listed = ", ".join(
            f"{math.degrees(math.remainder(known or 0.0, 2.0 * math.pi)):g}" for known in response.by_heading
        )
        raise InputError(
            "scene",
            PATH,
            "no two headings within 90 deg of each other enclose the direction of the waves, "
            f"{math.degrees(math.remainder(heading, 2.0 * math.pi)):.4g} deg",
            f"add headings (present: {listed} deg)",
        )
    return np.asarray(sum(w * _over_frequency(response, rows, motion, frequency) for w, rows in parts))


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


def doubts(scene: Resolved) -> list[RunWarning]:
    """Warnings about a response: wave components outside its operators, and values in the wrong unit."""
    response = scene.platform and scene.platform.response
    wave = response and (response.wave or scene.wave)
    if not response or not wave:
        return []
    amplitude, frequency, _ = components_of(wave)
    found = slips(response, scene.gravity or GRAVITY)
    if _beyond(response, frequency).any():
        held = "cause no motion" if response.beyond == "zero" else "use the operator at the nearest period"
        outside = _uncovered(response, amplitude, frequency)
        values = outside["values"] | {"held": held}
        found.append(warning(outside["kind"], outside["text"] + "; they {held}", values))
    return found


def slips(response: Response, gravity: float) -> list[RunWarning]:
    """Warnings about angles that look like degrees in a column of radians, or radians in a column of degrees.

    Long waves rotate a platform by their slope, w^2 amplitude / g (gravity in m/s2), and shorter waves by
    less. Only near resonance is the rotation several times the slope. The median of a table is checked.
    """
    found = _turned(response)
    rows = response.operators
    slope = np.array([row.circular**2 / gravity for row in rows])
    for name in (tilt for tilt in TILTS if tilt in response.moving and tilt != "yaw"):
        ratio = float(np.median([getattr(row, name) for row in rows] / slope))
        if ratio > STEEP:
            text = "{name} is {ratio:.3g} times the slope of the waves (median)"
            found.append(_slip("tilts_in_degrees", text, name=name, ratio=ratio))
    phases = np.abs([getattr(row, f"{name}_phase") for row in rows for name in response.moving])
    largest = float(phases.max())
    if largest > TURNS:
        found.append(_slip("phases_in_degrees", "phases reach {largest:.4g} rad", largest=largest))
    elif 0.0 < largest <= math.radians(math.pi) and len(set(phases.tolist())) > 2:
        text = "no phase is above {largest:.3g} deg"
        found.append(_slip("phases_in_radians", text, largest=math.degrees(largest)))
    return found


def _turned(response: Response) -> list[RunWarning]:
    """A warning about headings of several turns, or of a few degrees only."""
    headings = {abs(row.heading) for row in response.operators if row.heading is not None}
    largest = max(headings, default=0.0)
    if largest > TURNS:
        return [_slip("headings_in_degrees", "headings reach {largest:.4g} rad", largest=largest)]
    if len(headings) > 2 and largest <= math.radians(2.0 * math.pi):
        text = "no heading is above {largest:.3g} deg"
        return [_slip("headings_in_radians", text, largest=math.degrees(largest))]
    return []


def _slip(kind: str, text: str, **values: Value) -> RunWarning:
    units = ("degrees", "radians")
    of_numbers, of_heading = units if kind.endswith(units[0]) else reversed(units)
    why = f"are the numbers in {of_numbers}, although the column heading states {of_heading}?"
    return warning(kind, f"{PATH}: {text}: {why}", values)


def _beyond(response: Response, frequency: FloatArray) -> NDArray[np.bool_]:
    """For each frequency (rad/s), whether it is outside the operators."""
    low, high = _range(response)
    return np.asarray((frequency < low * (1.0 - 1e-9)) | (frequency > high * (1.0 + 1e-9)))


def _range(response: Response) -> tuple[float, float]:
    known = next(iter(response.by_heading.values()))
    return known[0].circular, known[-1].circular


def _uncovered(response: Response, amplitude: FloatArray, frequency: FloatArray) -> RunWarning:
    """A statement of the share of a sea that the operators do not cover."""
    beyond = _beyond(response, frequency)
    periods = 2.0 * math.pi / frequency[beyond]
    low, high = _range(response)
    energy = float((amplitude[beyond] ** 2).sum() / (amplitude**2).sum())
    kind, span, ends = "wave_outside_operators", "{period:.4g} s", {"period": periods.min()}
    if len(set(periods)) > 1:
        kind, span = "waves_outside_operators", "{from:.4g} to {to:.4g} s"
        ends = {"from": periods.min(), "to": periods.max()}
    text = (
        f"{{beyond}} of {{all}} wave components ({span}, {{energy:.3g}} % of the energy) lie outside the "
        "periods of the operators, {shortest:g} s to {longest:g} s"
    )
    ends |= {"shortest": 2.0 * math.pi / high, "longest": 2.0 * math.pi / low, "energy": 100.0 * energy}
    return warning(kind, text, ends | {"beyond": int(beyond.sum()), "all": len(frequency)})


def harmonics(response: Response, wave: Swell | Storm, lag: FloatArray | float = 0.0) -> Harmonics:
    """Harmonic motions of the platform in a wave or sea.

    ``lag``: (components,) phase by which each component is later at the platform than at the origin (rad).
    Raises InputError when the operators do not cover a period or the heading of the wave.
    """
    amplitude, frequency, phase = components_of(wave)
    beyond = _beyond(response, frequency)
    if beyond.any() and response.beyond in (None, "refuse"):
        allowed = "extend the operators, or give 'beyond: hold' (nearest value) or 'beyond: zero' (no motion)"
        outside = sentence(_uncovered(response, amplitude, frequency))
        raise InputError("scene", PATH, outside, allowed)
    heading = response.heading_of(wave)
    share = np.where(beyond & (response.beyond == "zero"), 0.0, 1.0)
    operators = {name: share * operator(response, name, frequency, heading) for name in response.moving}
    # cos(w t - e + phi) as a sine
    return Harmonics(
        [name for name in operators for _ in frequency],
        np.concatenate([amplitude * np.abs(r) for r in operators.values()]),
        np.tile(frequency, len(operators)),
        np.concatenate([np.angle(r) - phase - lag + 0.5 * math.pi for r in operators.values()]),
    )
