"""Scene S2 (and statics): geometrically exact planar rod, quintic Hermite elements, Radau IIA.

The position r(s, t) is interpolated with r, r' and r'' at the nodes, so that curvature is
continuous. With p = r', k = r'', l = |p|, n = (p_z, -p_x)/l: strain e = l - 1, curvature
theta' = (k_x p_z - p_x k_z)/l2, energy EA e2/2 + EI theta'2/2, consistent inertia
m r.. + m_a (r.. . n) n and drag c |v_n| v_n n, all by Gauss points. No lumping, no shear, no
rotary inertia. Time: collocation with three stages (Radau IIA of order 5 or Gauss of order 6),
full Newton on the coupled stages with an exact tangent.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from reference import Riser
from reference_heave import ramped_sine
from scipy.linalg import solve_banded

WIDTH = 12  # degrees of freedom of an element: two nodes with x, hx', h2x'', z, hz', h2z''


class RodHistory(NamedTuple):
    """Motion of the rod at stations (m from the bottom) and times."""

    time: np.ndarray  # (time,), s
    stations: np.ndarray  # (station,), m
    x: np.ndarray  # (time, station), m
    z: np.ndarray  # (time, station), m
    moment: np.ndarray  # (time, station), N m
    top_force: np.ndarray  # (time, 2), N, x and z components of the support's force on the rod


def collocation(name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Butcher arrays A, b, c of the three-stage Radau IIA or Gauss method."""
    if name == "radau":
        root = np.sqrt(6.0)
        c = np.array([(4.0 - root) / 10.0, (4.0 + root) / 10.0, 1.0])
    else:
        c = 0.5 + np.sqrt(0.15) * np.array([-1.0, 0.0, 1.0])
    powers = np.arange(1, 4)
    vandermonde = c[:, None] ** (powers - 1)
    inverse = np.linalg.inv(vandermonde)
    return (c[:, None] ** powers / powers) @ inverse, (1.0 / powers) @ inverse, c


def shapes(xi: np.ndarray, h: float) -> np.ndarray:
    """Quintic Hermite functions of (r, h r', h2 r'') at both nodes and their derivatives in s.

    xi in [0, 1]; the result has the shape (3 derivatives, len(xi), 6).
    """

    def monomials(at):
        powers = [np.polynomial.Polynomial.basis(k) for k in range(6)]
        return np.array([[(f.deriv(d) if d else f)(at) for f in powers] for d in range(3)])

    both = np.concatenate([monomials(0.0), monomials(1.0)])
    values = np.moveaxis(monomials(xi), 1, -1)
    return values @ np.linalg.inv(both) / h ** np.arange(3)[:, None, None]


@njit(cache=True)
def add_quadratic(total, weight, middle, b):
    """Add weight b^T middle b, with as many rows of b as middle has: small, so faster than by BLAS."""
    for i in range(len(middle)):
        row = np.zeros(WIDTH)
        for j in range(len(middle)):
            for k in range(WIDTH):
                row[k] += weight * middle[i, j] * b[j, k]
        for k in range(WIDTH):
            for m in range(WIDTH):
                total[k, m] += b[i, k] * row[m]


