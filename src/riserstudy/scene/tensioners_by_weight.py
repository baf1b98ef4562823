"""Tensioners whose pull, stiffness and damping follow from the suspended weight."""

from __future__ import annotations

import math
from typing import Annotated

from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import POSITIVE


class DampingRatio(Strict):
    """Damping of tensioner cylinders as a ratio of critical damping.

    The engine computes critical damping for a single mass on a spring: the suspended mass of the riser, and
    the vertical stiffness of the cylinders.
    """

    ratio: Annotated[float, POSITIVE]

    def damping(self, stiffness: float, mass: float) -> float:
        """Damping (N s/m) for a mass (kg) on springs of a stiffness (N/m)."""
        return 2.0 * self.ratio * math.sqrt(stiffness * mass)


class Carried(Strict):
    """Linear law of the tensioners, computed from the suspended weight; it replaces the key ``linear``.

    At mid-stroke, all cylinders without a failure together carry the submerged weight of riser, contents and
    bodies. The pull of inclined cylinders is larger than the suspended weight, because only the vertical part
    of the pull carries the weight. The stiffness of the cylinders is the pull at mid-stroke divided by
    ``doubles_over``, the extension at which the pull would be twice as large.
    """

    doubles_over: Annotated[u.Length, POSITIVE]

    def stiffness(self, weight: float) -> float:
        """Stiffness (N/m) of all working cylinders together, which carry a weight (N)."""
        return weight / self.doubles_over
