"""Scene S2c: its values, its reference, and how far a simulation is from it.

A vertical riser of 533 m in still water, pinned at the bottom; the top moves sideways and is held at
its static height. Arclength is unstretched and counted from the bottom.
"""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

LENGTH = 533.0
AXIAL_STIFFNESS = 8.3505393e9
BENDING_STIFFNESS = 2.7004512e8
MASS = 1006.0
ADDED_MASS = 1198.2113
WEIGHT = 14.4 * 9.81
WATER_DENSITY = 1025.0
GRAVITY = 9.81
DIAMETER = 1.22
DRAG = 0.5 * WATER_DENSITY * DIAMETER * 1.0
TOP_TENSION = 2275e3
AMPLITUDE, PERIOD, RAMP = 2.0, 15.0, 15.0
DURATION, OUTPUT_STEP = 150.0, 0.05
TIMES = OUTPUT_STEP * np.arange(round(DURATION / OUTPUT_STEP) + 1)
BOUND = 100.0  # no displacement of this riser reaches it (m)
STATIONS = np.array([433.0, 333.0, 233.0, 133.0])

ROOT = Path(__file__).parents[1]
CACHE = Path(os.environ.get("RISERSTUDY_CACHE", ROOT / ".cache"))
REFERENCE = ROOT / "tests" / "verification" / "data" / "S2c.npz"


def static_height(s: np.ndarray | float) -> np.ndarray | float:
    """Height (m) of arclength s in the straight static equilibrium."""
    bottom = TOP_TENSION - WEIGHT * LENGTH
    return s + (bottom * s + 0.5 * WEIGHT * s**2) / AXIAL_STIFFNESS


def top_motion(t: np.ndarray | float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Sideways position, velocity and acceleration of the top (m, m/s, m/s2) at times t (s)."""
    return ramped_sine(t, AMPLITUDE, PERIOD, RAMP)


def ramped_sine(
    t: np.ndarray | float, amplitude: float, period: float, ramp: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A sine that grows by a raised cosine, and its first and second derivatives at times t (s)."""
    t = np.asarray(t, dtype=float)
    w, p = 2.0 * np.pi / period, np.pi / ramp
    ramped = t < ramp
    r = np.where(ramped, 0.5 * (1.0 - np.cos(p * t)), 1.0)
    r1 = np.where(ramped, 0.5 * p * np.sin(p * t), 0.0)
    r2 = np.where(ramped, 0.5 * p**2 * np.cos(p * t), 0.0)
    sin, cos = np.sin(w * t), np.cos(w * t)
    return (
        amplitude * r * sin,
        amplitude * (r1 * sin + r * w * cos),
        amplitude * (r2 * sin + 2.0 * r1 * w * cos - r * w**2 * sin),
    )


def lagrange(nodes: np.ndarray, at: np.ndarray, points: int = 6) -> np.ndarray:
    """Matrix (at, nodes) that interpolates nodal values by the polynomial through the nearest nodes."""
    out = np.zeros((at.size, nodes.size))
    first = np.clip(np.searchsorted(nodes, at) - points // 2, 0, nodes.size - points)
    for row, (j, a) in enumerate(zip(first, at, strict=True)):
        near = nodes[j : j + points]
        for k in range(points):
            others = np.delete(near, k)
            out[row, j + k] = np.prod((a - others) / (near[k] - others))
    return out


def resample(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values on the output times, by cubic spline in time where the steps are others."""
    if time.size == TIMES.size and np.allclose(time, TIMES, atol=1e-9):
        return values
    return CubicSpline(time, values, axis=0)(TIMES)


@cache
def reference() -> dict[str, np.ndarray]:
    """Stored reference: x (time, stations), and the smallest and largest moment along envelope_s."""
    with np.load(REFERENCE) as data:
        order = [int(np.flatnonzero(data["s"] == s)[0]) for s in STATIONS]
        return {"x": data["x"][:, order]} | {
            name: data[name] for name in ("envelope_s", "moment_min", "moment_max")
        }


def displacement_error(x: np.ndarray) -> float:
    """Largest deviation over stations and output times, relative to the largest displacement."""
    truth = reference()["x"]
    return float(np.abs(x - truth).max() / np.abs(truth).max())


def moment_error(s: np.ndarray, moment: np.ndarray) -> float:
    """Largest deviation of the moment's envelopes along the riser, relative to the largest moment.

    Moments (time, s) are interpolated in space at each time, where they are smooth, and not afterwards: an
    envelope has corners. Their sign is a code's own convention; both are tried.
    """
    truth = reference()
    there = CubicSpline(s, moment, axis=1)(truth["envelope_s"])
    most, least = there.max(axis=0), there.min(axis=0)
    largest = max(np.abs(truth["moment_max"]).max(), np.abs(truth["moment_min"]).max())
    off = min(
        max(np.abs(up - truth["moment_max"]).max(), np.abs(low - truth["moment_min"]).max())
        for up, low in ((most, least), (-least, -most))
    )
    return float(off / largest)


def signed(size: np.ndarray, x: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Moments (time, s) of a code that tells their size alone, with the sign of the curvature of x."""
    return size * np.sign(np.gradient(np.gradient(x, s, axis=1), s, axis=1))
