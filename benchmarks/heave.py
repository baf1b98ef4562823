"""Scene S3: its values, its reference, and how far a simulation is from it.

A pipe of 1800 m hangs from a platform in heave and carries a mass at its lower end, where quadratic drag
acts; it moves along itself only.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from scene import ROOT, WATER_DENSITY, ramped_sine

LENGTH = 1800.0
AXIAL_STIFFNESS = 8.3505393e9
MASS = 318.0
WEIGHT = 2712.2463  # in water, N/m
GRAVITY = 9.81
END_MASS = 140e3
END_WEIGHT = 1194070.7  # in water, N
END_AREA = 14.0  # drag coefficient times area, m2
DRAG = 0.5 * WATER_DENSITY * END_AREA
AMPLITUDE, PERIOD, RAMP = 2.0, 10.0, 10.0
DURATION, OUTPUT_STEP = 100.0, 0.05
TIMES = OUTPUT_STEP * np.arange(round(DURATION / OUTPUT_STEP) + 1)
BOUND = 100.0  # no displacement reaches it (m)
STATIC_TOP = WEIGHT * LENGTH + END_WEIGHT  # tension at rest, N
# Volumes whose buoyancy leaves the weights in water.
VOLUME = (MASS - WEIGHT / GRAVITY) / WATER_DENSITY  # m2
END_VOLUME = (END_MASS - END_WEIGHT / GRAVITY) / WATER_DENSITY  # m3

REFERENCE = ROOT / "tests" / "verification" / "data" / "S3.npz"


def tension(s: np.ndarray | float) -> np.ndarray | float:
    """Tension (N) at rest at arclength s (m) from the lower end."""
    return END_WEIGHT + WEIGHT * s


def stretch(s: np.ndarray | float) -> np.ndarray | float:
    """How much longer the lowest s (m) are at rest (m)."""
    return (END_WEIGHT * s + 0.5 * WEIGHT * s**2) / AXIAL_STIFFNESS


def top_motion(t: np.ndarray | float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Heave of the top, its velocity and acceleration (m, m/s, m/s2) at times t (s)."""
    return ramped_sine(t, AMPLITUDE, PERIOD, RAMP)


@cache
def reference() -> dict[str, np.ndarray]:
    """Stored reference over the output times: motion of the lower end (m), tension at the top (N)."""
    with np.load(REFERENCE) as data:
        return {name: data[name] for name in ("bottom", "top_tension")}


def bottom_error(bottom: np.ndarray) -> float:
    """Largest deviation of the lower end's motion over output times, relative to the largest motion."""
    truth = reference()["bottom"]
    return float(np.abs(bottom - truth).max() / np.abs(truth).max())


def tension_error(top: np.ndarray) -> float:
    """Largest deviation of the tension at the top over output times, relative to the largest tension."""
    truth = reference()["top_tension"]
    return float(np.abs(top - truth).max() / np.abs(truth).max())
