"""Scene S3: a hung-off pipe with an end mass in heave, by characteristics and by finite elements.

With s from the bottom, EA u_ss = m u_tt for the motion u about the static equilibrium. With
N the dynamic tension, v = u_t and Z = sqrt(EA m), N + Z v travels down and N - Z v travels up
unchanged in tau = L sqrt(m/EA). The end mass obeys M v' = N - c |v| v at s = 0.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from reference import EA, GRAVITY, STEEL_DENSITY, WATER_DENSITY
from scipy.integrate import solve_ivp
from scipy.sparse import bmat, csr_matrix, identity

WET = (1.0 - WATER_DENSITY / STEEL_DENSITY) * GRAVITY


class Hang(NamedTuple):
    """Scene S3."""

    length: float = 1800.0  # m
    axial_stiffness: float = EA  # N
    mass: float = 318.0  # kg/m
    end_mass: float = 140e3  # kg
    drag: float = 0.5 * WATER_DENSITY * 14.0  # N s2/m2, force = drag |v| v
    amplitude: float = 2.0  # m
    period: float = 10.0  # s, also that of the ramp
    duration: float = 100.0  # s

    def static_top_tension(self) -> float:
        """Weight in water of pipe and end mass, N."""
        return WET * (self.mass * self.length + self.end_mass)

    def top(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Heave of the top about its static position, its velocity and acceleration."""
        return ramped_sine(t, self.amplitude, self.period)


class HeaveHistory(NamedTuple):
    """Motions about the static equilibrium; all of shape (time,)."""

    time: np.ndarray  # s
    bottom: np.ndarray  # m
    top_tension: np.ndarray  # N, total
    bottom_tension: np.ndarray  # N, dynamic part


