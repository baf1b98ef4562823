"""The motions of a platform that the riser's upper end or its tensioners follow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.forcing import TILTS

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts

NOTHING = "has no effect: neither the upper end of the riser nor a tensioner follows it"


def followed(scene: Parts) -> dict[str, bool]:
    """Whether a motion of the platform moves the upper end or the tensioners, by its name in the scene."""
    top, rig = scene.top, scene.top.tensioners
    across = top.x in ("platform", "vessel") or bool(rig and rig.arrangement)
    # the stroke of a free end is measured from the platform
    up = top.z != "held" or rig is not None
    # tilts move points of the deck sideways, up and down
    sideways = dict.fromkeys(("surge", "sway", "cruise"), across)
    return sideways | {"heave": up} | dict.fromkeys(TILTS, across or up)


def not_followed(scene: Parts) -> list[RunWarning]:
    """A warning about motions of a response that move nothing, beside others that do."""
    response = scene.platform and scene.platform.response
    if not response:
        return []
    follows = followed(scene)
    idle = [name for name in response.moving if not follows[name]]
    text = f"platform.response: {{motions}} of the platform {NOTHING}"
    return [warning("motions_without_effect", text, {"motions": " and ".join(idle)})] if idle else []
