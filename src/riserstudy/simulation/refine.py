"""Run a scene at the accuracy asked for: refine mesh and step until the estimated error is below it.

docs/choosing_accuracy.md shows one refinement as a table, a row a run.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

from riserstudy.dataset.result import Result
from riserstudy.errors import PhysicallyUnstable, SimulationError, StepFailed, TakesTooLong
from riserstudy.model.mesh import Mesh
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.halved import Halved, enter, error_of
from riserstudy.simulation.outputs import keep_stations
from riserstudy.simulation.prescribed_run import run_prescribed
from riserstudy.simulation.refinement_warnings import (
    missed_accuracy,
    slow_convergence,
    sparse_outputs,
)
from riserstudy.simulation.rest import Rest
from riserstudy.simulation.rival_modes import warn_of_rivals
from riserstudy.simulation.run import finish, march, single
from riserstudy.simulation.run_cost import cost, duration, total_seconds
from riserstudy.simulation.sampling_error import floor, of_two_runs
from riserstudy.simulation.starting_mesh import coarsest_mesh, massless, period
from riserstudy.simulation.thinning import thinned
from riserstudy.simulation.time_limit import Notify, Watch, size
from riserstudy.simulation.time_stepping import steps_in
from riserstudy.simulation.tolerance import (
    add_error_of_outputs,
    allowed_of,
    check_error,
    raise_if_buckling,
)

RUNS = 16  # halvings of mesh or step, at most
SEGMENTS = 50_000  # of the finest mesh, at most
FALL = 1.5  # of differences, by which halving must bring them down to be repeated
STALE = 2  # halvings of the other, after which what one of mesh and step was seen to change is seen anew
LIKELY = 1.5  # of what is asked for: an error foreseen that may turn out to be within it
MATTERS = 0.25  # of what is asked for: an error that is
STEPS_A_PERIOD = 24  # of the coarsest step


def run(
    scene: Resolved,
    patience: float = math.inf,
    estimated: bool = True,
    notify: Notify | None = None,
) -> Result:
    """Simulate a scene.

    With mesh and step in the scene they are used, and four coarser runs, step and mesh doubled one at a time,
    tell the error. Otherwise mesh or step, whichever errs more, is halved
    until the estimated error of displacement, tension and moment is below the accuracy asked for.

    Parameters
    ----------
    patience : time (s) after which the finest run so far is the result; its fact ``ended_by`` and a warning
        say so. A run that would not end within it is not begun, one that does not is broken off.
    estimated : whether a run with mesh and step in the scene tells its error, which takes as long again.
    notify : is told what is at work, and what share of it is done.

    Raises
    ------
    SimulationError
        When no equilibrium is found or a step fails: time, node, effect and remedy.
    PhysicallyUnstable
        When no finer run tells how a string without bending stiffness buckles.
    TakesTooLong
        When ``patience`` ends before the first run, or before that on a mesh that the scene asks for.
    """
    from riserstudy.simulation.long_record import refinement_of  # which is built on this file

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
    """A run that nothing coarser can be compared with."""
    result.facts["error_estimate"] = {}
    return result


class Refinement:
    """Halve mesh or step, whichever errs more, until both errors together are below what is asked for.

    Every run is compared with the one before, which differs in mesh or in step alone. Where halving one
    did not help, the other is next. A long step damps what a fine mesh would show, and the other way
    round; so an error that was seen long before the end is looked at again, by runs coarser in it alone.
    """

    def __init__(self, scene: Resolved, watch: Watch | None = None) -> None:
        a = scene.analysis
        self.scene, self.watch = scene, watch or Watch()
        self.target = allowed_of(scene)
        self.meshes = [coarsest_mesh(scene)]  # each the halves of the one before
        self.step = _longest_step(scene) if a.duration else None
        self.ways = [] if massless(scene) else ["mesh"]
        self.ways += ["step"] if self.step else []
        self.way = self.ways[0] if self.ways else ""  # what was halved last
        self.seen: dict[str, Halved] = {}  # by way
        self.helps = True  # whether halving it brought the differences down
        self.lost = 0  # meshes without equilibrium
        self.last: Result | None = None  # to compare the next run with
        self.finest: Result | None = None  # that was completed
        self.finest_mesh = self.mesh
        self.rest: Rest | None = None  # on the last mesh
        self.thin = False  # whether it tells less often than it is asked to
        self.spent: list[dict[str, Any]] = []  # what each run cost
        self.excess: list[float] = []  # of the estimates, once there is one of mesh and step

    def result(self) -> Result:
        """The finest run, with the error estimated for it.

        Raises
        ------
        SimulationError
            As `run` does: no equilibrium, a failed step, buckling that no mesh resolves, no time left.
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
            raise TypeError("no run and no error")  # one of both there is
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
        """Run finer and finer; whether the accuracy was reached.

        Raises
        ------
        TakesTooLong
            When patience ends before that.
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
        """Run once more what turned out to be the last, with all outputs; False where one is undefined."""
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
        """Enter that it ended here, and which outputs are not there."""
        finest.facts["ended_by"] = f"patience of {self.watch.patience:g} s"
        finest.facts["warnings"] += sparse_outputs(self.scene, finest)

    def _begin(self) -> None:
        """Tell what is run next, how far the last was off, and what is left to do."""
        on = f"run {len(self.spent) + 1}: {size(len(self.mesh.l0), self.step)}"
        if self.spent and not self._unknown:
            error = self.error
            worst = max(self.target, key=lambda name: error[name] / self.target[name])
            off = f"error of {worst} {100 * error[worst]:.2g} %, tolerance {100 * self.target[worst]:.2g} %"
            on += f"; {off}, about {duration(self._left())} to go"
        self.watch.begin(on)

    def _left(self) -> float:
        """Time that is left to go where each halving quarters its error and doubles the time (s)."""
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
        """Warn that accuracy was not reached."""
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
        """A run on the present mesh and step; None where it failed, and both are finer now.

        ``whole``: with all outputs. Else those which a comparison needs, unless this may be the last run.
        """
        scene, self.thin = self.scene, False
        if not (whole or self._may_suffice):
            scene, self.thin = thinned(scene, self.step)
        try:
            rest = self._at_rest()
            return march(
                scene, self.mesh, self.step, watch=self.watch, rest=rest, extremes=not self.thin
            )
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
        """The scene at rest on the present mesh; that of the run before where that was on it too."""
        if self.scene.analysis.solver == "hermite":
            return None
        if self.rest is None or not self.rest.again(self.mesh):
            self.rest = Rest(self.scene, self.mesh)
        return self.rest

    def _compare(self, finer: Result) -> None:
        """See what the last halving changed, and tell the run its error."""
        self.spent.append(cost(finer))
        if self.last is not None:
            before = self.seen.get(self.way)
            chance = floor(finer.facts.get("sampling_error", {}))
            now = enter(self.seen, self.way, difference(self.last, finer), chance)
            self.helps = before is None or (
                self._excess(before.change) > FALL * self._excess(now.change)
            )
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
        """Whether the next run may be the last, if errors fall as they did."""
        if set(self._unknown) - {self.way}:
            return False
        fall = {way: one.fall if way == self.way else 1.0 for way, one in self.seen.items()}
        left = {
            name: sum(one.error.get(name, 0.0) / fall[way] for way, one in self.seen.items())
            for name in self.target
        }
        return self._excess(left) <= LIKELY

    def _next_way(self) -> str | None:
        """What to halve next; None where the accuracy is reached."""
        if self._unknown:
            return self._unknown[0]
        if self._excess(self.error) <= 1.0:
            return self._stale
        if len(self.ways) > 1 and not self.helps:  # an error that stays may be the other's
            return self.ways[1 - self.ways.index(self.way)]
        return max(self.ways, key=lambda way: self._excess(self.seen[way].error))

    @property
    def _stale(self) -> str | None:
        """An error that matters to a run that may be believed, and was seen long before it."""
        if self._unknown or self._excess(self.error) > 1.0:
            return None
        old = [way for way in self.ways if self.seen[way].since >= STALE]
        return next((w for w in old if self._excess(self.seen[w].error) > MATTERS), None)

    def _reestimate(self, finer: Result, way: str) -> None:
        """See how changes by a way fall with the other as it is now, by two runs coarser in it alone.

        Where the first fails, the way is halved once more.
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
        """Begin no run that would not end in time: each takes twice as long as the one before."""
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
        """The largest error over what is asked for."""
        return max(error.get(name, 0.0) / limit for name, limit in self.target.items())


def _longest_step(scene: Resolved) -> float:
    """The step that a refinement starts from (s): in turns of platform and riser, a whole part of one."""
    step = period(scene) / STEPS_A_PERIOD
    coupling = scene.vessel and scene.vessel.coupling
    return coupling.interval / steps_in(coupling.interval, step) if coupling else step
