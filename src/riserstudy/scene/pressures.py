r"""Hydrostatic gauge pressures inside and outside a riser.

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

from riserstudy.records.arrays import FloatArray
from riserstudy.scene.geometry import span

if TYPE_CHECKING:
    from riserstudy.scene.limits import Limit
    from riserstudy.scene.parts import Parts

#: outputs that are effective tensions, from which a run does not subtract mud above the riser
TENSIONS = ("effective_tension", "lower_end_tension", "overpull")


def pressures(scene: Parts, places: Sequence[slice], elevation: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Gauge pressures (Pa) inside and outside, both of the shape of the elevations.

    Parameters
    ----------
    places : slice of the last axis of ``elevation`` for each section, its two ends included.
    elevation : elevation of each place (m), (..., n), from the lower end upwards.
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
    """Weight (N) of the mud column above the riser's upper end, over the area of the bore.

    The pressure of this column reduces the effective tension at the upper end by this weight.
    """
    last, ends = scene.riser[-1], span(scene)
    if last.contents is None or last.contents.level is None or ends is None:
        return 0.0
    top = ends.bottom + sum(section.total_length for section in scene.riser)
    height = last.contents.level - top
    return max(last.contents_mass * (scene.gravity or 0.0) * height, 0.0)


def not_in_tension(scene: Parts) -> float:
    """Weight (N) of the mud above the riser's upper end that the tension of a run does not account for.

    With tensioners or a telescopic joint, the tension of a run is their pull, and this weight is not
    subtracted. Otherwise the result is 0. After a disconnect with draining contents, it is an upper bound.
    """
    pulled = scene.top.tensioners or scene.top.telescopic_joint
    return mud_above_the_riser(scene) if pulled else 0.0


def not_in_demand(scene: Parts, limit: Limit) -> float:
    """That weight (N) where a limit is a smallest tension: what must be left for it to be met; else 0."""
    smallest_tension = limit.output in TENSIONS and limit.side == "smallest"
    return not_in_tension(scene) if smallest_tension else 0.0
