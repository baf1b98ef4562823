"""What halving a mesh or a time step was seen to change, and the error that it left."""

from __future__ import annotations

from collections.abc import Collection
from copy import copy

from riserstudy.simulation.error_estimate import MOST_FALL, SURE_FALL, controlled, estimate


class Halved:
    """What halving mesh or step was seen to change, and the error that it left.

    Parameters
    ----------
    change : relative difference of the two runs, by quantity.
    before : the same of the halving before, of the same of mesh and step.
    floor : changes up to which two runs show nothing but chance, by quantity.
    """

    def __init__(
        self,
        change: dict[str, float],
        before: Halved | None,
        floor: dict[str, float] | None = None,
    ) -> None:
        self.change = change
        worst = max(controlled(change), key=lambda name: change[name], default="")
        was = before.change.get(worst, 0.0) if before else 0.0
        #: of the largest controlled change since the one before; unknown: as much as is believed
        self.fall: float = max(was / change[worst], 1.0) if was and change[worst] else MOST_FALL
        # with another mesh or step changes are alike, but not to the third order; and after a fall that
        # was less than that of the second, a steep one may be chance
        doubtful = before and (before.since or before.fall < SURE_FALL)
        most = SURE_FALL if doubtful else MOST_FALL
        self.error = estimate(change, before.change if before else None, most)
        chance = floor or {}
        #: the part of it that lies above chance, which a finer run would reduce
        self.above = {k: v for k, v in self.error.items() if change[k] > chance.get(k, 0.0)}
        #: changes within chance: what two runs differ by, however fine
        self.within = {k: v for k, v in change.items() if k in chance and k not in self.above}
        self.since: int = 0  # halvings of the other

    def scaled(self, by: dict[str, float]) -> Halved:
        """The same of runs that differ and err more, each quantity by a factor (1)."""
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
) -> Halved:
    """Enter the relative change by halving one of mesh and step (1); what was seen before is older now.

    ``floor``: changes that are within chance, by quantity.
    """
    now = Halved(change, seen.get(way), floor)
    for one in seen.values():
        one.since += 1
    seen[way] = now
    return now


def error_of(seen: Collection[Halved], chance: dict[str, float]) -> dict[str, float]:
    """Estimated relative error of a run, by quantity (1).

    What all halvings left, and the largest of all differences by chance: those that were seen, and those
    that its own length makes likely, ``chance``.
    """
    names = dict.fromkeys(name for one in seen for name in one.error)
    return {
        name: sum(one.above.get(name, 0.0) for one in seen)
        + max([chance.get(name, 0.0), *(one.within.get(name, 0.0) for one in seen)])
        for name in names
    }
