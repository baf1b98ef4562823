"""Modes of which each may persist in a current; the error estimate cannot show which of them does.

A riser that vibrates steadily in one of them might vibrate in another with another seed, mesh or step. If
coarser runs vibrate in the same mode, they show no difference.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.errors import SimulationError
from riserstudy.model.vortices import shedding, synchronised
from riserstudy.records.warning import warning

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts
    from riserstudy.scene.resolve import Resolved

FIRST = 20  # number of modes that are examined, each in both directions
# smallest share of the riser along which vortices can synchronise with a mode that persists
MOST_OF = 0.5
# relative: at the edge of lock-in, the frequency differs a little from the natural frequency
EDGE = 0.1
# smallest ratio of frequencies of different modes; one mode in two directions is closer
APART = 1.05


def rivals(scene: Resolved) -> list[float]:
    """Natural frequencies (Hz), increasing, with which vortices can synchronise along most of the riser.

    They are those of the lowest modes about the equilibrium in still water; empty without vortices or
    current.
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
    """Warn if a vibration might equally be in another mode, or if this cannot be determined."""
    if shedding(scene) and scene.platform and scene.platform.cruise:
        text = (
            "riser.viv: whether several modes compete is not checked for a platform that cruises: compare "
            "runs with other values of riser.viv.seed, and on a finer mesh"
        )
        facts["warnings"].append(warning("competing_modes_not_checked", text))
        return
    try:
        found = rivals(scene)
    except SimulationError as error:  # of the modes; the run itself is complete
        text = "riser.viv: the check for several competing modes failed: {error}"
        facts["warnings"].append(warning("competing_modes_unknown", text, {"error": str(error)}))
        return
    if len(found) > 1:
        values: dict[str, float] = dict(zip(("first", "second", "third"), found, strict=False))
        listed, more = ", ".join(f"{{{name}:.3g}}" for name in values), ""
        if len(found) > len(values):
            values["others"], more = len(found) - len(values), " and {others} more"
        text = (
            f"riser.viv: vortices may lock in to modes of {listed} Hz{more} along most of the riser. Which "
            "mode persists can depend on seed, mesh and step, and the estimated error does not include this: "
            "compare runs with other values of riser.viv.seed, and on a finer mesh"
        )
        facts["warnings"].append(warning(f"competing_modes_{len(values)}", text, values))
