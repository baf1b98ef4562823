"""Damping in proportion to stiffness, of the pipe and of the soil."""

from __future__ import annotations

import math
from typing import Annotated

from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE


class DampingAtPeriod(Strict):
    """Ratio of critical damping at one period."""

    ratio: Annotated[float, NOT_NEGATIVE]
    at_period: Annotated[u.Time, POSITIVE]

    @property
    def time(self) -> float:
        """Ratio of damping to stiffness (s)."""
        return self.ratio * self.at_period / math.pi
