"""Errors of a refinement by mesh and by time step, and the choice of the one to halve next.

Nothing here runs a simulation. A refinement enters the change that each halving made, and asks what to halve.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from riserstudy.simulation.halved import Halved, enter, error_of
from riserstudy.simulation.sampling_error import floor, of_two_runs

RUNS = 16  # largest number of halvings of mesh or step
FALL = 1.5  # smallest decrease of differences by a halving for the same halving to be repeated
STALE = 2  # halvings after which an error is estimated again
# predicted error, as a multiple of the tolerance, from which on the next run is not the last
LIKELY = 1.5
MATTERS = 0.25  # error, as a share of the tolerance, from which on it is estimated again


class Convergence:
    """Changes by halving mesh or time step, and the remaining errors.

    Every run is compared with the previous run, which differs only in mesh or only in step. If halving one
    did not reduce the differences, the other is halved next. A long step damps motions that only a fine mesh
    represents, and a coarse mesh omits motions that only a short step represents. An error that was estimated
    long before the end is therefore estimated again, by runs that are coarser in the one quantity alone.

    Parameters
    ----------
    tolerance : allowed relative error (1), by quantity.
    ways : which of "mesh" and "step" can be halved, the first to be halved first.
    """

    def __init__(self, tolerance: Mapping[str, float], ways: Sequence[str]) -> None:
        self.tolerance, self.ways = tolerance, ways
        self.way = ways[0] if ways else ""  # halved last
        self.halved: dict[str, Halved] = {}  # last halving, by way
        self.helps = True  # whether the last halving reduced the differences
        self.chance: dict[str, float] = {}  # differences by chance of two runs like the finest
        # ratios of error to tolerance of the runs, from the first complete estimate on
        self.excesses: list[float] = []

    def enter(self, change: dict[str, float], sampling: dict[str, float]) -> None:
        """Enter the relative change (1) of each quantity by the last halving.

        ``sampling``: standard errors of the finer run's statistics, due to its length.
        """
        before = self.halved.get(self.way)
        now = enter(self.halved, self.way, change, floor(sampling))
        self.helps = before is None or self.excess(before.change) > FALL * self.excess(now.change)

    def enter_again(self, way: str, changes: Sequence[dict[str, float]]) -> None:
        """Enter the relative changes (1) by the last halvings of one way alone, the finest runs' first."""
        if changes:
            before = Halved(changes[1], None) if len(changes) > 1 else None
            self.halved[way] = Halved(changes[0], before)

    def note_run(self, sampling: dict[str, float]) -> None:
        """Take over the relative standard errors (1) of the finest run, and add its excess to the list."""
        self.chance = of_two_runs(sampling)
        if not self.unknown:
            self.excesses.append(self.excess(self.error))

    @property
    def error(self) -> dict[str, float]:
        """Estimated relative error of mesh and step together, by quantity."""
        return dict.fromkeys(self.tolerance, 0.0) | error_of(self.halved.values(), self.chance)

    @property
    def estimated(self) -> dict[str, float]:
        """Relative errors (1) of the quantities of the last comparison; none if a way is unknown."""
        known = self.halved[self.way].change if self.way in self.halved and not self.unknown else {}
        return {name: error for name, error in self.error.items() if name in known}

    @property
    def unknown(self) -> list[str]:
        """The ways that have not been halved yet."""
        return [way for way in self.ways if way not in self.halved]

    def excess(self, error: Mapping[str, float]) -> float:
        """The largest ratio of error to tolerance (1)."""
        return max(error.get(name, 0.0) / limit for name, limit in self.tolerance.items())

    def worst(self) -> str:
        """The quantity with the largest ratio of error to tolerance."""
        error = self.error
        return max(self.tolerance, key=lambda name: error[name] / self.tolerance[name])

    @property
    def may_suffice(self) -> bool:
        """Whether the next run may be the last, if errors continue to decrease as before."""
        if set(self.unknown) - {self.way}:
            return False
        fall = {way: one.fall if way == self.way else 1.0 for way, one in self.halved.items()}
        left = {
            name: sum(one.error.get(name, 0.0) / fall[way] for way, one in self.halved.items())
            for name in self.tolerance
        }
        return self.excess(left) <= LIKELY

    def next_way(self) -> str | None:
        """The next one of mesh and step to halve; None if the tolerance is met."""
        if self.unknown:
            return self.unknown[0]
        if self.excess(self.error) <= 1.0:
            return self.stale
        if len(self.ways) > 1 and not self.helps:  # a constant error may be due to the other
            return self.ways[1 - self.ways.index(self.way)]
        return max(self.ways, key=lambda way: self.excess(self.halved[way].error))

    @property
    def stale(self) -> str | None:
        """The one of mesh and step with a significant error that was estimated long before the final run."""
        if self.unknown or self.excess(self.error) > 1.0:
            return None
        old = [way for way in self.ways if self.halved[way].since >= STALE]
        return next((way for way in old if self.excess(self.halved[way].error) > MATTERS), None)

    def time_left(self, seconds: float) -> float:
        """Estimated time left (s), if each halving reduces its error to a quarter and doubles the time.

        ``seconds``: time of the last run.
        """
        excess = {way: self.excess(one.error) for way, one in self.halved.items()}
        total = 0.0
        for _ in range(RUNS):
            seconds *= 2.0
            total += seconds
            worst = max(excess, key=lambda way: excess[way])
            excess[worst] *= 0.25
            if sum(excess.values()) <= 1.0:
                break
        return total
