"""The change by halving a mesh or a time step, and the remaining error."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from copy import copy

from riserstudy.simulation.error_estimate import controlled
from riserstudy.simulation.remaining_error import MOST_FALL, estimate

UNKNOWN_FALL = 8.0  # decrease of an error by its next halving, if there was only one


class Halved:
    """The change by halving mesh or time step, and the remaining error.

    Parameters
    ----------
    change : relative difference of the two runs, by quantity.
    before : the previous halving of the same kind (mesh or step).
    floor : changes up to which the difference of two runs may be chance, by quantity.
    most : largest ratio of successive changes that the estimate uses.
    sure : largest ratios in place of those of `SURE`, by quantity.
    """

    def __init__(
        self,
        change: dict[str, float],
        before: Halved | None,
        floor: dict[str, float] | None = None,
        most: float = MOST_FALL,
        sure: Mapping[str, float] | None = None,
    ) -> None:
        self.change = change
        worst = max(controlled(change), key=lambda name: change[name], default="")
        was = before.change.get(worst, 0.0) if before else 0.0
        #: decrease of the largest controlled change since the previous halving; if unknown, `UNKNOWN_FALL`
        self.fall: float = max(was / change[worst], 1.0) if was and change[worst] else UNKNOWN_FALL
        self.error = estimate(change, before.change if before else None, most, sure)
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


def enter(
    seen: dict[str, Halved],
    way: str,
    change: dict[str, float],
    floor: dict[str, float] | None = None,
    most: float = MOST_FALL,
    sure: Mapping[str, float] | None = None,
) -> Halved:
    """Record the relative change (1) by halving mesh or step, and count it for the age of earlier ones.

    ``floor``: changes that are within chance, by quantity. ``most``, ``sure``: as for `Halved`.
    """
    now = Halved(change, seen.get(way), floor, most, sure)
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
