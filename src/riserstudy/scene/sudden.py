"""Loads and motions that start as a step, which sends short waves along the riser."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.records.warning import RunWarning, warning

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts


def sudden_starts(scene: Parts) -> list[str]:
    """Keys of a scene by which a wave or a motion starts as a step, without a ramp."""
    lines = []
    if scene.wave and scene.wave.ramp is None:
        lines.append("wave")
    if scene.platform:
        lines += [f"platform.{line}" for line, _ in scene.platform.sudden]
    return list(dict.fromkeys(lines))


def sudden_wave(scene: Parts) -> list[RunWarning]:
    """A warning if a wave starts as a step, and the engine chooses mesh and time step."""
    a = scene.analysis
    chosen = a.duration is not None and a.mesh is None and a.solver is None
    damped = all(s.structural_damping for s in scene.riser) and a.output and a.output.start
    if not chosen or damped or scene.wave is None or scene.wave.ramp is not None:
        return []
    text = (
        "wave: starts as a step, without a ramp. Moments then converge slowly: a run takes up to a "
        "hundred times as long. Give, for example, wave.ramp: {ramp:.3g} s"
    )
    return [warning("sudden_wave", text, {"ramp": 2.0 * scene.wave.shortest_period})]
