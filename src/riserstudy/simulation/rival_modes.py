"""Modes of which any one may last in a current: the estimate of an error cannot show which.

A riser that vibrates steadily in one of them may have vibrated in another, from another seed, mesh or step.
Coarser runs that chose alike show no difference.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.errors import SimulationError
from riserstudy.model.vortices import shedding, synchronised

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts
    from riserstudy.scene.resolve import Resolved

FIRST = 20  # modes that are looked at, each in both directions
MOST_OF = 0.5  # of the riser, along which vortices may follow a mode that lasts
EDGE = (
    0.1  # of a natural frequency: at the edge of lock-in a riser vibrates a little beside its own
)
APART = 1.05  # ratio of frequencies of two modes: those of both directions are closer


def rivals(scene: Resolved) -> list[float]:
    """Natural frequencies (Hz) that vortices may follow along most of the riser, rising.

    About the equilibrium in still water, of the lowest modes; empty in a scene without vortices or a current.
    """
    if scene.current is None or not shedding(scene):
        return []
    from riserstudy.simulation.modes import modes_of  # with libraries that other runs do not need

    modes = modes_of(scene, FIRST)
    lateral = modes["frequency"].values[modes["motion"].values == "lateral"]
    found: list[float] = []
    for frequency in map(float, lateral):
        apart = not found or frequency > APART * found[-1]
        if apart and synchronised(scene, frequency, EDGE) > MOST_OF:
            found.append(frequency)
    return found


def warn_of_rivals(scene: Resolved, facts: RunFacts) -> None:
    """Warn of a vibration that may as well be that of another mode, or where that cannot be told."""
    try:
        found = rivals(scene)
    except SimulationError as error:  # of the modes; the run itself is whole
        facts["warnings"].append(
            f"riser.viv: the check for several competing modes failed: {error}"
        )
        return
    if len(found) > 1:
        listed = ", ".join(f"{frequency:.3g}" for frequency in found[:3])
        more = f" and {len(found) - 3} more" if len(found) > 3 else ""
        facts["warnings"].append(
            f"riser.viv: vortices may lock in to modes of {listed} Hz{more} along most of the riser. Which "
            "mode persists can depend on seed, mesh and step, and the estimated error does not include this: "
            "compare runs with other values of riser.viv.seed, and on a finer mesh"
        )
