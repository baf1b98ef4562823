"""Sections of the page of signs and definitions for fields of a scene, for errors about them."""

from __future__ import annotations

import re

from riserstudy.errors import InputError

PAGE = "docs/conventions.md"
#: sections of the page, by words in a field's path; the last part of the path has priority
SECTIONS = {
    "tensioners-and-telescopic-joint": ("stroke", "mid_stroke", "reach", "telescopic_joint"),
    "angles": ("angle", "rotation", "roll", "pitch", "yaw"),
    "moment-and-shear-force": ("moment", "bending_moment", "shear", "flex_joint_below"),
    "tension": ("tension", "submerged_weight", "weight", "tensioners", "overpull"),
    "axes-and-places": (
        "elevation", "offset", "position", "surge", "sway", "heave", "heading", "surface_speed",
        "towards", "seabed", "surface", "mudline", "datum",
    ),
    "errors": ("accuracy",),
}  # fmt: skip


def where_defined(error: Exception) -> str:
    """Text to append to an error about a signed or defined quantity; "" for others."""
    if not isinstance(error, InputError):
        return ""
    for part in reversed(re.split(r"[^a-z_]+", error.field)):
        for section, words in SECTIONS.items():
            if part in words:
                return f" (signs and definitions: {PAGE}#{section})"
    return ""
