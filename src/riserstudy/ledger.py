"""Which effects a scene has and which it lacks, with the reason for each."""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.build import build
from riserstudy.mesh import even
from riserstudy.scene.models import Scene

#: Every effect there is, with the section of a scene that calls for it.
ALL = {
    "axial elasticity": "riser",
    "axial damping": "riser.structural_damping",
    "bending": "bending stiffness, and lateral freedom",
    "bending damping": "riser.structural_damping, and lateral freedom",
    "flex joint": "rotation.stiffness, and lateral freedom",
    "clamp": "rotation: fixed, and lateral freedom",
    "weight": "riser.submerged_weight",
    "line load": "riser.lateral_load",
    "inertia": "riser.mass",
    "contents": "riser.contents, and lateral freedom",
    "added mass": "riser.added_mass, and lateral freedom",
    "drag": "riser.drag, and lateral freedom",
    "current": "current",
    "platform motion": "platform",
    "platform position": "platform.position",
    "support": "bottom.hold, top.x, top.z",
    "end mass": "bottom.body, top.body",
    "constant tension": "top.tension",
    "lateral force": "top.lateral_force",
    "gas tensioner": "top.tensioners.gas",
    "linear tensioner": "top.tensioners.linear or linearised",
    "tensioner damping": "top.tensioners.damping",
    "end stops": "top.tensioners.stroke",
    "tensioner cylinders": "top.tensioners",
    "lateral freedom": "a lateral load or motion",
}


class Row(NamedTuple):
    """One effect of the ledger."""

    name: str
    on: bool
    because: str


def ledger(scene: Scene) -> list[Row]:
    """All effects, those that are on first."""
    model = build(scene, even(scene, max(2, len(scene.riser))), top_elevation=0.0)
    on = {effect.name: effect.because for effect in model.effects}
    if scene.lateral:
        on["lateral freedom"] = scene.lateral
    rows = [Row(name, True, because) for name, because in on.items()]
    return rows + [Row(name, False, f"no {why}") for name, why in ALL.items() if name not in on]
