r"""Von Mises stress of the riser's wall under tension, bending, and pressure inside and outside.

.. math:: T_w = T_e + p_i A_i - p_o A_o,\quad
          \sigma_a = T_w / A \pm |M| r / I,\quad
          \sigma_{h, r} = \frac{p_i r_i^2 - p_o r_o^2}{r_o^2 - r_i^2}
                          \pm \frac{(p_i - p_o) r_i^2 r_o^2}{(r_o^2 - r_i^2) r^2}

at both radii and on both sides; the largest of the four is used. Pressures are hydrostatic gauge pressures.
Shear and torsion are neglected; at the outer fibre, shear stress is zero.

References
----------
Timoshenko and Goodier, Theory of Elasticity: the thick-walled cylinder of Lamé. Sparks 1984, The influence of
tension, pressure and weight on pipe and riser deformations and stresses, Journal of Energy Resources
Technology 106(1): effective tension.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from riserstudy.model.mesh import Mesh
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.pressures import pressures as columns_at_rest
from riserstudy.scene.quantities import wall_lacks
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import Section


class Wall(NamedTuple):
    """A pipe's wall, given by its radii (m)."""

    outer: float
    inner: float

    @property
    def area(self) -> float:
        """Cross section (m2)."""
        return math.pi * (self.outer**2 - self.inner**2)

    @property
    def second_moment(self) -> float:
        """Second moment of area (m4)."""
        return 0.25 * math.pi * (self.outer**4 - self.inner**4)


def wall_of(section: Section) -> Wall:
    """The wall of a section that gives both diameters."""
    return Wall(0.5 * (section.outer_diameter or 0.0), 0.5 * (section.inner_diameter or 0.0))


def von_mises(
    wall: Wall, tension: FloatArray, moment: FloatArray, inside: FloatArray, outside: FloatArray
) -> FloatArray:
    """Largest von Mises stress (Pa) at both radii and on both sides, in the shape of the tension.

    Parameters
    ----------
    tension : effective tension (N), (...).
    moment : bending moment (N m), (...), of either sign.
    inside, outside : pressures (Pa), (...), gauge.
    """
    return np.asarray(four_stresses(wall, tension, moment, inside, outside).max(axis=0))


def four_stresses(
    wall: Wall, tension: FloatArray, moment: FloatArray, inside: FloatArray, outside: FloatArray
) -> FloatArray:
    """Von Mises stress (Pa), (4, ...): outer and inner radius on bending's tension side, then opposite."""
    own = tension + math.pi * (inside * wall.inner**2 - outside * wall.outer**2)
    stresses = []
    for side in (1.0, -1.0):
        for radius in (wall.outer, wall.inner):
            axial = own / wall.area + side * np.abs(moment) * radius / wall.second_moment
            hoop, radial = lame(wall, inside, outside, radius)
            squares = (axial - hoop) ** 2 + (hoop - radial) ** 2 + (radial - axial) ** 2
            stresses.append(np.sqrt(0.5 * squares))
    return np.stack(stresses)


def lame(wall: Wall, inside: FloatArray, outside: FloatArray, radius: float) -> tuple[FloatArray, FloatArray]:
    """Hoop and radial stress (Pa) at a radius (m), in the shape of the pressures (Pa)."""
    inner, outer = wall.inner**2, wall.outer**2
    even = (inside * inner - outside * outer) / (outer - inner)
    varying = (inside - outside) * inner * outer / ((outer - inner) * radius**2)
    return even + varying, even - varying


def along_the_riser(
    scene: Resolved, mesh: Mesh, elevation: FloatArray, tension: FloatArray, moment: FloatArray
) -> FloatArray:
    """Von Mises stress (Pa) at the nodes, (..., n + 1), NaN where a section lacks inputs for it.

    Where two sections meet, it is the larger stress. ``elevation``, ``tension``, ``moment``: values at the
    nodes (m, N, N m), (..., n + 1).
    """
    inside, outside = pressures(scene, mesh, elevation)
    stresses = np.full(elevation.shape, np.nan)
    for k, section in enumerate(scene.riser):
        if wall_lacks(scene, section):
            continue
        wall = wall_of(section)
        nodes = nodes_of(mesh, k)
        axial, bending = section.pipe_shares
        parts = (axial * tension, bending * moment, inside, outside)
        stress = von_mises(wall, *(values[..., nodes] for values in parts))
        stresses[..., nodes] = np.fmax(stresses[..., nodes], stress)
    return stresses


def nodes_of(mesh: Mesh, section: int) -> slice:
    """The nodes of a section, its two ends included."""
    first = mesh.foot(section)
    return slice(first, first + int((mesh.section == section).sum()) + 1)


def pressures(scene: Resolved, mesh: Mesh, elevation: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Gauge pressures (Pa) inside and outside at the nodes, both in the shape of the elevations (m)."""
    places = [nodes_of(mesh, k) for k in range(len(scene.riser))]
    return columns_at_rest(scene, places, elevation)