def ramped_sine(t: np.ndarray, amplitude: float, period: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A sin(2 pi t/P) r(t), r = (1 - cos(pi t/P))/2 before t = P and 1 after, with two derivatives."""
    w = 2.0 * np.pi / period
    ramp = np.asarray(t) < period
    r = np.where(ramp, 0.5 * (1.0 - np.cos(0.5 * w * t)), 1.0)
    r1 = np.where(ramp, 0.25 * w * np.sin(0.5 * w * t), 0.0)
    r2 = np.where(ramp, 0.125 * w**2 * np.cos(0.5 * w * t), 0.0)
    sin, cos = np.sin(w * t), np.cos(w * t)
    return (
        amplitude * sin * r,
        amplitude * (w * cos * r + sin * r1),
        amplitude * (-(w**2) * sin * r + 2.0 * w * cos * r1 + sin * r2),
    )


def by_characteristics(time: np.ndarray, hang: Hang = Hang(), tolerance: float = 1e-11) -> HeaveHistory:
    """Exact reduction to M v' = G(t - tau) - Z v - c|v|v, G(t) = G(t - 2 tau) - 2Z v(t - tau) + 2Z v_top.

    The delay equation is integrated over one travel time after the other; the error is that of
    ``solve_ivp`` (DOP853) with the given relative tolerance.
    """
    impedance = np.sqrt(hang.axial_stiffness * hang.mass)
    tau = hang.length * np.sqrt(hang.mass / hang.axial_stiffness)
    pieces = []  # dense solutions (displacement, velocity) over [k tau, (k + 1) tau]

    def bottom(t):
        t = np.asarray(t, dtype=float)
        out = np.zeros((2, *t.shape))
        which = np.floor(t / tau).astype(int)
        for k in np.unique(which[t > 0.0]):
            here = (which == k) & (t > 0.0)
            out[:, here] = pieces[min(k, len(pieces) - 1)](t[here])
        return out

    def descending(t):
        """G = (N + Z v) at the top."""
        t, total = np.asarray(t, dtype=float), np.zeros_like(t, dtype=float)
        for echo in range(int(np.max(t, initial=0.0) / (2.0 * tau)) + 1):
            at = t - 2.0 * tau * echo
            now = 2.0 * impedance * (hang.top(at)[1] - bottom(at - tau)[1])
            total += np.where(at > 0.0, now, 0.0)
        return total

    state = np.zeros(2)
    for k in range(int(np.ceil(time[-1] / tau)) + 1):
        # G as a polynomial through Chebyshev points: it is smooth between the travelling kinks
        kinks = [hang.period + tau * j for j in range(1, 3 * int(hang.duration / tau), 2)]
        cuts = [k * tau, *[c for c in kinks if k * tau < c < (k + 1) * tau], (k + 1) * tau]
        solutions = []
        for a, b in pairwise(cuts):
            x = 0.5 * (a + b) - 0.5 * (b - a) * np.cos(np.pi * (np.arange(32) + 0.5) / 32)
            forced = np.polynomial.Chebyshev.fit(x, descending(x - tau), 24, domain=(a, b))

            def rate(t, y, forced=forced):
                push = forced(t) - impedance * y[1] - hang.drag * np.abs(y[1]) * y[1]
                return np.array([y[1], push / hang.end_mass])

            run = solve_ivp(
                rate, (a, b), state, method="DOP853", dense_output=True, rtol=tolerance, atol=1e-13
            )
            if not run.success:
                raise RuntimeError(f"heave by characteristics at t = {a:.3f} s: {run.message}")
            solutions.append((b, run.sol))
            state = run.y[:, -1]
        pieces.append(_joined(solutions))
    lower, speed = bottom(time)
    down = descending(time)
    top = down - impedance * hang.top(time)[1] + hang.static_top_tension()
    return HeaveHistory(time, lower, top, descending(time - tau) - impedance * speed)


def _joined(solutions):
    """One dense solution from several that follow each other."""

    def at(t):
        out = solutions[0][1](t)
        for (start, _), (_, dense) in pairwise(solutions):
            out = np.where(t > start, dense(t), out)
        return out

    return at


def by_spectral_elements(
    time: np.ndarray, hang: Hang = Hang(), elements: int = 40, order: int = 6, tolerance: float = 1e-8
) -> HeaveHistory:
    """The same by finite elements of Gauss-Lobatto nodes (diagonal mass) and Radau IIA.

    The top tension is the reaction at the top node, its share of the inertia included.
    """
    nodes, weights, slope = _lobatto(order)
    h = hang.length / elements
    local = slope.T @ np.diag(weights) @ slope * 2.0 * hang.axial_stiffness / h
    n = elements * order + 1
    stiffness, mass = np.zeros((n, n)), np.zeros(n)
    for e in range(elements):
        rows = np.arange(e * order, (e + 1) * order + 1)
        stiffness[np.ix_(rows, rows)] += local
        mass[rows] += hang.mass * h / 2.0 * weights
    mass[0] += hang.end_mass
    free = n - 1
    pull, spring = (
        stiffness[:free, free] / mass[:free],
        csr_matrix(stiffness[:free, :free] / mass[:free, None]),
    )

    def rate(t, y):
        u, v = y[:free], y[free:]
        a = -(spring @ u) - pull * hang.top(t)[0]
        a[0] -= hang.drag * abs(v[0]) * v[0] / mass[0]
        return np.concatenate([v, a])

    def jacobian(_, y):
        damping = csr_matrix(([-2.0 * hang.drag * abs(y[free]) / mass[0]], ([0], [0])), (free, free))
        return bmat([[None, identity(free)], [-spring, damping]], format="csc")

    run = solve_ivp(
        rate, (0.0, time[-1]), np.zeros(2 * free), method="Radau", jac=jacobian, t_eval=time,
        rtol=tolerance, atol=tolerance,
    )  # fmt: skip
    if not run.success:
        raise RuntimeError(f"heave by spectral elements: {run.message}")
    u = run.y[:free]
    heave, _, surge = hang.top(time)
    reaction = stiffness[free, :free] @ u + stiffness[free, free] * heave + mass[free] * surge
    accelerate = -(spring @ u)[0] - pull[0] * heave
    accelerate -= hang.drag * np.abs(run.y[free]) * run.y[free] / mass[0]
    inner = hang.end_mass * accelerate + hang.drag * np.abs(run.y[free]) * run.y[free]
    return HeaveHistory(time, u[0], reaction + hang.static_top_tension(), inner)


def _lobatto(order: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Gauss-Lobatto nodes and weights on [-1, 1] and the nodal derivative matrix."""
    legendre = np.polynomial.Legendre.basis(order)
    x = np.concatenate([[-1.0], np.sort(legendre.deriv().roots()), [1.0]])
    p = legendre(x)
    gap = x[:, None] - x + np.eye(order + 1)
    slope = p[:, None] / p / gap * (1.0 - np.eye(order + 1))
    slope -= np.diag(slope.sum(axis=1))
    return x, 2.0 / (order * (order + 1) * p**2), slope
