"""Run a scene at a tolerance: refine mesh and time step until the estimated error is below it.

docs/choosing_accuracy.md shows one refinement as a table, with one row per run.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

from riserstudy.dataset.result import Result
from riserstudy.errors import PhysicallyUnstable, SimulationError, StepFailed, TakesTooLong
from riserstudy.model.mesh import Mesh
from riserstudy.records.numerals import percent
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.halved import Halved, enter, error_of
from riserstudy.simulation.outputs import keep_stations
from riserstudy.simulation.prescribed_run import refuse_unseen_periods, run_prescribed
from riserstudy.simulation.refinement_warnings import missed_accuracy, slow_convergence, sparse_outputs
from riserstudy.simulation.rest import Rest
from riserstudy.simulation.rival_modes import warn_of_rivals
from riserstudy.simulation.run import finish, march, single
from riserstudy.simulation.run_cost import cost, duration, total_seconds
from riserstudy.simulation.sampling_error import floor, of_two_runs
from riserstudy.simulation.starting_mesh import coarsest_mesh, massless, period
from riserstudy.simulation.thinning import thinned
from riserstudy.simulation.time_limit import Notify, Watch, size
from riserstudy.simulation.time_stepping import steps_in
from riserstudy.simulation.tolerance import add_error_of_outputs, allowed_of, check_error, raise_if_buckling

RUNS = 16  # largest number of halvings of mesh or step
SEGMENTS = 50_000  # largest number of segments
FALL = 1.5  # smallest decrease of differences by a halving for the same halving to be repeated
STALE = 2  # halvings after which an error is estimated again
# predicted error, as a multiple of the tolerance, from which on the next run is not the last
LIKELY = 1.5
MATTERS = 0.25  # error, as a share of the tolerance, from which on it is estimated again
STEPS_A_PERIOD = 24  # number of the coarsest time steps in a period


def run(
    scene: Resolved, patience: float = math.inf, estimated: bool = True, notify: Notify | None = None
) -> Result:
    """Simulate a scene.

    If the scene has a mesh and a time step, they are used, and four coarser runs, with step and mesh doubled
    one at a time, give the estimated error. Otherwise, the one of mesh and step with the larger error is
    halved until the estimated error of displacement, tension and moment is below the tolerance. Raises
    SimulationError when no equilibrium is found or a step fails: time, node, effect and remedy. Raises
    PhysicallyUnstable when a string without bending stiffness buckles, for which finer runs do not converge.
    Raises TakesTooLong when the time limit ends before the first run, or before the run on a prescribed mesh.

    Parameters
    ----------
    patience : time limit (s), after which the finest completed run is the result; its fact ``ended_by`` and a
        warning state this. A run that would not end in time is not begun; a run that exceeds it is
        interrupted.
    estimated : whether the error of a run with mesh and step in the scene is estimated, which doubles the
        time.
    notify : function that receives the name of the present run, and the share of it that is done.
    """
    from riserstudy.simulation.long_record import refinement_of  # which is built on this file

    refuse_unseen_periods(scene)
    watch = Watch(patience, notify)
    result = (
        refinement_of(scene, watch).result()
        if scene.analysis.mesh is None
        else run_prescribed(scene, estimated, watch)
    )
    result.facts["wall_seconds"] = watch.spent
    if scene.fatigue:
        add_error_of_outputs(result)
    check_error(result, scene)
    warn_of_rivals(scene, result.facts)
    return result


def _exact(result: Result) -> Result:
    """A run without a coarser run for comparison, since its result is exact."""
    result.facts["error_estimate"] = {}
    return result


class Refinement:
    """Halve the one of mesh and step with the larger error, until both errors together meet the tolerance.

    Every run is compared with the previous run, which differs only in mesh or only in step. If halving one
    did not reduce the differences, the other is halved next. A long step damps motions that only a fine mesh
    represents, and a coarse mesh omits motions that only a short step represents. An error that was estimated
    long before the end is therefore estimated again, by runs that are coarser in the one quantity alone.
    """

    def __init__(self, scene: Resolved, watch: Watch | None = None) -> None:
        a = scene.analysis
        self.scene, self.watch = scene, watch or Watch()
        self.target = allowed_of(scene)
        self.meshes = [coarsest_mesh(scene)]  # each with the segments of the previous mesh halved
        self.step = _longest_step(scene) if a.duration else None
        self.ways = [] if massless(scene) else ["mesh"]
        self.ways += ["step"] if self.step else []
        self.way = self.ways[0] if self.ways else ""  # mesh or step, whichever was halved last
        self.seen: dict[str, Halved] = {}  # by way
        self.helps = True  # whether this halving reduced the differences
        self.lost = 0  # meshes without equilibrium
        self.last: Result | None = None  # run to compare the next run with
        self.finest: Result | None = None  # finest completed run
        self.finest_mesh = self.mesh
        self.rest: Rest | None = None  # scene at rest on the last mesh
        self.thin = False  # whether the run has fewer outputs than requested
        self.spent: list[dict[str, Any]] = []  # cost of each run
        # ratios of error to tolerance, from the first complete estimate on
        self.excess: list[float] = []

    def result(self) -> Result:
        """The finest run, with its estimated error.

        Raises SimulationError as `run` does: no equilibrium, a failed step, buckling that no mesh resolves,
        no time left.
        """
        if not self.ways:  # a massless spring at rest
            return _exact(single(self.scene, self.mesh, self.step))
        try:
            reached = self._refine()
        except TakesTooLong as late:
            if self.finest is None:
                raise TakesTooLong(f"no run within {self.watch.patience:g} s: {late}") from None
            reached = False
            self._out_of_patience(self.finest)
        finest = self.finest
        if finest is None:
            raise TypeError("no run and no error")  # cannot occur
        finish(self.scene, self.finest_mesh, finest)
        self.spent[-1] = cost(finest)
        if not reached:
            finest.facts["warnings"].append(self._not_reached(finest))
        finest.facts["warnings"] += slow_convergence(self.scene, self.seen.get("step"))
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
                if stale := self._stale:
                    self._reestimate(finer, stale)
                way = self._next_way()
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
        if self.spent and not self._unknown:
            error = self.error
            worst = max(self.target, key=lambda name: error[name] / self.target[name])
            off = f"error of {worst} {percent(error[worst])}, tolerance {percent(self.target[worst])}"
            on += f"; {off}, about {duration(self._left())} to go"
        self.watch.begin(on)

    def _left(self) -> float:
        """Estimated time left (s), if each halving reduces its error to a quarter and doubles the time."""
        excess = {way: self._excess(one.error) for way, one in self.seen.items()}
        one, total = self.spent[-1]["solve_seconds"], 0.0
        for _ in range(RUNS):
            one *= 2.0
            total += one
            worst = max(excess, key=lambda way: excess[way])
            excess[worst] *= 0.25
            if sum(excess.values()) <= 1.0:
                break
        return float(total)

    def _not_reached(self, finest: Result) -> str:
        """The warning that the tolerance is not met."""
        return missed_accuracy(finest.facts, len(self.spent))

    @property
    def mesh(self) -> Mesh:
        """The present mesh."""
        return self.meshes[-1]

    @property
    def error(self) -> dict[str, float]:
        """Estimated relative error of mesh and step together, by quantity."""
        facts = self.finest.facts if self.finest else {}
        chance = of_two_runs(facts.get("sampling_error", {}))
        return dict.fromkeys(self.target, 0.0) | error_of(self.seen.values(), chance)

    def _attempt(self, left: int, whole: bool = False) -> Result | None:
        """A run on the present mesh and step; None if it failed, after which mesh or step is finer.

        ``whole``: with all outputs. Otherwise with the outputs for a comparison, unless this may be the last
        run.
        """
        scene, self.thin = self.scene, False
        if not (whole or self._may_suffice):
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
            if left == 0 or self.lost > 2 or "mesh" not in self.ways:
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
        if self.last is not None:
            before = self.seen.get(self.way)
            chance = floor(finer.facts.get("sampling_error", {}))
            now = enter(self.seen, self.way, difference(self.last, finer), chance)
            self.helps = before is None or (self._excess(before.change) > FALL * self._excess(now.change))
        self.last = self.finest = finer
        self.finest_mesh = self.mesh
        known = self.seen[self.way].change if self.way in self.seen and not self._unknown else {}
        finer.facts["error_estimate"] = {k: v for k, v in self.error.items() if k in known}
        if not self._unknown:
            self.excess.append(self._excess(self.error))
            raise_if_buckling(self.scene, finer, self.excess)

    @property
    def _unknown(self) -> list[str]:
        return [way for way in self.ways if way not in self.seen]

    @property
    def _may_suffice(self) -> bool:
        """Whether the next run may be the last, if errors continue to decrease as before."""
        if set(self._unknown) - {self.way}:
            return False
        fall = {way: one.fall if way == self.way else 1.0 for way, one in self.seen.items()}
        left = {
            name: sum(one.error.get(name, 0.0) / fall[way] for way, one in self.seen.items())
            for name in self.target
        }
        return self._excess(left) <= LIKELY

    def _next_way(self) -> str | None:
        """The next one of mesh and step to halve; None if the tolerance is met."""
        if self._unknown:
            return self._unknown[0]
        if self._excess(self.error) <= 1.0:
            return self._stale
        if len(self.ways) > 1 and not self.helps:  # a constant error may be due to the other
            return self.ways[1 - self.ways.index(self.way)]
        return max(self.ways, key=lambda way: self._excess(self.seen[way].error))

    @property
    def _stale(self) -> str | None:
        """The one of mesh and step with a significant error that was estimated long before the final run."""
        if self._unknown or self._excess(self.error) > 1.0:
            return None
        old = [way for way in self.ways if self.seen[way].since >= STALE]
        return next((w for w in old if self._excess(self.seen[w].error) > MATTERS), None)

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
        if changes:
            before = Halved(changes[1], None) if len(changes) > 1 else None
            self.seen[way] = Halved(changes[0], before)
        finer.facts["error_estimate"] = {
            k: v for k, v in self.error.items() if k in finer.facts["error_estimate"]
        }

    def _check_patience(self) -> None:
        """Refuse a next run that would exceed the time limit: it takes twice the time of the last run."""
        if self.watch.spent + 2.0 * self.spent[-1]["solve_seconds"] > self.watch.patience:
            raise TakesTooLong("the next run would take too long")

    def _too_fine(self, way: str) -> bool:
        return way == "mesh" and 2 * len(self.mesh.l0) > SEGMENTS

    def _halve(self, way: str) -> None:
        self.way = way
        if way == "mesh":
            self.meshes.append(self.mesh.halved())
        elif self.step:
            self.step = 0.5 * self.step

    def _excess(self, error: dict[str, float]) -> float:
        """The largest ratio of error to tolerance."""
        return max(error.get(name, 0.0) / limit for name, limit in self.target.items())


def _longest_step(scene: Resolved) -> float:
    """The first time step of a refinement (s); with ``vessel.coupling``, a whole fraction of its interval."""
    step = period(scene) / STEPS_A_PERIOD
    coupling = scene.vessel and scene.vessel.coupling
    return coupling.interval / steps_in(coupling.interval, step) if coupling else step
