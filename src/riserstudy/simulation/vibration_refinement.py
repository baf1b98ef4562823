"""The refinement of a vibration of vortices, whose statistics are known no better than its length allows.

Runs on finer meshes and steps differ by what mesh and step still change, and by chance: where several modes
take turns, no two runs have the same statistics. Halving reduces the first and never the second. So mesh
and step are halved until what finer runs would still show is within the request. Chance is part of the
estimated error, and where it alone exceeds the request, the run warns of it.
"""

from __future__ import annotations

from riserstudy.dataset.result import Result
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.refine import Refinement
from riserstudy.simulation.time_limit import Watch
from riserstudy.simulation.tolerance import in_words

HALVINGS = (
    4  # of mesh, and of step: then statistics that still change are those of another vibration
)


class VibrationRefinement(Refinement):
    """Halve mesh or step until their errors, chance aside, are below what is asked for."""

    def __init__(self, scene: Resolved, watch: Watch | None = None) -> None:
        super().__init__(scene, watch)
        self.halvings = dict.fromkeys(self.ways, 0)

    def result(self) -> Result:
        """The finest run, with the error estimated for it; it warns where chance exceeds the request.

        Raises
        ------
        SimulationError
            As any refinement.
        """
        finest = super().result()
        error = finest.facts["error_estimate"]
        excess = self._excess(error)
        if excess > 1.0 and self._next_way() is None:
            finest.facts["warnings"].append(
                f"accuracy not reached: statistics of runs of this length scatter by {in_words(error)}. "
                "Finer meshes and shorter steps do not reduce this scatter; run longer by a factor of about "
                f"{excess**2:.2g}, or run several seeds"
            )
        return finest

    def _next_way(self) -> str | None:
        """What to halve next; None where finer runs would change less than is asked for."""
        if self._unknown:
            return self._unknown[0]
        above = [one.above for one in self.seen.values()]
        left = {name: sum(error.get(name, 0.0) for error in above) for name in self.target}
        if self._excess(left) <= 1.0:
            return None
        return max(self.ways, key=lambda way: self._excess(self.seen[way].above))

    @property
    def _stale(self) -> str | None:
        """None: of a vibration, another run of the same mesh or step would show as much of chance."""
        return None

    def _halve(self, way: str) -> None:
        self.halvings[way] += 1
        super()._halve(way)

    def _too_fine(self, way: str) -> bool:
        return self.halvings[way] >= HALVINGS or super()._too_fine(way)

    def _not_reached(self, finest: Result) -> str:
        """What is to be said of statistics that finer and finer runs still change."""
        why = super()._not_reached(finest)
        if max(self.halvings.values()) < HALVINGS:
            return why
        return f"{why}. The riser may vibrate in one mode or in another: compare several seeds"
