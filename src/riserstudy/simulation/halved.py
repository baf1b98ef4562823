"""What halving a mesh or a time step was seen to change, and the error that it left."""

from __future__ import annotations

from copy import copy

from riserstudy.simulation.error_estimate import MOST_FALL, SURE_FALL, controlled, estimate


class Halved:
    """What halving mesh or step was seen to change, and the error that it left.

    Parameters
    ----------
    change : relative difference of the two runs, by quantity.
    before : the same of the halving before, of the same of mesh and step.
    """

    def __init__(self, change: dict[str, float], before: Halved | None) -> None:
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
        self.since: int = 0  # halvings of the other

    def scaled(self, by: dict[str, float]) -> Halved:
        """The same of runs that differ and err more, each quantity by a factor (1)."""
        other = copy(self)
        other.change = {name: by.get(name, 1.0) * value for name, value in self.change.items()}
        other.error = {name: by.get(name, 1.0) * value for name, value in self.error.items()}
        return other


def enter(seen: dict[str, Halved], way: str, change: dict[str, float]) -> Halved:
    """Enter the relative change by halving one of mesh and step (1); what was seen before is older now."""
    now = Halved(change, seen.get(way))
    for one in seen.values():
        one.since += 1
    seen[way] = now
    return now
