"""What waves do to a section depends on two of its fields: drag alone is half of a Morison force."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from riserstudy.scene.resolve import Resolved


def without_inertia(scene: Resolved) -> list[str]:
    """Warnings about sections that waves drag and do not accelerate, since they tell no added mass.

    The water's own acceleration pushes with 1 + Ca; a coefficient of 0 leaves the 1, an absent field nothing.
    """
    if scene.wave is None:
        return []
    return [
        f"{section.line}.added_mass: {section.name!r} has drag in waves but no added mass, so the water's "
        "acceleration exerts no force on it; a coefficient of 0 gives the Froude-Krylov force alone"
        for section in scene.riser
        if section.drag is not None and section.added_mass is None
    ]
