r"""Length of the waves that vortices send along a riser, which the segments must resolve.

A wave of angular frequency :math:`\omega` has the number k of :math:`E I k^4 + T k^2 = m \omega^2` in a riser
of bending stiffness EI, tension T and mass m per length, which includes contents and added mass.
"""

from __future__ import annotations

import math

from riserstudy.model.layout import stiffness
from riserstudy.model.mesh import Mesh
from riserstudy.model.vortices import shedding_period
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.resolve import Resolved

MOST = 250  # largest number of half waves along a riser that the first mesh resolves


def half_wave(scene: Resolved, mesh: Mesh, tension: FloatArray) -> dict[int, float]:
    """Shortest half wave (m) of the fastest vortices in each section, by index of the section.

    ``tension``: (n,) tension of the segments of a riser at rest (N).

    Returns
    -------
    Empty without vortices.
    """
    period = shedding_period(scene)
    if not math.isfinite(period):
        return {}
    total = sum(section.total_length for section in scene.riser)
    density = scene.water.density if scene.water else 0.0
    found = {}
    for k, section in enumerate(scene.riser):
        added = section.added_mass
        mass = (section.mass or 0.0) + section.contents_mass
        mass += added.coefficient * added.displaced(density) if added else 0.0
        pull = float(tension[mesh.section == k].min(initial=math.inf))
        number = wave_number(stiffness(section).bending, pull, mass, 2.0 * math.pi / period)
        found[k] = max(math.pi / number if number > 0.0 else math.inf, total / MOST)
    return found


def wave_number(bending: float, tension: float, mass: float, frequency: float) -> float:
    """Wave number (rad/m) of a beam under tension.

    Parameters
    ----------
    bending : EI (N m2).
    tension : T (N); without bending stiffness and with a tension of 0 or less, the number is infinite.
    mass : kg/m.
    frequency : rad/s.
    """
    inertia = mass * frequency**2
    if bending > 0.0:
        root = math.hypot(tension, 2.0 * math.sqrt(bending * inertia))
        # two equal forms, of which the one without cancellation is used
        square = 2.0 * inertia / (root + tension) if tension > 0.0 else (root - tension) / (2.0 * bending)
        return math.sqrt(square)
    return math.sqrt(inertia / tension) if tension > 0.0 else math.inf
