"""The shape that the search for equilibrium starts from."""

from __future__ import annotations

import math

import numpy as np

from riserstudy.model.mesh import Mesh
from riserstudy.records.arrays import FloatArray

MOST = 0.01  # largest strain of the initial shape


def between_ends(mesh: Mesh, offset: float, rise: float, weight: float, stiffness: float) -> FloatArray:
    """A straight line from end to end, or a sagging curve if the riser is longer than this line.

    A sagging string is stretched by its tension, W L / (8 sag). Without tension it would have no lateral
    stiffness, and the search for equilibrium could end in kinks.

    Parameters
    ----------
    offset, rise : horizontal and vertical distance of the upper end from the lower end (m).
    weight : W, submerged weight of the whole string (N).
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


def under_a_joint(mesh: Mesh, foot: int, strain: FloatArray, offset: float, rise: float) -> FloatArray:
    """Upright below its flex joint and inclined above it; the telescopic joint fills the rest.

    Parameters
    ----------
    foot : node above which the riser is inclined.
    strain : strain of the riser's segments, (n-1,).
    offset, rise : horizontal and vertical distance of the upper end from the lower end (m).

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
    """Upright along conductor and stack, and straight from there to the riser's upper end.

    A conductor that was inclined with the riser would be pushed into the soil over its whole length.

    Parameters
    ----------
    foot : node above which the riser is inclined.
    offset, rise : horizontal and vertical distance of the upper end from the lower end (m).

    Returns
    -------
    (3, n+1) x, y, z of the nodes from the lower end (m).
    """
    upright = mesh.s[foot] * rise / mesh.s[-1]
    share = np.maximum(mesh.s - mesh.s[foot], 0.0) / (mesh.s[-1] - mesh.s[foot])
    z = np.where(share > 0.0, upright + share * (rise - upright), mesh.s * rise / mesh.s[-1])
    return np.stack([offset * share, 0.0 * share, z])


def sagging(s: FloatArray, offset: float, rise: float) -> FloatArray:
    """Points at arclengths ``s`` (m) on the parabola that is as long as the riser, (2, n+1), m."""
    curve = _parabola(offset, rise, sag_of(float(s[-1]), offset, rise))
    return np.stack([np.interp(s, _arclength(curve), row) for row in curve])


def sag_of(length: float, offset: float, rise: float) -> float:
    """Sag of a parabola of a length, below the middle of its chord (m)."""
    from scipy.optimize import brentq  # which takes longer to load than most runs take

    sag: float = brentq(lambda h: _arclength(_parabola(offset, rise, h))[-1] - length, 0.0, length)
    return sag


def _parabola(offset: float, rise: float, sag: float) -> FloatArray:
    u = np.linspace(0.0, 1.0, 2001)
    return np.stack([offset * u, rise * u - 4.0 * sag * u * (1.0 - u)])


def _arclength(curve: FloatArray) -> FloatArray:
    return np.append(0.0, np.hypot(*np.diff(curve)).cumsum())
