"""A riser towed steadily through still and flowing water: two-point boundary problem of the exact rod.

Extensible Kirchhoff rod, collocated by SciPy. s and depth z count downwards from the flex joint, x along
the track, theta from the vertical; (h, v) is the force of what hangs below a point on what is above it,
per unstretched length. Seen from the platform the water flows at current less platform speed.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_bvp

EDGE = 0.05  # half the width (m) over which C_D changes, since collocation needs a continuous load


@dataclass(frozen=True)
class Towed:
    """The inputs of hangoff_ref, in SI."""

    length: float = 1800.0
    axial: float = 8.512685649e9
    bending: float = 2.752887192e8
    weight: float = 2714.057
    diameter: float = 0.5334
    density: float = 1025.0
    joint: float = 8800.0 * 180.0 / np.pi
    end_weight: float = 1373400.0
    end_area: float = 15.0
    platform: float = 1.0
    current: float = 1.0  # down to 100 m, against the platform; none below 300 m
    step: float = 150.0  # where C_D falls from 1.2 to 0.7
    step_by_depth: bool = True  # at that depth of the moving riser, or that length along it
    horizontal: bool = False  # drag on the horizontal velocity, not on that across the riser


def steady(case: Towed, tolerance: float = 1e-8) -> dict[str, np.ndarray]:
    """s (m from the joint), x, z (m), angle (rad) and moment (N m) of the steady state."""
    breaks = [100.0, case.step, 300.0]
    layers = [
        np.concatenate([[0.0], np.geomspace(0.2, 60.0, 120)]),
        *(np.linspace(b - 15.0, b + 15.0, 121) for b in breaks),
        case.length - np.concatenate([[0.0], np.geomspace(0.2, 120.0, 120)]),
        np.linspace(0.0, case.length, 400),
    ]
    s = np.unique(np.concatenate(layers).round(2))

    def water(z):
        return -case.current * np.interp(z, [100.0, 300.0], [1.0, 0.0])

    def slope(s, y):
        x, z, theta, moment, h, v = y
        sin, cos = np.sin(theta), np.cos(theta)
        stretch = 1.0 + (h * sin + v * cos) / case.axial
        flow = water(z) - case.platform
        where = z if case.step_by_depth else s
        coefficient = np.interp(where, [case.step - EDGE, case.step + EDGE], [1.2, 0.7])
        across = flow if case.horizontal else flow * cos
        q = 0.5 * case.density * case.diameter * coefficient * np.abs(across) * across
        qx, qz = (q, 0.0 * q) if case.horizontal else (q * cos, -q * sin)
        return np.stack(
            [
                stretch * sin,
                stretch * cos,
                moment / case.bending,
                stretch * (sin * v - cos * h),
                -qx,
                -case.weight - qz,
            ]
        )

    def ends(top, low):
        flow = water(low[1]) - case.platform
        pull = 0.5 * case.density * case.end_area * abs(flow) * flow
        return np.array(
            [
                top[0],
                top[1],
                (top[3] - case.joint * top[2]) / 1e5,
                low[3] / 1e5,
                (low[4] - pull) / 1e4,
                (low[5] - case.end_weight) / 1e6,
            ]
        )

    total = case.end_weight + case.weight * (case.length - s)
    guess = np.stack([-0.05 * s, s, 0.0 * s - 0.05, 0.0 * s, -0.05 * total, total])
    found = solve_bvp(slope, ends, s, guess, tol=tolerance, max_nodes=400_000)
    if not found.success:
        raise RuntimeError(f"towed rod: {found.message}")
    at = np.unique(np.concatenate([found.x, np.linspace(0.0, case.length, 1801)]))
    x, z, theta, moment, h, v = found.sol(at)
    return {"s": at, "x": x, "z": z, "angle": theta, "moment": moment, "tension": np.hypot(h, v)}
