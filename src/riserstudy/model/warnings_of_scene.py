"""What a run warns of before its first step, as its scene shows it."""

from __future__ import annotations

from riserstudy.model import rao
from riserstudy.scene.motion_records import uncovered
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sudden import sudden_wave
from riserstudy.scene.wave_forces import without_inertia
from riserstudy.scene.weight import doubts
from riserstudy.scene.without_time import without_time


def warnings_of(scene: Resolved) -> list[str]:
    """Warnings about a scene, whatever solves it."""
    return [
        *doubts(scene),
        *without_time(scene),
        *uncovered(scene),
        *without_inertia(scene),
        *sudden_wave(scene),
        *rao.doubts(scene),
    ]
