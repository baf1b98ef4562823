"""Reference solutions of the benchmark scenes, none of which use the engine.

Static and closed-form references stand here; ``reference_heave`` (S3), ``reference_rod`` and
``reference_box`` (S2) hold the dynamic ones, whose histories are stored under ``data``.

Conventions: SI; x lateral, z up; s is unstretched arclength from the bottom; theta is measured
from the vertical towards +x, so r' = (1 + e)(sin theta, cos theta); M = EI dtheta/ds. The normal
is n = (cos theta, -sin theta). (H, V) are the x and z components of the internal force that the
upper part exerts on the lower one; T = H sin theta + V cos theta is the effective tension.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_bvp
from scipy.optimize import brentq, fsolve
from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc

DATA = Path(__file__).parent / "data"

GRAVITY = 9.81
WATER_DENSITY = 1025.0
STEEL_DENSITY = 7850.0
EA = 206e9 * np.pi / 4.0 * (0.5334**2 - 0.4826**2)
EI = 206e9 * np.pi / 64.0 * (0.5334**4 - 0.4826**4)


class Riser(NamedTuple):
    """Scenes S1 and S2: a riser pinned at the bottom, held up by a constant force at the top."""

    length: float = 533.0  # m
    axial_stiffness: float = EA  # N
    bending_stiffness: float = EI  # N m2
    weight: float = 14.4 * GRAVITY  # N/m, in water
    mass: float = 1006.0  # kg/m
    added_mass: float = WATER_DENSITY * np.pi * 1.22**2 / 4.0  # kg/m, normal only, Ca = 1
    drag: float = 0.5 * WATER_DENSITY * 1.22 * 1.0  # N s2/m3, force = drag |vn| vn
    top_force: float = 2.275e6  # N, vertical
    surface_current: float = 1.0  # m/s, U = surface_current z / length, z clipped to [0, length]

    def straight_height(self) -> float:
        """Height of the top in the straight equilibrium, m."""
        mean_tension = self.top_force - self.weight * self.length / 2.0
        return self.length * (1.0 + mean_tension / self.axial_stiffness)


class StaticRod(NamedTuple):
    """Static shape over stations s; each array has the shape of s."""

    s: np.ndarray  # m
    x: np.ndarray  # m
    z: np.ndarray  # m
    theta: np.ndarray  # rad
    tension: np.ndarray  # N
    moment: np.ndarray  # N m
    top_force: np.ndarray  # (2,), N, x and z components of the support's force on the rod


def static_current(
    stations: np.ndarray, riser: Riser = Riser(), top_height: float | None = None, tolerance: float = 1e-8
) -> StaticRod:
    """S1 (S1c): the extensible Kirchhoff rod in a sheared current, as a boundary value problem.

    H' = -drag |vn| vn cos(theta), V' = weight + drag |vn| vn sin(theta), M' = -(1 + e)(H cos(theta)
    - V sin(theta)), with vn = U(z) cos(theta). The current's kink at z = length is an interface at
    an unknown arclength, so that the collocation keeps its order.

    Parameters
    ----------
    stations : ndarray, shape (n,)
        Unstretched arclengths, m.
    riser : Riser
    top_height : float, optional
        Height at which the top is held, m (S1c); by default the vertical force is prescribed (S1).
    tolerance : float
        Relative residual allowed by the collocation.

    Raises
    ------
    RuntimeError
        If the collocation does not converge.
    """
    length, ei = riser.length, riser.bending_stiffness
    scale = np.array([10.0, length, 0.1, 1e5, 1e5, 1e6])[:, None]

    def slope(y, clipped):
        x, z, theta, moment, h, v = y * scale
        sin, cos = np.sin(theta), np.cos(theta)
        stretch = 1.0 + (h * sin + v * cos) / riser.axial_stiffness
        height = np.full_like(z, length) if clipped else z
        normal = riser.surface_current * height / length * cos
        load = riser.drag * np.abs(normal) * normal
        return np.array([
            stretch * sin,
            stretch * cos,
            moment / ei,
            -stretch * (h * cos - v * sin),
            -load * cos,
            riser.weight + load * sin,
        ]) / scale  # fmt: skip

    def both(_, y, p):
        return np.vstack([p[0] * slope(y[:6], False), (length - p[0]) * slope(y[6:], True)])

    def ends(a, b, p):
        low, kink, above, top = a[:6], b[:6], a[6:], b[6:]
        end = top[1] * length - top_height if top_height else top[5] - riser.top_force / 1e6
        return np.concatenate([low[[0, 1, 3]], kink - above, [kink[1] - 1.0, top[0], top[3], end]])

    sigma = np.linspace(0.0, 1.0, 400)
    guess = np.zeros((6, sigma.size))
    guess[1], guess[5] = sigma, (riser.top_force - riser.weight * length * (1.0 - sigma)) / 1e6
    guess[0], guess[2] = 0.5 * np.sin(np.pi * sigma), 0.3 * np.cos(np.pi * sigma)
    last = np.repeat(guess[:, -1:], sigma.size, axis=1)
    solution = solve_bvp(
        both, ends, sigma, np.vstack([guess, last]), p=[length - 0.1], tol=tolerance,
        max_nodes=200_000,
    )  # fmt: skip
    if not solution.success:
        raise RuntimeError(f"static rod: {solution.message}")
    kink = solution.p[0]
    low = solution.sol(np.clip(stations / kink, 0.0, 1.0))[:6]
    high = solution.sol(np.clip((stations - kink) / (length - kink), 0.0, 1.0))[6:]
    x, z, theta, moment, h, v = np.where(stations <= kink, low, high) * scale
    tension = h * np.sin(theta) + v * np.cos(theta)
    top = solution.sol(1.0)[[10, 11]] * scale[4:, 0]
    return StaticRod(np.asarray(stations), x, z, theta, tension, moment, top)


def lateral_frequencies(
    count: int, length: float, tension: float, bending_stiffness: float, mass: float
) -> np.ndarray:
    """S4a: circular frequencies of a tensioned beam pinned at both ends, rad/s, shape (count,)."""
    k = np.arange(1, count + 1) * np.pi / length
    return k * np.sqrt((tension + bending_stiffness * k**2) / mass)


def uniform_load(
    s: np.ndarray, length: float, tension: float, bending_stiffness: float, load: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """S4b: small-slope tensioned beam, pinned at both ends, under a uniform lateral load.

    EI w'''' - T w'' = q: w = q s(L - s)/(2T) - (q EI/T2)(1 - cosh k(s - L/2)/cosh(kL/2)), k2 = T/EI.

    Returns
    -------
    displacement (m), rotation (rad), moment EI w'' (N m), each with the shape of s.
    """
    k = np.sqrt(tension / bending_stiffness)
    half, t = length / 2.0, s - length / 2.0
    # exp form: cosh(kL/2) overflows for a long beam
    near = np.exp(k * (np.abs(t) - half)) / (1.0 + np.exp(-2.0 * k * half))
    even = near * (1.0 + np.exp(-2.0 * k * np.abs(t)))
    odd = np.sign(t) * near * (1.0 - np.exp(-2.0 * k * np.abs(t)))
    w = load / tension * (s * (length - s) / 2.0 - (1.0 - even) / k**2)
    rotation = load / tension * (-t + odd / k)
    return w, rotation, -load / k**2 * (1.0 - even)


def cantilever_tip(length: float, bending_stiffness: float, load: float) -> tuple[float, float]:
    """S4c: tip of an inextensible cantilever under a dead transverse tip load (the elastica).

    Returns the tip's distance along the undeformed axis and across it, m. With sin(theta_tip) =
    2k2 - 1, k solves K(k) - F(phi, k) = L sqrt(P/EI), sin(phi) = 1/(k sqrt 2).
    """
    alpha = length * np.sqrt(load / bending_stiffness)

    def excess(k2):
        return ellipk(k2) - ellipkinc(np.arcsin(1.0 / np.sqrt(2.0 * k2)), k2) - alpha

    k2 = brentq(excess, 0.5 * (1.0 + 1e-15), 1.0 - 1e-14, xtol=1e-16)
    phi = np.arcsin(1.0 / np.sqrt(2.0 * k2))
    along = length * np.sqrt(2.0 * (2.0 * k2 - 1.0)) / alpha
    return along, length * (1.0 - 2.0 / alpha * (ellipe(k2) - ellipeinc(phi, k2)))


def axial_frequencies(
    count: int, length: float, axial_stiffness: float, mass: float, end_mass: float = 0.0
) -> np.ndarray:
    """S4d: circular frequencies of a bar fixed at one end, with a mass (or none) at the other.

    beta tan(beta) = m L / M, beta = omega L / c; without a mass beta = (2n - 1) pi / 2.
    """
    n = np.arange(1, count + 1)
    beta = (2 * n - 1) * np.pi / 2.0
    if end_mass > 0.0:
        ratio = mass * length / end_mass
        beta = np.array([
            brentq(
                lambda b: b * np.sin(b) - ratio * np.cos(b),
                (i - 1) * np.pi, (i - 0.5) * np.pi, xtol=1e-15,
            )
            for i in n
        ])  # fmt: skip
    return beta / length * np.sqrt(axial_stiffness / mass)


class Catenary(NamedTuple):
    """S4e: an elastic catenary from its lower end A (0, 0) to its upper end B (span, rise)."""

    s: np.ndarray  # m, unstretched, from A
    x: np.ndarray  # m
    z: np.ndarray  # m
    tension: np.ndarray  # N
    horizontal: float  # N
    sag: float  # m, largest vertical distance below the chord


def catenary(
    s: np.ndarray,
    length: float = 850.0,
    weight: float = 1000.0,
    axial_stiffness: float = 5e8,
    span: float = 700.0,
    rise: float = 300.0,
) -> Catenary:
    """S4e: elastic catenary without bending, weight per unstretched length.

    References
    ----------
    Irvine, H. M., *Cable Structures*, MIT Press, 1981, section 1.4 (the suspended elastic cable).
    """

    def shape(s, h, v):
        up = v + weight * s
        x = h * s / axial_stiffness + h / weight * (np.arcsinh(up / h) - np.arcsinh(v / h))
        stretch = s * (v + weight * s / 2.0) / axial_stiffness
        return x, stretch + (np.hypot(h, up) - np.hypot(h, v)) / weight

    def miss(unknown):
        x, z = shape(length, *(unknown * weight * length))
        return np.array([x - span, z - rise]) / length

    guess = np.array([0.5, -0.2])
    unknown, _, flag, message = fsolve(miss, guess, xtol=1e-14, full_output=True)
    if flag != 1 and np.abs(miss(unknown)).max() > 1e-13:
        raise RuntimeError(f"catenary: {message}")
    h, v = unknown * weight * length
    x, z = shape(s, h, v)
    lowest = (h * rise / span - v) / weight  # where the cable runs parallel to the chord
    x_low, z_low = shape(lowest, h, v)
    sag = rise / span * x_low - z_low
    return Catenary(np.asarray(s), x, z, np.hypot(h, v + weight * np.asarray(s)), float(h), float(sag))
