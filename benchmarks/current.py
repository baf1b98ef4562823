"""Scene S1 with its top held: its values, its reference, and how far an equilibrium is from it.

The riser of S2c, pinned at both ends, in a current that grows evenly from nothing at the bottom. The top is
held at the height that scene S1 has under 2275 kN, so that codes without a constant pull can run it too.
"""

from __future__ import annotations

import sys
from functools import cache

import numpy as np
from scene import LENGTH, ROOT
from scipy.interpolate import CubicSpline

HEIGHT = 533.09169  # of the top (m)
SURFACE_SPEED = 1.0  # at z = LENGTH and above (m/s)
STATIONS = np.linspace(0.0, LENGTH, 101)
HELD = {"top": {"x": "held", "z": "held", "elevation": f"{HEIGHT} m", "rotation": "free"}}


def speed(z: np.ndarray) -> np.ndarray:
    """Current (m/s) at heights z (m) over the bottom."""
    return SURFACE_SPEED * np.clip(z / LENGTH, 0.0, 1.0)


@cache
def reference() -> dict[str, np.ndarray]:
    """X (m) and moment (N m) at the stations: the rod as a boundary value problem, by collocation."""
    sys.path.insert(0, str(ROOT / "tests" / "verification"))
    from reference import static_current

    rod = static_current(STATIONS, top_height=HEIGHT, tolerance=1e-10)
    return {"x": rod.x, "moment": rod.moment}


def displacement_error(s: np.ndarray, x: np.ndarray) -> float:
    """Largest deviation of x (m) at places s (m) over the largest displacement."""
    truth = reference()["x"]
    return float(np.abs(CubicSpline(s, x)(STATIONS) - truth).max() / np.abs(truth).max())


def moment_error(s: np.ndarray, moment: np.ndarray) -> float:
    """Largest deviation of the moment's size (N m) at places s (m) over the largest moment."""
    truth = np.abs(reference()["moment"])
    return float(np.abs(np.abs(CubicSpline(s, moment)(STATIONS)) - truth).max() / truth.max())
