"""Refine mesh and time step until the estimated error is below the tolerance.

docs/measured_accuracy.md shows one refinement as a table, with one row per run.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any, ClassVar

from riserstudy.dataset.result import Result
from riserstudy.errors import PhysicallyUnstable, SimulationError, StepFailed, TakesTooLong
from riserstudy.model.mesh import Mesh
from riserstudy.records.numerals import duration, percent
from riserstudy.records.warning import RunWarning
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.convergence import RUNS, Convergence
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.outputs import keep_stations
from riserstudy.simulation.refinement_warnings import missed_accuracy, slow_convergence, sparse_outputs
from riserstudy.simulation.rest import Rest
from riserstudy.simulation.run import finish, march, single
from riserstudy.simulation.run_cost import cost, total_seconds
from riserstudy.simulation.starting_mesh import coarsest_mesh, massless, period
from riserstudy.simulation.thinning import thinned
from riserstudy.simulation.time_limit import Watch, size
from riserstudy.simulation.time_stepping import steps_in
from riserstudy.simulation.tolerance import allowed_of, raise_if_buckling

SEGMENTS = 50_000  # largest number of segments
STEPS_A_PERIOD = 24  # number of the coarsest time steps in a period


def _exact(result: Result) -> Result:
    """A run without a coarser run for comparison, since its result is exact."""
    result.facts["error_estimate"] = {}
    return result


class Refinement:
    """Halve mesh or time step, as `Convergence` chooses, until both errors together meet the tolerance."""

    #: estimates errors, and chooses mesh or step
    rule: ClassVar[type[Convergence]] = Convergence

    def __init__(self, scene: Resolved, watch: Watch | None = None) -> None:
        self.scene, self.watch = scene, watch or Watch()
        self.meshes = [coarsest_mesh(scene)]  # each with the segments of the previous mesh halved
        self.step = _longest_step(scene) if scene.analysis.duration else None
        ways = [] if massless(scene) else ["mesh"]
        ways += ["step"] if self.step else []
        self.convergence = self.rule(allowed_of(scene), ways)
        self.lost = 0  # meshes without equilibrium
        self.last: Result | None = None  # run to compare the next run with
        self.finest: Result | None = None  # finest completed run
        self.finest_mesh = self.mesh
        self.rest: Rest | None = None  # scene at rest on the last mesh
        self.thin = False  # whether the run has fewer outputs than requested
        self.spent: list[dict[str, Any]] = []  # cost of each run

    def result(self) -> Result:
        """The finest run, with its estimated error.

        Raises SimulationError as `run` does: no equilibrium, a failed step, buckling that no mesh resolves,
        no time left.
        """
        if not self.convergence.ways:  # a massless spring at rest
            return _exact(single(self.scene, self.mesh, self.step))
        try:
            reached = self._refine()
        except TakesTooLong as late:
            if self.finest is None:
                raise TakesTooLong(
                    f"no run was completed within the time limit of {self.watch.patience:g} s: {late}; allow "
                    "more time, or give a shorter analysis.duration or a larger analysis.accuracy"
                ) from None
            reached = False
            self._out_of_patience(self.finest)
        finest = self.finest
        if finest is None:
            raise TypeError("no run and no error")  # cannot occur
        finish(self.scene, self.finest_mesh, finest)
        self.spent[-1] = cost(finest)
        if not reached:
            finest.facts["warnings"].append(self._not_reached(finest))
        finest.facts["warnings"] += slow_convergence(self.scene, self.convergence.halved.get("step"))
        finest.facts["solve_seconds"] = total_seconds(self.spent)
        finest.facts["refinements"] = self.spent
        output = self.scene.analysis.output
        keep_stations(finest, output.stations if output else None)
        return finest

    def _refine(self) -> bool:
        """Run with finer and finer mesh and step; returns whether the tolerance is met.

        Raises TakesTooLong when the time limit ends before that.
        """
        left = RUNS
        while True:
            self._begin()
            finer = self._attempt(left)
            if finer is not None:
                self._compare(finer)
                if stale := self.convergence.stale:
                    self._reestimate(finer, stale)
                way = self.convergence.next_way()
                if way is None or left == 0 or self._too_fine(way):
                    if not self.thin or self._repeated(left):
                        return way is None
                else:
                    self._check_patience()
                    self._halve(way)
            left -= 1

    def _repeated(self, left: int) -> bool:
        """Repeat the run that proved to be the last, with all outputs; False if an output is not finite."""
        if self.finest is None:
            return False
        try:
            whole = self._attempt(left, whole=True)
        except TakesTooLong:
            self._out_of_patience(self.finest)
            return True
        if whole is None:
            return False
        whole.facts["error_estimate"] = self.finest.facts["error_estimate"]
        self.spent.append(cost(whole))
        self.finest = whole
        return True

    def _out_of_patience(self, finest: Result) -> None:
        """Record that the time limit ended the refinement, and which outputs are missing."""
        finest.facts["ended_by"] = f"patience of {self.watch.patience:g} s"
        finest.facts["warnings"] += sparse_outputs(self.scene, finest)

    def _begin(self) -> None:
        """Report the next run, the error of the last run, and the time left."""
        on = f"run {len(self.spent) + 1}: {size(len(self.mesh.l0), self.step)}"
        errors = self.convergence
        if self.spent and not errors.unknown:
            worst, left = errors.worst(), errors.time_left(self.spent[-1]["solve_seconds"])
            off = f"error of {worst} {percent(errors.error[worst])}"
            off += f", tolerance {percent(errors.tolerance[worst])}"
            on += f"; {off}, about {duration(left)} to go"
        self.watch.begin(on)

    def _not_reached(self, finest: Result) -> RunWarning:
        """The warning that the tolerance is not met."""
        return missed_accuracy(finest.facts, len(self.spent), self.watch.patience)

    @property
    def mesh(self) -> Mesh:
        """The present mesh."""
        return self.meshes[-1]

    def _attempt(self, left: int, whole: bool = False) -> Result | None:
        """A run on the present mesh and step; None if it failed, after which mesh or step is finer.

        ``whole``: with all outputs. Otherwise with the outputs for a comparison, unless this may be the last
        run.
        """
        scene, self.thin = self.scene, False
        if not (whole or self.convergence.may_suffice):
            scene, self.thin = thinned(scene, self.step)
        try:
            rest = self._at_rest()
            return march(scene, self.mesh, self.step, watch=self.watch, rest=rest, extremes=not self.thin)
        except (PhysicallyUnstable, TakesTooLong):
            raise
        except StepFailed:
            if left == 0 or self.step is None:
                raise
            self.step, self.last = 0.5 * self.step, None
        except SimulationError:  # no equilibrium found on this mesh
            self.lost += 1
            if left == 0 or self.lost > 2 or "mesh" not in self.convergence.ways:
                raise
            self.meshes.append(self.mesh.halved())
            self.last = None
        return None

    def _at_rest(self) -> Rest | None:
        """The scene at rest on the present mesh, reused if the previous run was on the same mesh."""
        if self.scene.analysis.solver == "hermite":
            return None
        if self.rest is None or not self.rest.again(self.mesh):
            self.rest = Rest(self.scene, self.mesh)
        return self.rest

    def _compare(self, finer: Result) -> None:
        """Evaluate the change by the last halving, and add the estimated error to the run."""
        self.spent.append(cost(finer))
        errors, sampling = self.convergence, finer.facts.get("sampling_error", {})
        if self.last is not None:
            errors.enter(difference(self.last, finer), sampling)
        self.last = self.finest = finer
        self.finest_mesh = self.mesh
        errors.note_run(sampling)
        finer.facts["error_estimate"] = errors.estimated
        if not errors.unknown:
            raise_if_buckling(self.scene, finer, errors.excesses)

    def _reestimate(self, finer: Result, way: str) -> None:
        """Estimate again how changes by mesh or step decrease, by two runs that are coarser in it alone.

        If the first of these runs fails, mesh or step is halved instead.
        """
        runs = [finer]
        for k in (1, 2):
            if way == "mesh" and k >= len(self.meshes):
                break
            mesh = self.meshes[-1 - k] if way == "mesh" else self.mesh
            step = self.step * 2**k if way == "step" and self.step else self.step
            self.watch.begin(
                f"run {len(self.spent) + 1}, to check the error again: {size(len(mesh.l0), step)}"
            )
            try:
                scene = thinned(self.scene, step)[0]
                runs.append(march(scene, mesh, step, watch=self.watch, extremes=False))
            except (PhysicallyUnstable, TakesTooLong):
                raise
            except SimulationError:
                break
            self.spent.insert(-1, cost(runs[-1]))
        changes = [difference(coarse, fine) for fine, coarse in pairwise(runs)]
        self.convergence.enter_again(way, changes)
        known, error = finer.facts["error_estimate"], self.convergence.error
        finer.facts["error_estimate"] = {name: error[name] for name in error if name in known}

    def _check_patience(self) -> None:
        """Refuse a next run that would exceed the time limit: it takes twice the time of the last run."""
        if self.watch.spent + 2.0 * self.spent[-1]["solve_seconds"] > self.watch.patience:
            raise TakesTooLong("the next run would take too long")

    def _too_fine(self, way: str) -> bool:
        return way == "mesh" and 2 * len(self.mesh.l0) > SEGMENTS

    def _halve(self, way: str) -> None:
        self.convergence.way = way
        if way == "mesh":
            self.meshes.append(self.mesh.halved())
        elif self.step:
            self.step = 0.5 * self.step


def _longest_step(scene: Resolved) -> float:
    """The first time step of a refinement (s); with ``vessel.coupling``, a whole fraction of its interval."""
    step = period(scene) / STEPS_A_PERIOD
    coupling = scene.vessel and scene.vessel.coupling
    return coupling.interval / steps_in(coupling.interval, step) if coupling else step
