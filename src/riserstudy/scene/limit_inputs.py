"""What the limits of a scene need of it: places that there are, and inputs that tell their outputs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.scene.limits import Limit
from riserstudy.scene.outputs import QUANTITIES, wall_lacks

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts


def limits_fit(scene: Parts) -> None:
    """See that limits are at sections that there are.

    Raises
    ------
    ValueError
        Field, what was found and what is allowed.
    """
    names = [section.name for section in scene.riser]
    for k, limit in enumerate(scene.limits or []):
        try:
            limit.sections(names)
        except ValueError as fault:
            raise ValueError(f"limits[{k}].at: {fault}") from None
        if limit.output == "stroke" and scene.top.telescopic_joint:
            raise ValueError(
                f"limits[{k}].output: 'stroke' counts from the static state. Write 'joint_stroke', which "
                "counts from the joint's length"
            )


def lacks(scene: Parts, limit: Limit) -> list[str]:
    """What a scene lacks for the output of a limit, by its fields; empty where it should be there."""
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
