"""Wave forces on a section require both drag and added mass: drag alone is half of a Morison force."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from riserstudy.scene.resolve import Resolved


def without_inertia(scene: Resolved) -> list[str]:
    """Warnings about sections with drag but without added mass, on which waves exert no inertia force.

    The inertia force has the factor 1 + Ca. With a coefficient of 0 the factor is 1; with an absent field
    there is no inertia force.
    """
    if scene.wave is None:
        return []
    return [
        f"{section.line}.added_mass: {section.name!r} has drag in waves but no added mass, so the water's "
        "acceleration exerts no force on it; add added_mass (its coefficient 0 gives the Froude-Krylov force)"
        for section in scene.riser
        if section.drag is not None and section.added_mass is None
    ]
