"""The printed model of Chang et al. 2020 beside the engine: one ordinary differential equation.

m x'' = F(x - a) - m g - c (x' - a') - k x with a = A sin(2 pi t / T), numbers as printed.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

MASS, STIFFNESS, GRAVITY = 7.49e5, 3.430e6, 9.81
CYLINDERS, DAMPING = 4, 4 * 967.0
AREA, VOLUME, PRESSURE, EXPONENT = 0.25 * np.pi * 0.470**2, 3.2, 190.2e5, 1.4
TIGHT = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-12}


def gas_law(piston):
    """Force of all cylinders (N) over X (m), Eqs. 3 and 4."""
    return CYLINDERS * AREA * PRESSURE * (1.0 + AREA * piston / VOLUME) ** -EXPONENT


def fitted_line(reach=8.0):
    """Intercept (N) and slope (N/m) of the line least squares fit to the gas law over -reach..reach."""
    mean = quad(gas_law, -reach, reach, epsrel=1e-13)[0] / (2.0 * reach)
    tilt = quad(lambda piston: piston * gas_law(piston), -reach, reach, epsrel=1e-13)[0]
    intercept, slope = mean, tilt / (2.0 / 3.0 * reach**3)
    return intercept, slope


INTERCEPT, SLOPE = fitted_line()


def linear_law(piston):
    """Force of all cylinders (N) over X (m), Fig 9."""
    return INTERCEPT + SLOPE * piston


LAWS: dict[str, Callable] = {"gas law": gas_law, "linear": linear_law}


class Heave(NamedTuple):
    """Motion of the platform."""

    amplitude: float
    period: float = 20.0

    def at(self, t):
        """Displacement and velocity."""
        w = 2.0 * np.pi / self.period
        return self.amplitude * np.sin(w * t), self.amplitude * w * np.cos(w * t)


def rate(t, state, law, heave):
    """Velocity and acceleration of the ring."""
    x, v = state
    a, da = heave.at(t)
    force = law(x - a) - MASS * GRAVITY - DAMPING * (v - da) - STIFFNESS * x
    return [v, force / MASS]


def history(law, heave, times, start=(0.0, 0.0)):
    """Heave and velocity of the ring at times that rise from 0."""
    span = (0.0, float(times[-1]))
    return solve_ivp(rate, span, start, t_eval=times, args=(law, heave), **TIGHT).y


def periodic(law, heave, guess):
    """Heave and velocity over one settled period at 2001 times, by shooting."""
    times = np.linspace(0.0, heave.period, 2001)

    def gap(start):
        return history(law, heave, times[[0, -1]], start)[:, -1] - start

    start = np.asarray(guess, float)
    for _ in range(30):
        off = gap(start)
        if np.abs(off).max() < 1e-10:
            break
        size = 1e-6
        columns = [(gap(start + size * unit) - off) / size for unit in np.eye(2)]
        start = start - np.linalg.solve(np.column_stack(columns), off)
    else:
        raise ArithmeticError("shooting did not converge")
    return times, history(law, heave, times, start)


def equilibrium(law, a=0.0):
    """Heave of the ring at rest with the platform at rest at a."""
    lowest = a - VOLUME / AREA + 0.01 if law is gas_law else -50.0
    return brentq(lambda x: law(x - a) - MASS * GRAVITY - STIFFNESS * x, lowest, 50.0, xtol=1e-13, rtol=1e-14)
