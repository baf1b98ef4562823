"""A static run has no time: motions, waves and ramps of its scene have no effect."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.scene.forcing import TILTS, TRANSLATIONS

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts


def without_time(scene: Parts) -> list[str]:
    """A warning if a static run has keys that act in a dynamic run only."""
    if scene.analysis.duration is not None:
        return []
    lines = []
    for part, names in (
        ("platform", (*TRANSLATIONS, *TILTS, "cruise", "response")),
        ("vessel", ("wind", "wave_drift", "thrusters")),
        ("current", ("ramp",)),
    ):
        given = getattr(scene, part)
        lines += [f"{part}.{name}" for name in names if given and getattr(given, name)]
    if scene.wave:
        lines.append("wave")
    if scene.analysis.start not in (None, "equilibrium"):
        lines.append("analysis.start")
    if not lines:
        return []
    return [
        f"{', '.join(lines)}: no effect in a static run. Give analysis.duration and analysis.output for a "
        f"dynamic run, or remove {'these keys' if len(lines) > 1 else 'this key'}"
    ]
