"""The refinement of a vortex-induced vibration, whose statistics are limited by the length of the run.

Runs with finer meshes and steps differ by the error of mesh and step, and by chance: if several modes
alternate, no two runs have the same statistics. Halving reduces the first and never the second. Mesh and step
are therefore halved until the error of mesh and step alone is within the tolerance. Chance is part of the
estimated error. If it alone exceeds the tolerance, the run has a warning.
"""

from __future__ import annotations

from riserstudy.dataset.result import Result
from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.convergence import Convergence
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.time_limit import Watch

# largest number of halvings of mesh and of step: statistics that still change are of another vibration
HALVINGS = 4


class VibrationConvergence(Convergence):
    """Errors of mesh and step, without chance, decide what is halved next."""

    def next_way(self) -> str | None:
        """The next one of mesh and step to halve; None if finer runs would change less than the tolerance."""
        if self.unknown:
            return self.unknown[0]
        above = [one.above for one in self.halved.values()]
        left = {name: sum(error.get(name, 0.0) for error in above) for name in self.tolerance}
        if self.excess(left) <= 1.0:
            return None
        return max(self.ways, key=lambda way: self.excess(self.halved[way].above))

    @property
    def stale(self) -> str | None:
        """None: errors are not estimated again, since further runs would differ by the same chance."""
        return None


class VibrationRefinement(Refinement):
    """Halve mesh or step until their errors, without chance, are below the tolerance."""

    rule = VibrationConvergence

    def __init__(self, scene: Resolved, watch: Watch | None = None) -> None:
        super().__init__(scene, watch)
        self.halvings = dict.fromkeys(self.convergence.ways, 0)

    def result(self) -> Result:
        """The finest run with its estimated error, and with a warning if chance exceeds the tolerance.

        Raises SimulationError as in `Refinement.result`.
        """
        finest = super().result()
        error = finest.facts["error_estimate"]
        excess = self.convergence.excess(error)
        if excess > 1.0 and self.convergence.next_way() is None:
            text = (
                "accuracy not reached: statistics of runs of this length scatter by {errors:percent}. Finer "
                "meshes and shorter steps do not reduce this scatter; run longer by a factor of about "
                "{longer:.2g}, or run several seeds"
            )
            values = {"errors": error, "longer": excess**2}
            finest.facts["warnings"].append(warning("scatter_of_a_vibration", text, values))
        return finest

    def _halve(self, way: str) -> None:
        self.halvings[way] += 1
        super()._halve(way)

    def _too_fine(self, way: str) -> bool:
        return self.halvings[way] >= HALVINGS or super()._too_fine(way)

    def _not_reached(self, finest: Result) -> RunWarning:
        """The warning about statistics that still change with finer runs."""
        why = super()._not_reached(finest)
        if max(self.halvings.values()) < HALVINGS:
            return why
        text = f"{why['text']}. The riser may vibrate in one mode or in another: compare several seeds"
        return warning(f"{why['kind']}_of_a_vibration", text, why["values"])
