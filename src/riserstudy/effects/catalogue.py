"""The list that names every effect."""

from __future__ import annotations

#: Every effect there is, with the section of a scene that calls for it.
CALLED_BY = {
    "axial elasticity": "riser",
    "axial damping": "riser.structural_damping",
    "bending": "bending stiffness, and lateral freedom",
    "foreshortening": "bending stiffness, and lateral freedom",
    "bending damping": "riser.structural_damping, and lateral freedom",
    "flex joint": "rotation.stiffness, and lateral freedom",
    "clamp": "rotation: fixed, and lateral freedom",
    "weight": "riser.submerged_weight",
    "line load": "riser.lateral_load",
    "inertia": "riser.mass",
    "contents": "riser.contents, and lateral freedom",
    "added mass": "riser.added_mass, and lateral freedom",
    "drag": "riser.drag, and lateral freedom",
    "tangential drag": "riser.tangential_drag",
    "current": "current",
    "wave": "wave",
    "wave force": "wave, and riser.added_mass",
    "waterline": "water.surface, and riser.drag, tangential_drag or added_mass",
    "platform motion": "platform",
    "platform position": "platform.position",
    "support": "bottom.hold, top.x, top.z",
    "end mass": "bottom.body, top.body",
    "constant tension": "top.tension",
    "tension loss": "top.tension_loss",
    "lateral force": "top.lateral_force",
    "gas tensioner": "top.tensioners.gas",
    "two-chamber gas tensioner": "top.tensioners.two_chamber_gas",
    "piston mass": "top.tensioners.two_chamber_gas.pistons",
    "linear tensioner": "top.tensioners.linear or linearised",
    "tabulated tensioner": "top.tensioners.table",
    "tensioner damping": "top.tensioners.damping",
    "end stops": "top.tensioners.stroke",
    "tensioner cylinders": "top.tensioners",
    "inner flex joint": "riser.flex_joint_below",
    "soil": "soil",
    "sliding tension": "top.telescopic_joint.tension",
    "vessel": "vessel",
    "thrusters": "vessel.thrusters",
    "heading control": "vessel.thrusters.yaw",
    "Munk moment": "vessel.yaw, and a current",
    "torsion": "vessel.yaw, and riser.shear_modulus",
    "stress gauge": "analysis.output.stress_in",
    "lateral freedom": "a lateral load or motion",
}


def absent(present: set[str]) -> dict[str, str]:
    """Effects that are not there, with what would call for them."""
    return {name: f"no {why}" for name, why in CALLED_BY.items() if name not in present}
