"""Parts of a scene that are not drawn, in words: a schematic names none as its file does."""

from __future__ import annotations

WORDS = {
    "riser.modules": "buoyancy modules",
    "riser.lines": "auxiliary lines",
    "top.held_at_tension": "tension that sets the height of the top",
    "top.tension_loss": "loss of tension",
    "vessel.hull_drag": "drag on the hull",
    "buoyancy": "buoyancy blocks, which the weight in water includes",
    "disconnect": "the disconnect",
    "fatigue": "details of fatigue",
}


def in_words(part: str) -> str:
    """A part of a scene, as ``top.offset``, as one would say it."""
    return WORDS.get(part, part.replace(".", " ").replace("_", " "))
