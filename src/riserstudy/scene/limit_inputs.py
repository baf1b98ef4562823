"""The inputs that a scene must give for the output of a limit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.scene.limits import Limit
from riserstudy.scene.outputs import QUANTITIES, wall_lacks

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts


def lacks(scene: Parts, limit: Limit) -> list[str]:
    """The fields that a scene lacks for the output of a limit; empty where the output can be computed."""
    name = limit.output
    if name == "von_mises_stress":
        names = limit.sections([section.name for section in scene.riser])
        return [
            lack
            for section in (scene.riser if limit.at else scene.riser_sections)
            if section.name in names
            for lack in wall_lacks(scene, section)
        ]
    quantity = QUANTITIES[name]
    return [] if quantity.is_in(scene) else [quantity.needs]
