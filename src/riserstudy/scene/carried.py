"""Tensioners set to the weight that hangs on them: the weight tells pull, stiffness and damping."""

from __future__ import annotations

import math
from typing import Annotated

from riserstudy.scene import units as u
from riserstudy.scene.base import POSITIVE, Strict


class Carried(Strict):
    """Straight lines that carry all that hangs on them, in place of ``linear`` and ``damping``.

    At mid-stroke the working cylinders together pull the weight in water of riser, contents and bodies;
    the pull would double over ``doubles_over`` of reach. ``damping_ratio`` is of critical, with all that
    hangs as one mass on that stiffness. Absent damping_ratio: none.
    """

    doubles_over: Annotated[u.Length, POSITIVE]
    damping_ratio: Annotated[float, POSITIVE] | None = None

    def line(self, weight: float, mass: float) -> tuple[float, float, float | None]:
        """Pull at mid-stroke (N), stiffness (N/m) and damping (N s/m) of all cylinders.

        Parameters
        ----------
        weight, mass : of all that hangs (N, kg).
        """
        stiffness = weight / self.doubles_over
        if self.damping_ratio is None:
            return weight, stiffness, None
        return weight, stiffness, 2.0 * self.damping_ratio * math.sqrt(stiffness * mass)