@njit(cache=True)
def assemble(band, residual, stage, stages, weight_k, weight_c, weight_m, q, v, a, shape, gauss, rod):
    """Add one stage's residual and its blocks of the tangent (one weight a coupled stage)."""
    ea, ei, gravity, mass, added, drag, current, length = rod
    upper = WIDTH * stages - 1
    slots = np.array([[0, 1, 2, 6, 7, 8], [3, 4, 5, 9, 10, 11]])
    b = np.zeros((6, WIDTH))
    kt, ct, mt = np.zeros((6, 6)), np.zeros((2, 2)), np.zeros((2, 2))
    force = np.zeros(6)
    for e in range(q.size // 6 - 1):
        first = 6 * e
        big_k, big_c, big_m = (np.zeros((WIDTH, WIDTH)), np.zeros((WIDTH, WIDTH)), np.zeros((WIDTH, WIDTH)))
        for g in range(gauss.size):
            field, rate, accel = np.zeros(6), np.zeros(2), np.zeros(2)
            for d in range(3):
                for axis in range(2):
                    for j in range(6):
                        value = shape[d, g, j]
                        b[2 * d + axis, slots[axis, j]] = value
                        field[2 * d + axis] += value * q[first + slots[axis, j]]
                        if d == 0:
                            rate[axis] += value * v[first + slots[axis, j]]
                            accel[axis] += value * a[first + slots[axis, j]]
            px, pz, kx, kz = field[2], field[3], field[4], field[5]
            l2 = px * px + pz * pz
            l = np.sqrt(l2)
            t, n = np.array([px / l, pz / l]), np.array([pz / l, -px / l])
            p, w = np.array([px, pz]), np.array([-kz, kx])
            curve = (kx * pz - px * kz) / l2
            curve_p, curve_k = w / l2 - 2.0 * curve * p / l2, n / l
            turn = np.array([[0.0, -1.0], [1.0, 0.0]])
            height = field[1]
            inside = 0.0 <= height <= length
            u = np.array([current * min(max(height, 0.0), length) / length - rate[0], -rate[1]])
            vn, vt = u[0] * n[0] + u[1] * n[1], u[0] * t[0] + u[1] * t[1]
            an, at = accel[0] * n[0] + accel[1] * n[1], accel[0] * t[0] + accel[1] * t[1]
            slope = current / length * n[0] if inside else 0.0
            kt[:] = 0.0
            for i in range(2):
                force[i] = mass * accel[i] + added * an * n[i] - drag * abs(vn) * vn * n[i]
                force[2 + i] = ea * (l - 1.0) * t[i] + ei * curve * curve_p[i]
                force[4 + i] = ei * curve * curve_k[i]
                kt[i, 1] -= 2.0 * drag * abs(vn) * slope * n[i]
                for j in range(2):
                    same = 1.0 if i == j else 0.0
                    mt[i, j] = mass * same + added * n[i] * n[j]
                    ct[i, j] = 2.0 * drag * abs(vn) * n[i] * n[j]
                    kt[i, 2 + j] += n[j] / l * (
                        2.0 * drag * abs(vn) * vt * n[i] + drag * abs(vn) * vn * t[i]
                        - added * (at * n[i] + an * t[i])
                    )  # fmt: skip
                    curve_pp = (
                        -2.0 * (w[i] * p[j] + w[j] * p[i]) / l2**2
                        + 8.0 * curve * p[i] * p[j] / l2**2 - 2.0 * curve * same / l2
                    )  # fmt: skip
                    kt[2 + i, 2 + j] = (
                        ea * ((1.0 - 1.0 / l) * same + t[i] * t[j] / l)
                        + ei * (curve_p[i] * curve_p[j] + curve * curve_pp)
                    )  # fmt: skip
                    mixed = turn[i, j] / l2 - 2.0 * p[i] * curve_k[j] / l2
                    kt[2 + i, 4 + j] = ei * (curve_p[i] * curve_k[j] + curve * mixed)
                    kt[4 + j, 2 + i] = kt[2 + i, 4 + j]
                    kt[4 + i, 4 + j] = ei * curve_k[i] * curve_k[j]
            force[1] += gravity
            add_quadratic(big_k, gauss[g], kt, b)
            add_quadratic(big_c, gauss[g], ct, b)
            add_quadratic(big_m, gauss[g], mt, b)
            for i in range(WIDTH):
                for j in range(6):
                    residual[(first + i) * stages + stage] += gauss[g] * b[j, i] * force[j]
        for other in range(stages):
            for i in range(WIDTH):
                row = (first + i) * stages + stage
                for j in range(WIDTH):
                    column = (first + j) * stages + other
                    entry = weight_k[other] * big_k[i, j] + weight_c[other] * big_c[i, j]
                    if other == stage:
                        entry += weight_m * big_m[i, j]
                    band[upper + row - column, column] += entry


class Rod:
    """The discretised rod.

    Parameters
    ----------
    riser : Riser
    elements : int
    points : int
        Gauss points an element.
    hold : bool
        True: the top's height is held at its straight static value (S2c); False: the constant
        vertical force acts on it (S1, S2).
    still : bool
        No current (S2); otherwise S1's.
    """

    def __init__(self, riser: Riser, elements: int, hold: bool, still: bool, points: int = 7):
        self.riser, self.elements, self.hold = riser, elements, hold
        self.h = riser.length / elements
        xi, weights = np.polynomial.legendre.leggauss(points)
        self.shape, self.gauss = shapes(0.5 * (xi + 1.0), self.h), 0.5 * self.h * weights
        self.size = 6 * (elements + 1)
        self.top = self.size - 6
        self.fixed = [0, 3, self.top] + ([self.top + 3] if hold else [])
        current = 0.0 if still else riser.surface_current
        self.data = (
            riser.axial_stiffness, riser.bending_stiffness, riser.weight, riser.mass,
            riser.added_mass, riser.drag, current, riser.length,
        )  # fmt: skip

    def straight(self) -> np.ndarray:
        """Nodal unknowns of the straight equilibrium."""
        r = self.riser
        s = np.linspace(0.0, r.length, self.elements + 1)
        q = np.zeros((self.elements + 1, 6))
        bottom = r.top_force - r.weight * r.length
        q[:, 3] = s + (bottom * s + 0.5 * r.weight * s**2) / r.axial_stiffness
        q[:, 4] = (1.0 + (bottom + r.weight * s) / r.axial_stiffness) * self.h
        q[:, 5] = r.weight / r.axial_stiffness * self.h**2
        return q.ravel()

    def statics(self, q: np.ndarray, tolerance: float = 1e-12) -> np.ndarray:
        """Equilibrium from the start q by Newton's method (S1)."""
        nothing = np.zeros(self.size)
        for _ in range(60):
            residual, band = self._blocks(1)
            self._add(band, residual, 0, 1, np.ones(1), np.zeros(1), 0.0, q, nothing, nothing)
            step = self._solve(band, residual, 1)
            q = q - step
            if np.abs(step).max() < tolerance * self.riser.length:
                return q
        raise RuntimeError("rod statics: no convergence in 60 iterations")

    def run(
        self, q: np.ndarray, duration: float, step: float, every: int, stations: np.ndarray,
        method: str = "radau", amplitude: float = 2.0, period: float = 15.0, tolerance: float = 1e-11,
    ) -> RodHistory:  # fmt: skip
        """Motion from rest at q under the surge of the top, stored after every so many steps."""
        matrix, weights, nodes = collocation(method)
        stages = 3
        square, weights_x = matrix @ matrix, weights @ matrix
        at, where = self._rows(stations)
        v = np.zeros(self.size)
        a = np.zeros((stages, self.size))
        fixed_height = q[self.top + 3]
        kept = []

        def keep(now, q, v):
            kept.append((now, *self._fields(q, at, where), self._support(now, q, v, amplitude, period)))

        keep(0.0, q, v)
        for count in range(1, round(duration / step) + 1):
            start = (count - 1) * step
            if count > 1:
                a = _extrapolate(a, nodes)
            surge = np.array(ramped_sine(start + nodes * step, amplitude, period)).T
            for _ in range(20):
                qs = q + np.outer(nodes * step, v) + step**2 * square @ a
                vs = v + step * matrix @ a
                qs[:, [0, 3]] = vs[:, [0, 3]] = a[:, [0, 3]] = 0.0
                qs[:, self.top], vs[:, self.top], a[:, self.top] = surge.T
                if self.hold:
                    qs[:, self.top + 3], vs[:, self.top + 3], a[:, self.top + 3] = (fixed_height, 0.0, 0.0)
                residual, band = self._blocks(stages)
                for i in range(stages):
                    self._add(
                        band, residual, i, stages, step**2 * square[i], step * matrix[i], 1.0,
                        qs[i], vs[i], a[i],
                    )  # fmt: skip
                change = self._solve(band, residual, stages).reshape(self.size, stages).T
                a = a - change
                if np.abs(change).max() * step**2 < tolerance * self.riser.length:
                    break
            else:
                raise RuntimeError(f"rod at t = {start + step:.4f} s: no convergence in 20 iterations")
            q = q + step * v + step**2 * weights_x @ a
            v = v + step * weights @ a
            q[self.top], v[self.top], _ = ramped_sine(start + step, amplitude, period)
            if self.hold:
                q[self.top + 3] = fixed_height
            if count % every == 0:
                keep(count * step, q, v)
        time, x, z, moment, force = (np.array(column) for column in zip(*kept, strict=True))
        return RodHistory(time, np.asarray(stations), x, z, moment, force)

    def fields(self, q: np.ndarray, stations: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """x (m), z (m) and bending moment (N m) at the stations."""
        return self._fields(q, *self._rows(stations))

    def _rows(self, stations):
        element = np.minimum((np.asarray(stations) / self.h).astype(int), self.elements - 1)
        return shapes(np.asarray(stations) / self.h - element, self.h), element

    def _fields(self, q, at, where):
        nodal = q.reshape(-1, 6)
        x = np.concatenate([nodal[where, :3], nodal[where + 1, :3]], axis=1)
        z = np.concatenate([nodal[where, 3:], nodal[where + 1, 3:]], axis=1)
        x, z = np.einsum("dij,ij->di", at, x), np.einsum("dij,ij->di", at, z)
        curvature = (x[2] * z[1] - x[1] * z[2]) / (x[1] ** 2 + z[1] ** 2)
        return x[0], z[0], self.riser.bending_stiffness * curvature

    def _support(self, now, q, v, amplitude, period):
        """Force of the support on the top: the residual there, with the accelerations at (q, v)."""
        a = np.zeros(self.size)
        a[self.top] = ramped_sine(now, amplitude, period)[2]
        residual, band = self._blocks(1)
        self._add(band, residual, 0, 1, np.zeros(1), np.zeros(1), 1.0, q, v, a)
        a = a - self._solve(band, residual, 1)
        residual, band = self._blocks(1)
        self._add(band, residual, 0, 1, np.zeros(1), np.zeros(1), 1.0, q, v, a)
        return residual[[self.top, self.top + 3]] + [0.0, self._pull()]

    def _pull(self):
        return 0.0 if self.hold else self.riser.top_force

    def _blocks(self, stages):
        residual = np.zeros(self.size * stages)
        return residual, np.zeros((2 * WIDTH * stages - 1, self.size * stages))

    def _add(self, band, residual, stage, stages, on_q, on_v, on_a, q, v, a):
        assemble(
            band, residual, stage, stages, on_q, on_v, on_a, q, v, a, self.shape, self.gauss, self.data
        )  # fmt: skip
        residual[(self.top + 3) * stages + stage] -= self._pull()

    def _solve(self, band, residual, stages):
        """Banded solve with the constrained rows and columns replaced by the identity."""
        upper = WIDTH * stages - 1
        right = residual.copy()
        for dof in self.fixed:
            for i in range(dof * stages, (dof + 1) * stages):
                rows = np.arange(max(0, i - upper), min(band.shape[1], i + upper + 1))
                band[upper + i - rows, rows] = 0.0
                band[:, i] = 0.0
                band[upper, i] = 1.0
                right[i] = 0.0
        return solve_banded((upper, upper), band, right, overwrite_ab=True, check_finite=False)


def _extrapolate(a: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """First guess of the next step's stage accelerations: the last step's polynomial continued."""
    return (1.0 + nodes)[:, None] ** np.arange(3) @ np.linalg.solve(nodes[:, None] ** np.arange(3), a)
