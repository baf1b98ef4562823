"""A static run has no time: motions, waves and ramps of its scene have no effect."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.forcing import TILTS, TRANSLATIONS

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts


def without_time(scene: Parts) -> list[RunWarning]:
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
    text = (
        "{paths}: no effect in a static run. Give analysis.duration and analysis.output for a dynamic "
        "run, or remove {them}"
    )
    values = {"paths": ", ".join(lines), "them": "these keys" if len(lines) > 1 else "this key"}
    return [warning("no_effect_in_a_static_run", text, values)]
