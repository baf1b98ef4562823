"""Parts of a scene in words: a schematic names none as its file does."""

from __future__ import annotations

WORDS = {
    # what makes a riser move aside, or out of the plane
    "current": "the current",
    "current.heading": "the direction of the current",
    "current.headings": "the directions of the current",
    "wave": "waves",
    "wave.heading": "the direction of the waves",
    "platform.position.surge": "the platform's offset",
    "platform.position.sway": "the platform's offset in sway",
    "platform.position.pitch": "the platform's trim",
    "platform.position.roll": "the platform's heel",
    "platform.position.yaw": "the platform's heading",
    "platform.surge": "the platform's surge",
    "platform.sway": "the platform's sway",
    "platform.roll": "the platform's roll",
    "platform.pitch": "the platform's pitch",
    "platform.yaw": "the platform's yaw",
    "platform.response": "the platform's response to waves",
    "platform.cruise": "the platform's voyage",
    "platform.cruise.heading": "the direction of the platform's voyage",
    "vessel": "the platform, which is free to surge",
    "vessel.heading": "the platform's heading",
    "vessel.wind.heading": "the direction of the wind",
    "vessel.wave_drift.heading": "the direction of the wave drift",
    "vessel.thrusters.heading": "the direction of the thrusters",
    "vessel.thrusters.yaw.command": "the thrusters, which turn the platform",
    "soil": "the soil around the conductor",
    "top.offset": "the offset of the upper end",
    "top.tensioners": "tensioners that pull aside",
    "top.tensioners.failed": "failed tensioners",
    "top.lateral_force": "the lateral force at the top",
    "riser.lateral_load": "a line load across the riser",
    "riser.viv": "vortex-induced vibration",
    # what is not drawn
    "riser.modules": "buoyancy modules",
    "riser.lines": "auxiliary lines",
    "top.held_at_tension": "tension that sets the height of the top",
    "top.tension_loss": "loss of tension",
    "vessel.hull_drag": "drag on the hull",
    "buoyancy": "buoyancy as a share of the weight",
    "disconnect": "the disconnect",
    "fatigue": "details of fatigue",
}


def in_words(part: str) -> str:
    """A part of a scene, as ``top.offset``, as one would say it."""
    return WORDS.get(part, part.replace(".", " ").replace("_", " "))
