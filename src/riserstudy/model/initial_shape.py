"""The shape that the search for equilibrium starts from."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.mesh import Mesh

FloatArray = NDArray[np.float64]


MOST = 0.01  # strain of a first guess


def between_ends(
    mesh: Mesh, offset: float, rise: float, weight: float, stiffness: float
) -> FloatArray:
    """Straight from end to end, or sagging where the riser is longer than that.

    A string that sags is stretched by the tension it then has, W L / (8 sag): without tension nothing holds
    it sideways, and the search for equilibrium may end in kinks.

    Parameters
    ----------
    offset, rise : of the upper end from the lower one (m).
    weight : W of the whole, in water (N).
    stiffness : EA (N).

    Returns
    -------
    (3, n+1) x, y, z of the nodes from the lower end (m).
    """
    total = float(mesh.l0.sum())
    if offset and math.hypot(offset, rise) < total:
        sag = max(sag_of(total, offset, rise), 1e-9 * total)
        tension = max(weight, 0.0) * total / (8.0 * sag)
        x, z = sagging(mesh.s * (1.0 + min(MOST, tension / stiffness)), offset, rise)
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
    lean = math.asin(max(-1.0, min(1.0, offset / (float(mesh.l0.sum()) - s[foot]))))
    x = np.append(above * math.sin(lean), offset)
    z = np.append(s - above * (1.0 - math.cos(lean)), rise)
    return np.stack([x, np.zeros(len(x)), z])


def above_ground(mesh: Mesh, foot: int, offset: float, rise: float) -> FloatArray:
    """Upright to where the riser leaves its conductor or stack, straight to its upper end above.

    A conductor that leant with the riser would be pressed into the soil all along.

    Parameters
    ----------
    foot : node that the riser leans above.
    offset, rise : of the upper end from the lower one (m).

    Returns
    -------
    (3, n+1) x, y, z of the nodes from the lower end (m).
    """
    upright = mesh.s[foot] * rise / mesh.s[-1]
    share = np.maximum(mesh.s - mesh.s[foot], 0.0) / (mesh.s[-1] - mesh.s[foot])
    z = np.where(share > 0.0, upright + share * (rise - upright), mesh.s * rise / mesh.s[-1])
    return np.stack([offset * share, 0.0 * share, z])


def sagging(s: FloatArray, offset: float, rise: float) -> FloatArray:
    """Points at arclengths ``s`` (m) of the parabola as long as the riser, (2, n+1), m."""
    curve = _parabola(offset, rise, sag_of(float(s[-1]), offset, rise))
    return np.stack([np.interp(s, _arclength(curve), row) for row in curve])


def sag_of(length: float, offset: float, rise: float) -> float:
    """Sag of the parabola of some length, below the middle of the chord (m)."""
    from scipy.optimize import brentq  # which takes longer to load than most runs take

    sag: float = brentq(lambda h: _arclength(_parabola(offset, rise, h))[-1] - length, 0.0, length)
    return sag


def _parabola(offset: float, rise: float, sag: float) -> FloatArray:
    u = np.linspace(0.0, 1.0, 2001)
    return np.stack([offset * u, rise * u - 4.0 * sag * u * (1.0 - u)])


def _arclength(curve: FloatArray) -> FloatArray:
    return np.append(0.0, np.hypot(*np.diff(curve)).cumsum())
