r"""Motion of a semi-submersible in head waves by a formula: plausible and generic, not of a real unit.

Twin pontoons (volume :math:`V_p`, length :math:`L`, centre at depth :math:`d_p`) carry columns (volume
:math:`V_c`, waterplane :math:`A_w`, spacing :math:`b`, reaching down to :math:`d_c`). Deep water,
:math:`k = \omega^2/g`, surface :math:`\cos(kx - \omega t)`, x in the direction of wave travel, motion
:math:`\Re\,(R\,e^{i\omega t})` at the middle. The loads are forces of the undisturbed water on displaced and
added mass, and pressure under the columns; :math:`u = kL/2`.

.. math::

    R_{heave} &= \frac{C_3 e^{-k d_c} \cos\tfrac{kb}{2} + (i\omega B_3 - \omega^2 (\rho V_p + A_3))
        e^{-k d_p} \frac{\sin u}{u}}{C_3 - \omega^2 (M + A_3) + i\omega B_3} \\
    R_{surge} &= -i\,\frac{\rho V_c (1 + a_c) \frac{1 - e^{-k d_c}}{k d_c} \cos\tfrac{kb}{2}
        + \rho V_p (1 + a_x) e^{-k d_p} \frac{\sin u}{u}}{M + \rho V_c a_c + \rho V_p a_x} \\
    R_{pitch} &= i k\,\frac{C_5 e^{-k d_c} \frac{\sin (kb/2)}{kb/2} + (i\omega B_5 - \omega^2 (I_w + A_5))
        e^{-k d_p} \frac{3(\sin u - u \cos u)}{u^3}}{C_5 - \omega^2 (I + A_5) + i\omega B_5}

At long periods, heave and surge follow the water, and pitch follows the slope of the wave. Where the two
parts of a numerator cancel, the motion vanishes; near its natural period, it resonates. Mooring is neglected.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.strict import Strict
from riserstudy.inputs.validate import check
from riserstudy.scene import units as u
from riserstudy.scene.base import POSITIVE, Coefficient

DENSITY, GRAVITY = 1025.0, 9.81
#: periods of tables (s), closer where loads on columns and pontoons cancel, and near the heave resonance
CLOSE = (4.0, 10.0), (19.0, 25.0)
PERIODS = np.unique(
    np.concatenate(
        [
            np.arange(2.0, 30.0, 0.5),
            np.arange(30.0, 61.0, 2.0),
            *(np.arange(low, high, 0.1) for low, high in CLOSE),
        ]
    ).round(6)
)


class Semisubmersible(Strict):
    """Dimensions of a unit, and the coefficients of its added mass and damping."""

    because: str
    waterplane: Annotated[u.Area, POSITIVE]
    column_spacing: Annotated[u.Length, POSITIVE]
    column_depth: Annotated[u.Length, POSITIVE]
    pontoon_volume: Annotated[u.Volume, POSITIVE]
    pontoon_length: Annotated[u.Length, POSITIVE]
    pontoon_depth: Annotated[u.Length, POSITIVE]
    radius_of_gyration: Annotated[u.Length, POSITIVE]
    metacentric_height: Annotated[u.Length, POSITIVE]
    pontoon_added_mass_vertical: Coefficient
    pontoon_added_mass_along: Coefficient
    column_added_mass: Coefficient
    heave_damping: Annotated[float, Field(gt=0, lt=1)]  # share of critical
    pitch_damping: Annotated[float, Field(gt=0, lt=1)]


class Oscillator(NamedTuple):
    """Mass with added mass, damping and stiffness of one motion."""

    mass: float
    damping: float
    stiffness: float

    @property
    def period(self) -> float:
        """Natural period (s)."""
        return float(2.0 * np.pi * np.sqrt(self.mass / self.stiffness))

    def answer(self, w: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Load divided by motion, complex, at angular frequencies w (rad/s)."""
        return np.asarray(self.stiffness - w**2 * self.mass + 1j * w * self.damping)


def heave(unit: Semisubmersible) -> Oscillator:
    """Return the oscillator of the unit in heave."""
    pontoons, columns = _masses(unit)
    mass = pontoons * (1.0 + unit.pontoon_added_mass_vertical) + columns
    stiffness = DENSITY * GRAVITY * unit.waterplane
    return Oscillator(mass, 2.0 * unit.heave_damping * np.sqrt(mass * stiffness), stiffness)


