"""Words for parts of a scene that are not drawn, as a schematic does not use the names of files."""

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
    """Return the words for a part of a scene such as ``top.offset``."""
    return WORDS.get(part, part.replace(".", " ").replace("_", " "))
