"""The sea at rest: its density, and the elevations of mean level and seabed."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import POSITIVE


class Water(Strict):
    """The sea around the riser.

    Without the key ``water``, a scene has no drag, added mass, current or waves.

    Waves require the elevations ``surface`` and ``seabed``. A current profile by depth requires ``surface``,
    and a current profile by a formula requires ``surface`` and ``seabed``, unless the profile gives both
    elevations.
    """

    density: Annotated[u.Density, POSITIVE]
    surface: u.Length | None = None
    seabed: u.Length | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.surface is not None and self.seabed is not None and self.seabed >= self.surface:
            raise Misfit("", "seabed is not below surface", "correct their elevations")
        return self