def pitch(unit: Semisubmersible) -> Oscillator:
    """Return the oscillator of the unit in pitch."""
    displacement = sum(_masses(unit))
    inertia = displacement * unit.radius_of_gyration**2 + _added_inertia(unit)
    stiffness = displacement * GRAVITY * unit.metacentric_height
    return Oscillator(inertia, 2.0 * unit.pitch_damping * np.sqrt(inertia * stiffness), stiffness)


def response(unit: Semisubmersible, period: NDArray[np.float64]) -> dict[str, NDArray[np.complex128]]:
    """Complex amplitudes of surge (m/m), heave (m/m) and pitch (rad/m, positive in wave direction)."""
    w = 2.0 * np.pi / np.asarray(period)
    k = w**2 / GRAVITY
    pontoons, columns = _masses(unit)
    half, along = 0.5 * k * unit.column_spacing, 0.5 * k * unit.pontoon_length
    under, around = np.exp(-k * unit.column_depth), np.exp(-k * unit.pontoon_depth)
    mean, lever = np.sinc(along / np.pi), 3.0 * (np.sin(along) - along * np.cos(along)) / along**3

    up = heave(unit)
    moved = pontoons * (1.0 + unit.pontoon_added_mass_vertical)
    lift = up.stiffness * under * np.cos(half)
    lift = lift + (1j * w * up.damping - w**2 * moved) * around * mean

    c, x = unit.column_added_mass, unit.pontoon_added_mass_along
    depth = k * unit.column_depth
    push = columns * (1.0 + c) * (1.0 - under) / depth * np.cos(half)
    push = push + pontoons * (1.0 + x) * around * mean

    tilt = pitch(unit)
    water = _water_inertia(unit) + _added_inertia(unit)
    turn = tilt.stiffness * under * np.sinc(half / np.pi)
    turn = turn + (1j * w * tilt.damping - w**2 * water) * around * lever
    found = {
        "surge": -1j * push / (pontoons * (1.0 + x) + columns * (1.0 + c)),
        "heave": lift / up.answer(w),
        "pitch": 1j * k * turn / tilt.answer(w),
    }
    return {name: np.asarray(values, np.complex128) for name, values in found.items()}


def table(unit: Semisubmersible) -> str:
    """Return the response as CSV: amplitudes per metre of wave amplitude, and phase leads of the motions."""
    found = response(unit, PERIODS)
    units = {"surge": "m/m", "heave": "m/m", "pitch": "deg/m"}
    heading = [f"{name} ({of}),{name}_phase (deg)" for name, of in units.items()]
    lines = [",".join(["period (s)", *heading])]
    found["pitch"] *= 180.0 / np.pi
    for row, period in enumerate(PERIODS):
        pairs = [f"{abs(found[name][row]):.6f},{np.angle(found[name][row], deg=True):.3f}" for name in units]
        lines.append(",".join([f"{period:g}", *pairs]))
    return "\n".join(lines) + "\n"


def _masses(unit: Semisubmersible) -> tuple[float, float]:
    """Masses of water displaced by pontoons and by columns (kg)."""
    columns = unit.waterplane * unit.column_depth
    return DENSITY * unit.pontoon_volume, DENSITY * columns


def _added_inertia(unit: Semisubmersible) -> float:
    """Added inertia of the pontoons in pitch (kg m2)."""
    added = unit.pontoon_added_mass_vertical * _masses(unit)[0]
    return added * unit.pontoon_length**2 / 12.0


def _water_inertia(unit: Semisubmersible) -> float:
    """Inertia of the water that pontoons and columns displace, in pitch (kg m2)."""
    pontoons, columns = _masses(unit)
    return pontoons * unit.pontoon_length**2 / 12.0 + 0.25 * columns * unit.column_spacing**2


def read_units(path: Path) -> dict[str, Semisubmersible]:
    """Read the units of a file, by name."""
    tree = read_yaml(path)
    return {name: check(Semisubmersible, unit, f"{path}: {name}") for name, unit in tree.items()}
