"""Effects of the riser string without water: elasticity, weight, inertia, structural damping."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from riserstudy.effects.axial import Axial
from riserstudy.effects.axial_damping import AxialDamping
from riserstudy.effects.inertia import Inertia
from riserstudy.effects.weight import Weight
from riserstudy.model.bending import bending
from riserstudy.model.layout import Layout, halves
from riserstudy.model.model import Effect


def riser(of: Layout) -> Iterator[Effect]:
    """Effects of the string without water."""
    l0, sections = of.mesh.l0, of.scene.riser
    yield Effect("axial elasticity", Axial(of.axial / l0), "riser")
    relaxation = [d.time if (d := s.structural_damping) else 0.0 for s in sections]
    if any(relaxation):
        damping = of.axial * of.per_segment(lambda k: relaxation[k]) / l0
        yield Effect("axial damping", AxialDamping(damping), "riser.structural_damping")
    if of.m:
        yield from bending(of, relaxation[0])
    if np.any(of.weight):
        top = (of.scene.bottom.elevation or 0.0) + float(l0.sum())
        weight = Weight(of.d - 1, halves(-of.weight * l0), top)
        yield Effect("weight", weight, "riser.submerged_weight")
    load = of.per_segment(lambda k: sections[k].lateral_load or 0.0)
    if np.any(load) and of.d > 1:
        yield Effect("line load", Weight(0, halves(load * l0)), "riser.lateral_load")
    mass = of.per_segment(lambda k: sections[k].mass or 0.0) * l0
    if np.any(mass):
        yield Effect("inertia", Inertia(mass, -mass), "riser.mass")
