r"""Gauge pressures inside and outside a riser: those of columns at rest.

.. math:: p_o = \rho_w g\,(z_s - z)_+,\quad p_i = \int_z^{z_m} \rho_m g\,\mathrm{d}z

with the surface at :math:`z_s` and the level of the contents at :math:`z_m`.

References
----------
Elementary: hydrostatics.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from riserstudy.scene.geometry import span

if TYPE_CHECKING:
    from riserstudy.scene.limits import Limit
    from riserstudy.scene.parts import Parts

FloatArray = NDArray[np.float64]


def pressures(
    scene: Parts, places: Sequence[slice], elevation: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Gauge pressures (Pa) inside and outside, both of the shape of the elevations.

    Parameters
    ----------
    places : of each section of the riser along the last axis, both of its ends among them.
    elevation : of the places (m), (..., n), from the lower end upwards.
    """
    gravity, water = scene.gravity or 0.0, scene.water
    inside, outside = np.zeros(elevation.shape), np.zeros(elevation.shape)
    if water is not None and water.surface is not None:
        outside = np.maximum(water.density * gravity * (water.surface - elevation), 0.0)
    filled = [k for k, section in enumerate(scene.riser) if section.contents]
    above: float | FloatArray = 0.0
    for k in reversed(filled):
        contents, own = scene.riser[k].contents, places[k]
        if contents is None:
            continue
        top = elevation[..., own][..., -1:]
        if k == filled[-1] and contents.level is not None:
            above = contents.density * gravity * (contents.level - top)
        inside[..., own] = above + contents.density * gravity * (top - elevation[..., own])
        above = inside[..., own][..., :1]
    return np.maximum(inside, 0.0), outside


def mud_above_the_riser(scene: Parts) -> float:
    """Weight (N) on the bore of the mud that stands above the riser's upper end.

    Its pressure there lowers the effective tension by as much.
    """
    last, ends = scene.riser[-1], span(scene)
    if last.contents is None or last.contents.level is None or ends is None:
        return 0.0
    top = ends.bottom + sum(section.total_length for section in scene.riser)
    height = last.contents.level - top
    return max(last.contents_mass * (scene.gravity or 0.0) * height, 0.0)


def not_in_tension(scene: Parts) -> float:
    """That weight (N) where tensioners or a joint pull, whose pull is the tension of a run; else 0."""
    pulled = scene.top.tensioners or scene.top.telescopic_joint
    return mud_above_the_riser(scene) if pulled and not scene.disconnect else 0.0


def not_in_demand(scene: Parts, limit: Limit) -> float:
    """That weight (N) where a limit is a smallest tension: what must be left for it to be met; else 0."""
    smallest_tension = limit.output == "effective_tension" and limit.side == "smallest"
    return not_in_tension(scene) if smallest_tension else 0.0
