"""Scene S2 a second way: the rod's balance laws as first-order equations in s, no elements.

Time first: BDF2 turns velocity and acceleration into the new position plus history. What is left
is a boundary value problem in s for (x, z, theta, M, H, V), solved by the fourth-order
three-point Lobatto collocation. Second order in time, fourth in space; two runs with steps h and
h/2 are to be extrapolated.
"""

import numpy as np
from numba import njit
from reference import Riser
from reference_heave import ramped_sine
from reference_rod import RodHistory
from scipy.linalg import solve_banded

LOWER = 8  # half bandwidth: three conditions at the bottom, then six equations an interval
SCALE = np.array([1.0, 1.0, 0.01, 1e4, 1e4, 1e5])


@njit(cache=True)
def slope(y, old, rate, rod):
    """dy/ds at one point; v = rate x + old[:2] and a = rate v + old[2:] for both components."""
    ea, ei, gravity, mass, added, drag = rod
    sin, cos = np.sin(y[2]), np.cos(y[2])
    vx, vz = rate * y[0] + old[0], rate * y[1] + old[1]
    ax, az = rate * vx + old[2], rate * vz + old[3]
    stretch = 1.0 + (y[4] * sin + y[5] * cos) / ea
    vn, an = vx * cos - vz * sin, ax * cos - az * sin
    normal = added * an + drag * abs(vn) * vn
    return np.array([
        stretch * sin,
        stretch * cos,
        y[3] / ei,
        -stretch * (y[4] * cos - y[5] * sin),
        mass * ax + normal * cos,
        mass * az - normal * sin + gravity,
    ])  # fmt: skip


@njit(cache=True)
def tangent(y, old, rate, rod, scale):
    """Difference quotient of ``slope``; Newton's method does not need more."""
    out = np.empty((6, 6))
    for j in range(6):
        d = 1e-6 * scale[j]
        up, down = y.copy(), y.copy()
        up[j] += d
        down[j] -= d
        out[:, j] = (slope(up, old, rate, rod) - slope(down, old, rate, rod)) / (2.0 * d)
    return out


@njit(cache=True)
def system(y, old_node, old_mid, h, rate, rod, scale, band, residual):
    """Lobatto equations of all intervals and their tangent; returns the midpoints' (x, z)."""
    n = y.shape[0] - 1
    middle = np.empty((n, 2))
    one = np.eye(6)
    f1, t1 = slope(y[0], old_node[0], rate, rod), tangent(y[0], old_node[0], rate, rod, scale)
    for j in range(n):
        f0, t0 = f1, t1
        f1 = slope(y[j + 1], old_node[j + 1], rate, rod)
        t1 = tangent(y[j + 1], old_node[j + 1], rate, rod, scale)
        ym = 0.5 * (y[j] + y[j + 1]) - h / 8.0 * (f1 - f0)
        middle[j] = ym[:2]
        fm = slope(ym, old_mid[j], rate, rod)
        tm = tangent(ym, old_mid[j], rate, rod, scale)
        miss = y[j + 1] - y[j] - h / 6.0 * (f0 + 4.0 * fm + f1)
        left = -one - h / 6.0 * (t0 + 4.0 * tm @ (0.5 * one + h / 8.0 * t0))
        right = one - h / 6.0 * (t1 + 4.0 * tm @ (0.5 * one - h / 8.0 * t1))
        for i in range(6):
            row = 3 + 6 * j + i
            residual[row] = miss[i] / scale[i]
            for k in range(6):
                column = 6 * j + k
                band[LOWER + row - column, column] = left[i, k] * scale[k] / scale[i]
                band[LOWER + row - column - 6, column + 6] = right[i, k] * scale[k] / scale[i]
    return middle


def surge(
    stations: np.ndarray, intervals: int, step: float, hold: bool, duration: float = 150.0,
    store: float = 0.05, riser: Riser = Riser(), amplitude: float = 2.0, period: float = 15.0,
) -> RodHistory:  # fmt: skip
    """S2 (hold False) or S2c (hold True) at stations (m) every ``store`` seconds."""
    rod = (
        riser.axial_stiffness, riser.bending_stiffness, riser.weight, riser.mass,
        riser.added_mass, riser.drag,
    )  # fmt: skip
    h = riser.length / intervals
    s = np.linspace(0.0, riser.length, 2 * intervals + 1)
    bottom = riser.top_force - riser.weight * riser.length
    height = s + (bottom * s + 0.5 * riser.weight * s**2) / riser.axial_stiffness
    y = np.zeros((intervals + 1, 6))
    y[:, 1], y[:, 5] = height[::2], bottom + riser.weight * s[::2]
    # history of position and velocity at nodes and midpoints, newest first
    position = np.zeros((2, s.size, 2))
    position[:, :, 1] = height
    velocity = np.zeros((2, s.size, 2))
    rate = 1.5 / step
    every, kept = round(store / step), []
    place = np.minimum((stations / h).astype(int), intervals - 1)

    def keep(now, old):
        f0 = np.array([slope(y[j], old[2 * j], rate, rod) for j in place])
        f1 = np.array([slope(y[j + 1], old[2 * j + 2], rate, rod) for j in place])
        u = (stations / h - place)[:, None]
        value = (
            y[place] * (1.0 + 2.0 * u) * (1.0 - u) ** 2 + y[place + 1] * (3.0 - 2.0 * u) * u**2
            + h * u * (1.0 - u) * (f0 * (1.0 - u) - f1 * u)
        )  # fmt: skip
        kept.append((now, value[:, 0], value[:, 1], value[:, 3], y[-1, 4:].copy()))

    for count in range(round(duration / step) + 1):
        old_v = (0.5 * position[1] - 2.0 * position[0]) / step
        old_a = (0.5 * velocity[1] - 2.0 * velocity[0]) / step
        old = np.ascontiguousarray(np.concatenate([old_v, old_a], axis=1))
        if count == 0:
            old[:] = 0.0
            old[:, :2] = -rate * position[0]
            keep(0.0, old)
            continue
        top = ramped_sine(count * step, amplitude, period)[0]
        for _ in range(15):
            band = np.zeros((2 * LOWER + 1, y.size))
            residual = np.zeros(y.size)
            middle = system(y, old[::2], old[1::2], h, rate, rod, SCALE, band, residual)
            for row, dof in enumerate((0, 1, 3)):
                residual[row], band[LOWER + row - dof, dof] = y[0, dof] / SCALE[dof], 1.0
            last = y.size - 6
            end = (1, height[-1]) if hold else (5, riser.top_force)
            for i, (dof, value) in enumerate(((0, top), (3, 0.0), end)):
                row = y.size - 3 + i
                residual[row] = (y[-1, dof] - value) / SCALE[dof]
                band[LOWER + row - last - dof, last + dof] = 1.0
            change = solve_banded((LOWER, LOWER), band, residual, overwrite_ab=True).reshape(-1, 6)
            y = y - change * SCALE
            if np.abs(change).max() < 1e-8:
                break
        else:
            raise RuntimeError(f"box scheme at t = {count * step:.4f} s: no convergence")
        new = np.empty((s.size, 2))
        new[::2], new[1::2] = y[:, :2], middle
        velocity = np.stack([rate * new + old_v, velocity[0]])
        position = np.stack([new, position[0]])
        if count % every == 0:
            keep(count * step, old)
    time, x, z, moment, force = (np.array(column) for column in zip(*kept, strict=True))
    return RodHistory(time, np.asarray(stations), x, z, moment, force)
