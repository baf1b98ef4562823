"""The shape that the search for equilibrium starts from."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from riserstudy.mesh import Mesh

FloatArray = NDArray[np.float64]


def between_ends(mesh: Mesh, offset: float, rise: float) -> FloatArray:
    """Straight from end to end, or sagging where the riser is longer than that.

    Parameters
    ----------
    offset, rise : of the upper end from the lower one (m).

    Returns
    -------
    (3, n+1) x, y, z of the nodes from the lower end (m).
    """
    total = float(mesh.l0.sum())
    if offset and math.hypot(offset, rise) < total:
        x, z = sagging(mesh.s, offset, rise)
        return np.stack([x, np.zeros(len(x)), z])
    share = mesh.s / total
    return np.stack([offset * share, 0.0 * share, rise * share])


def under_a_joint(
    mesh: Mesh, foot: int, strain: FloatArray, offset: float, rise: float
) -> FloatArray:
    """Upright to its flex joint, leaning above it; what is left is in the telescopic joint.

    Parameters
    ----------
    foot : node that the riser leans above.
    strain : of the riser's segments, (n-1,).
    offset, rise : of the upper end from the lower one (m).

    Returns
    -------
    (3, n+1) x, y, z of the nodes from the lower end (m).
    """
    s = np.concatenate([[0.0], np.cumsum(mesh.l0[:-1] * (1.0 + strain))])
    above = np.maximum(s - s[foot], 0.0)
    lean = math.asin(min(1.0, offset / (float(mesh.l0.sum()) - s[foot])))
    x = np.append(above * math.sin(lean), offset)
    z = np.append(s - above * (1.0 - math.cos(lean)), rise)
    return np.stack([x, np.zeros(len(x)), z])


def sagging(s: FloatArray, offset: float, rise: float) -> FloatArray:
    """Points at arclengths ``s`` of the parabola as long as the riser, (2, n+1)."""
    u = np.linspace(0.0, 1.0, 2001)

    def curve(sag: float) -> FloatArray:
        return np.stack([offset * u, rise * u - 4.0 * sag * u * (1.0 - u)])

    def arclength(sag: float) -> FloatArray:
        return np.append(0.0, np.hypot(*np.diff(curve(sag))).cumsum())

    sag = brentq(lambda h: arclength(h)[-1] - s[-1], 0.0, s[-1])
    return np.stack([np.interp(s, arclength(sag), row) for row in curve(sag)])
