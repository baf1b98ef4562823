"""The change by halving a mesh or a time step, and the remaining error."""

from __future__ import annotations

from collections.abc import Collection
from copy import copy
from itertools import pairwise

from riserstudy.model.layout import stiffness
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import RigidBody
from riserstudy.simulation.error_estimate import MOST_FALL, SURE_FALL, controlled, estimate

JUMP = 0.01  # smallest jump of bending stiffness that reduces the order of a mesh, as a share of the larger


class Halved:
    """The change by halving mesh or time step, and the remaining error.

    Parameters
    ----------
    change : relative difference of the two runs, by quantity.
    before : the previous halving of the same kind (mesh or step).
    floor : changes up to which the difference of two runs may be chance, by quantity.
    most : largest ratio of successive changes that the estimate uses, as by `most_fall`.
    """

    def __init__(
        self,
        change: dict[str, float],
        before: Halved | None,
        floor: dict[str, float] | None = None,
        most: float = MOST_FALL,
    ) -> None:
        self.change = change
        worst = max(controlled(change), key=lambda name: change[name], default="")
        was = before.change.get(worst, 0.0) if before else 0.0
        #: decrease of the largest controlled change since the previous halving; if unknown, `MOST_FALL`
        self.fall: float = max(was / change[worst], 1.0) if was and change[worst] else MOST_FALL
        # If the other of mesh and step was halved in between, changes are comparable only to second order;
        # and after a decrease of less than second order, a steep decrease may be chance.
        doubtful = before and (before.since or before.fall < SURE_FALL)
        most = min(SURE_FALL, most) if doubtful else most
        self.error = estimate(change, before.change if before else None, most)
        chance = floor or {}
        #: errors of quantities whose change exceeds chance, which a finer run would reduce
        self.above = {k: v for k, v in self.error.items() if change[k] > chance.get(k, 0.0)}
        #: changes within chance, which finer runs would not reduce
        self.within = {k: v for k, v in change.items() if k in chance and k not in self.above}
        self.since: int = 0  # number of halvings since this one

    def scaled(self, by: dict[str, float]) -> Halved:
        """A copy with changes and errors multiplied by a factor (1) for each quantity."""
        other = copy(self)
        other.change = {name: by.get(name, 1.0) * value for name, value in self.change.items()}
        other.error = {name: by.get(name, 1.0) * value for name, value in self.error.items()}
        other.above = {name: by.get(name, 1.0) * value for name, value in self.above.items()}
        return other


def most_fall(scene: Resolved, way: str) -> float:
    """Largest ratio of successive changes by halving mesh or step that an estimate uses (1).

    It is that of second order for meshes of a riser whose stiffness jumps between sections, where the shear
    has a corner. If other errors decrease faster at first, the larger ratio hides this error.
    """
    bending = [(stiffness(s).bending, s.corner_below) for s in scene.riser if not isinstance(s, RigidBody)]
    jumps = (
        abs(above - below) > JUMP * max(above, below)
        for (below, _), (above, cornered) in pairwise(bending)
        if not cornered
    )
    return SURE_FALL if way == "mesh" and any(jumps) else MOST_FALL


def enter(
    seen: dict[str, Halved],
    way: str,
    change: dict[str, float],
    floor: dict[str, float] | None = None,
    most: float = MOST_FALL,
) -> Halved:
    """Record the relative change (1) by halving mesh or step, and count it for the age of earlier ones.

    ``floor``: changes that are within chance, by quantity. ``most``: as for `Halved`.
    """
    now = Halved(change, seen.get(way), floor, most)
    for one in seen.values():
        one.since += 1
    seen[way] = now
    return now


def error_of(seen: Collection[Halved], chance: dict[str, float]) -> dict[str, float]:
    """Estimated relative error of a run, by quantity (1).

    It is the sum of the errors that all halvings leave, plus the largest difference by chance. The latter is
    the largest of the differences that were found, and of ``chance``, which follows from the run's length.
    """
    names = dict.fromkeys(name for one in seen for name in one.error)
    return {
        name: sum(one.above.get(name, 0.0) for one in seen)
        + max([chance.get(name, 0.0), *(one.within.get(name, 0.0) for one in seen)])
        for name in names
    }
