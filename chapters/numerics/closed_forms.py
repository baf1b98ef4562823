"""Closed forms and second methods that the engine is compared with; none of them uses the engine.

All units are SI; s counts from the lower end; a bending moment is EI times curvature.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from riserstudy.records.arrays import FloatArray

GRAVITY, DENSITY = 9.81, 1025.0  # gravity in m/s2, density of sea water in kg/m3


class Chamber(NamedTuple):
    """Gas on one side of a piston."""

    area: float  # m2
    pressure: float  # Pa, at mid-stroke
    volume: float  # m3, at mid-stroke


def taut_beam_frequency(mode: int, length: float, tension: float, bending: float, mass: float) -> float:
    """Frequency (rad/s) of a beam under tension (N), pinned at both ends."""
    k = mode * math.pi / length
    return k * math.sqrt((tension + bending * k * k) / mass)


def bar_frequency(mode: int, length: float, stiffness: float, mass: float) -> float:
    """Frequency (rad/s) of waves along a bar that is fixed at one end; stiffness EA (N)."""
    return (mode - 0.5) * math.pi / length * math.sqrt(stiffness / mass)


def hanging_chain_frequency(mode: int, length: float, weight: float, mass: float) -> float:
    """Frequency (rad/s) of a hanging chain (Bernoulli): half a zero of J0 times the root of w / (m L)."""
    from scipy.special import jn_zeros

    return float(jn_zeros(0, mode)[-1]) / 2.0 * math.sqrt(weight / (mass * length))


def beam_on_varying_tension(
    length: float, low: float, weight: float, bending: float, mass: float, points: int = 48
) -> float:
    """Lowest frequency (rad/s) of a pinned beam; tension: ``low`` (N) at its foot, plus its weight (N/m).

    (EI y'')'' - (T y')' = m w^2 y, by collocation at Chebyshev's points.
    """
    from scipy.linalg import eig

    d, x = _chebyshev(points)
    d, s = d * 2.0 / length, 0.5 * length * (x + 1.0)
    second = d @ d
    left = bending * second @ second - d @ np.diag(low + weight * s) @ d
    right = mass * np.eye(points + 1)
    for row, of in ((0, np.eye(points + 1)[0]), (points, np.eye(points + 1)[points])):
        left[row], right[row] = of, 0.0
    for row, of in ((1, second[0]), (points - 1, second[points])):
        left[row], right[row] = of, 0.0
    square = eig(left, right, right=False)
    real = square[np.isfinite(square) & (np.abs(square.imag) < 1e-6 * np.abs(square))].real
    return math.sqrt(float(np.sort(real[real > 0.0])[0]))


def _chebyshev(n: int) -> tuple[FloatArray, FloatArray]:
    """Derivative matrix at Chebyshev's points, and the points from 1 to -1 (Trefethen, cheb)."""
    x = np.cos(np.pi * np.arange(n + 1) / n)
    c = np.ones(n + 1)
    c[[0, -1]] = 2.0
    c *= (-1.0) ** np.arange(n + 1)
    apart = x[:, None] - x[None, :]
    d = np.outer(c, 1.0 / c) / (apart + np.eye(n + 1))
    return d - np.diag(d.sum(axis=1)), x


def self_buckling() -> float:
    """Weight per length times L^3 / EI at which a column, clamped below, buckles under it (Greenhill)."""
    from scipy.optimize import brentq
    from scipy.special import jv

    zero = float(brentq(lambda x: jv(-1.0 / 3.0, x), 1.5, 2.2, xtol=1e-14))
    return 2.25 * zero * zero


class Bent(NamedTuple):
    """Largest displacement (m) and moment (N m) of a beam."""

    displacement: float
    moment: float


def taut_beam_under_load(length: float, tension: float, bending: float, load: float) -> Bent:
    """Middle of a pinned beam under tension (N) and a uniform load (N/m): EI w'''' - T w'' = q."""
    half = 0.5 * length * math.sqrt(tension / bending)
    lost = 1.0 - 2.0 * math.exp(-half) / (1.0 + math.exp(-2.0 * half))  # 1 - 1 / cosh
    w = load / tension * (length**2 / 8.0 - bending / tension * lost)
    return Bent(w, load * bending / tension * lost)


def elastica_tip(length: float, bending: float, load: float) -> tuple[float, float]:
    """Tip position (m) of a cantilever, along and across its undeformed axis, under a dead load (N) across.

    The inextensible elastica, by elliptic integrals; the sine of the tip's rotation is 2 p - 1.
    """
    from scipy.optimize import brentq
    from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc

    alpha = length * math.sqrt(load / bending)

    def turn(p: float) -> float:
        return math.asin(1.0 / math.sqrt(2.0 * p))

    def excess(p: float) -> float:
        return float(ellipk(p) - ellipkinc(turn(p), p)) - alpha

    p = float(brentq(excess, 0.5 * (1.0 + 1e-15), 1.0 - 1e-14, xtol=1e-16))
    across = length * (1.0 - 2.0 / alpha * float(ellipe(p) - ellipeinc(turn(p), p)))
    return length * math.sqrt(2.0 * (2.0 * p - 1.0)) / alpha, across


class Cable(NamedTuple):
    """Tension (N) of an elastic catenary at its upper end, and its horizontal part."""

    upper: float
    horizontal: float


def elastic_catenary(length: float, weight: float, stiffness: float, span: float, rise: float) -> Cable:
    """Cable between two ends (Irvine, Cable Structures, 1981, 1.4); weight (N/m), stiffness EA (N)."""
    from scipy.optimize import fsolve

    def miss(unknown: FloatArray) -> FloatArray:
        h, v = unknown * weight * length
        up = v + weight * length
        x = h * length / stiffness + h / weight * (math.asinh(up / h) - math.asinh(v / h))
        z = length * (v + 0.5 * weight * length) / stiffness
        z += (math.hypot(h, up) - math.hypot(h, v)) / weight
        return np.array([x - span, z - rise]) / length

    h, v = fsolve(miss, np.array([0.5, -0.2]), xtol=1e-14) * weight * length
    return Cable(math.hypot(h, v + weight * length), float(h))


class Flow(NamedTuple):
    """A riser in a steady uniform current, pinned at its foot, with an upward force at its top."""

    length: float  # m
    stiffness: float  # EA, N
    bending: float  # EI, N m2
    weight: float  # N/m
    drag: float  # N s2/m3, half of density, diameter and coefficient
    speed: float  # m/s
    top: float  # N, upwards


def rod_in_current(flow: Flow) -> Bent:
    """Largest displacement (m) and moment (N m) of a rod that stretches and bends, by collocation.

    H' = -q cos a, V' = w + q sin a, M' = -(1 + e)(H cos a - V sin a), a' = M / EI, q = drag (u cos a)^2.
    """
    from scipy.integrate import solve_bvp

    scale = np.array([10.0, flow.length, 0.1, 1e5, 1e5, 1e6])[:, None]

    def slope(_: FloatArray, y: FloatArray) -> FloatArray:
        _, _, turn, moment, h, v = y * scale
        sine, cosine = np.sin(turn), np.cos(turn)
        stretch = 1.0 + (h * sine + v * cosine) / flow.stiffness
        load = flow.drag * flow.speed**2 * cosine * np.abs(cosine)
        rows = [
            stretch * sine,
            stretch * cosine,
            moment / flow.bending,
            -stretch * (h * cosine - v * sine),
            -load * cosine,
            flow.weight + load * sine,
        ]
        return np.asarray(np.array(rows) * flow.length / scale)

    def ends(a: FloatArray, b: FloatArray) -> FloatArray:
        return np.array([a[0], a[1], a[3], b[0], b[3], b[5] - flow.top / scale[5, 0]])

    share = np.linspace(0.0, 1.0, 400)
    guess = np.zeros((6, share.size))
    guess[1], guess[5] = share, flow.top / scale[5, 0]
    solution = solve_bvp(slope, ends, share, guess, tol=1e-9, max_nodes=200_000)
    fine = solution.sol(np.linspace(0.0, 1.0, 20_001)) * scale
    return Bent(float(np.abs(fine[0]).max()), float(np.abs(fine[3]).max()))


def towed_angle(weight: float, drag: float, speed: float) -> float:
    """Angle (rad) from the vertical at which a string hangs in a steady current: w sin a = q cos^2 a."""
    ratio = weight / (drag * speed**2)
    return math.asin(0.5 * (-ratio + math.sqrt(ratio**2 + 4.0)))


def compound_pendulum(length: float, mass: float, weight: float, end: float, arm: float) -> float:
    """Frequency (rad/s) of a rod (``mass`` kg/m, no weight) with a body (``end`` kg, ``weight`` N) below."""
    far = length + arm
    return math.sqrt(weight * far / (end * far**2 + mass * length**3 / 3.0))


def gas_pull(area: float, pressure: float, volume: float, exponent: float, reach: float) -> float:
    """Pull (N) of a gas cylinder at an extension ``reach`` (m), with constant p V^n."""
    return area * pressure * math.pow(volume / (volume - area * reach), exponent)


def gas_work(area: float, pressure: float, volume: float, exponent: float, reach: float) -> float:
    """Work (J) that extends a gas cylinder by ``reach`` (m), the integral of its pull; exponent above 1."""
    over = exponent - 1.0
    pressed = math.pow(volume / (volume - area * reach), over) - 1.0
    return pressure * volume / over * pressed


def fall_of_a_bar(lost: float, stiffness: float, mass: float, time: float) -> float:
    """Fall (m) of the top of a long bar in a time (s) after it lost a pull (N): d'Alembert."""
    return lost * time / math.sqrt(stiffness * mass)


def wave_number(period: float, depth: float) -> float:
    """Wave number (1/m) of a small wave from its period (s) and the depth (m): w^2 = g k tanh(k h)."""
    square = (2.0 * math.pi / period) ** 2 / GRAVITY
    return float(brentq(lambda k: k * math.tanh(k * depth) - square, 1e-9, 10.0 * (square + 1.0)))


def pile_by_inertia(added: float, diameter: float, height: float, period: float, depth: float) -> float:
    """Largest moment (N m) at the foot of a stiff pile by Morison's inertia force up to the mean level."""
    k, rate = wave_number(period, depth), 2.0 * math.pi / period
    arm = depth * math.sinh(k * depth) / k - (math.cosh(k * depth) - 1.0) / k**2
    moved = DENSITY * (1.0 + added) * 0.25 * math.pi * diameter**2
    return moved * 0.5 * height * rate**2 * arm / math.sinh(k * depth)


def pile_by_drag(coefficient: float, diameter: float, height: float, period: float, depth: float) -> float:
    """Moment (N m) at the foot of a stiff pile by Morison's drag, below the crest."""
    k = wave_number(period, depth)
    speed = math.pi * height / period / math.sinh(k * depth)
    arm = depth**2 / 4.0 + depth * math.sinh(2.0 * k * depth) / (4.0 * k)
    arm -= (math.cosh(2.0 * k * depth) - 1.0) / (8.0 * k**2)
    return 0.5 * DENSITY * coefficient * diameter * speed**2 * arm


def driven(force: float, drag: float, mass: float, time: float) -> tuple[float, float]:
    """Speed (m/s) and distance (m) at a time (s) of a mass that a force drives against quadratic drag.

    The speed approaches the terminal speed, at which drag equals the force.
    """
    terminal, scale = math.sqrt(force / drag), mass / math.sqrt(force * drag)
    return terminal * math.tanh(time / scale), terminal * scale * math.log(math.cosh(time / scale))


def two_chambers(high: Chamber, low: Chamber, exponent: float, reach: float) -> tuple[float, float]:
    """Pull (N) and stiffness (N/m) of a direct-acting cylinder extended by ``reach`` (m), p V^n constant.

    Extension compresses the gas of the high chamber and expands the gas of the low chamber.
    """
    pull, stiffness = 0.0, 0.0
    for (area, pressure, volume), sign in ((high, 1.0), (low, -1.0)):
        now = volume - sign * area * reach
        force = area * pressure * math.pow(volume / now, exponent)
        pull += sign * force
        stiffness += exponent * force * area / now
    return pull, stiffness


def decrement(ratio: float) -> float:
    """Logarithm of the ratio of two successive peaks of a free oscillation with a given damping ratio."""
    return 2.0 * math.pi * ratio / math.sqrt(1.0 - ratio**2)
