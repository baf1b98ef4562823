"""Run a scene at the accuracy asked for: refine mesh and step until the estimated error is below it."""

from __future__ import annotations

import math
import time as clock
from typing import Any

from riserstudy.dataset.result import Result
from riserstudy.errors import PhysicallyUnstable, SimulationError, StepFailed, TakesTooLong
from riserstudy.model.mesh import prescribed
from riserstudy.scene.models import Scene
from riserstudy.simulation.equilibrium import rounding
from riserstudy.simulation.error_estimate import MOST_FALL, SURE_FALL, difference, estimate
from riserstudy.simulation.run import EVERYWHERE, keep_stations, single
from riserstudy.simulation.starting_mesh import coarsest_mesh, massless, period
from riserstudy.simulation.time_stepping import steps_in

DISPLACEMENT, MOMENT = 0.002, 0.01  # default accuracy
RUNS = 16  # halvings of mesh or step, at most
FALL = 1.5  # of differences, by which halving must bring them down to be repeated
STALE = 3  # halvings of the other, after which what one of mesh and step was seen to change is seen anew
MATTERS = 0.25  # of what is asked for: an error that is
PATIENT = 6  # refinements that must halve the error, or a string under compression is given up
STEPS_A_PERIOD = 24  # of the coarsest step
SPENT = ("elements", "step", "newton_iterations", "solve_seconds")  # what a run cost


def run(scene: Scene, patience: float = math.inf) -> Result:
    """Simulate a scene.

    With mesh and step in the scene they are used, and runs on half and a quarter of the segments, with
    twice and four times the step, tell the error. Otherwise mesh or step, whichever errs more, is halved
    until the estimated error of displacement, tension and moment is below the accuracy asked for.

    Raises
    ------
    SimulationError
        When no equilibrium is found or a step fails: time, node, effect and remedy.
    PhysicallyUnstable
        When no finer run tells how a string without bending stiffness buckles.
    TakesTooLong
        When the next refinement would take more than is left of ``patience`` (s).
    """
    started = clock.perf_counter()
    result = _refined(scene, patience) if scene.analysis.mesh is None else _as_asked(scene)
    result.facts["wall_seconds"] = clock.perf_counter() - started
    return result


def _as_asked(scene: Scene) -> Result:
    """A run with the scene's own mesh and step; its error from two coarser runs.

    These go first, so that the time of the run itself is not that of loading kernels.
    """
    a = scene.analysis
    elements = a.mesh.elements if a.mesh else 1
    if elements == 1 and not a.step:
        return single(scene, prescribed(scene, elements), a.step)
    runs: list[Result] = []
    for k in (2, 4):
        step = k * a.step if a.step and a.method != "explicit" else a.step
        try:
            runs.insert(
                0, single(scene, prescribed(scene, max(1, elements // k)), step, EVERYWHERE)
            )
        except SimulationError:  # a coarse mesh may buckle, a long step fail
            break
    result = single(scene, prescribed(scene, elements), a.step)
    runs.append(result)
    if len(runs) == 1:
        result.facts["warnings"].append("no error estimate: the coarser run cannot be completed")
        result.facts["error_estimate"] = {}
        return result
    result.facts["error_estimate"] = estimate(
        difference(*runs[-2:]), difference(*runs[:2]) if len(runs) > 2 else None
    )
    return result


def _refined(scene: Scene, patience: float) -> Result:
    """Refine mesh or step, whichever errs more, until both errors together are below what is asked for.

    Every run is compared with the one before, which differs in mesh or in step alone. Where halving one
    did not help, the other is next. A long step damps what a fine mesh would show, and the other way
    round; so an error that was seen long before the end is not believed.
    """
    a = scene.analysis
    target = {"displacement": a.accuracy or DISPLACEMENT, "moment": a.accuracy or MOMENT}
    target["tension"] = target["moment"]
    mesh = coarsest_mesh(scene)
    step = _longest_step(scene) if a.duration else None
    ways = [] if massless(scene) else ["mesh"]
    ways += ["step"] if step else []
    if not ways:  # a massless spring at rest is exact
        return single(scene, mesh, step)
    seen: dict[str, Halved] = {}
    way, astray, helps = ways[0], 0, True
    refinements: list[dict[str, Any]] = []
    excess: list[float] = []  # of the estimates, once there is one of mesh and step
    result: Result | None = None
    for left in range(RUNS, -1, -1):
        try:
            finer = single(scene, mesh, step, EVERYWHERE)
        except StepFailed:
            if left == 0 or step is None:
                raise
            step, result = 0.5 * step, None
            continue
        except PhysicallyUnstable:
            raise
        except SimulationError:  # no equilibrium found on this mesh
            astray += 1
            if astray > 2 or "mesh" not in ways:
                raise
            mesh, result = mesh.halved(), None
            continue
        refinements.append({name: finer.facts.get(name) for name in SPENT})
        if result is not None:
            now = Halved(difference(result, finer), seen.get(way))
            helps = way not in seen or (
                _excess(seen[way].change, target) > FALL * _excess(now.change, target)
            )
            for one in seen.values():
                one.since += 1
            seen[way] = now
        result = finer
        total = {name: sum(one.error.get(name, 0.0) for one in seen.values()) for name in target}
        told = seen[way].change if way in seen else {}
        finer.facts["error_estimate"] = {k: v for k, v in total.items() if k in told}
        unknown = [w for w in ways if w not in seen]
        if not unknown:
            excess.append(_excess(total, target))
            _give_up_buckling(scene, finer, excess)
        if not unknown and all(total[name] <= limit for name, limit in target.items()):
            old = [w for w in ways if seen[w].since >= STALE]
            stale = [w for w in old if _excess(seen[w].error, target) > MATTERS]
            if not stale:
                break
            way = stale[0]
        elif unknown:
            way = unknown[0]
        elif len(ways) > 1 and not helps:  # an error that stays, as of a jolt, may be the other's
            way = ways[1 - ways.index(way)]
        else:
            way = max(ways, key=lambda w: _excess(seen[w].error, target))
        if _spent(refinements) + 2.0 * finer.facts["solve_seconds"] > patience:
            by_then = f"{_worst(total)} estimated" if seen else "nothing estimated"
            raise TakesTooLong(f"takes longer than {patience:g} s; {by_then} by then")
        mesh = mesh.halved() if way == "mesh" else mesh
        step = 0.5 * step if step and way == "step" else step
    else:
        finer.facts["warnings"].append(
            f"accuracy not reached after {RUNS} refinements: {_worst(total)} estimated"
        )
    finer.facts["solve_seconds"] = _spent(refinements)
    finer.facts["refinements"] = refinements
    keep_stations(finer, a.output.stations if a.output else None)
    return finer


def _give_up_buckling(scene: Scene, finer: Result, excess: list[float]) -> None:
    """A string without bending stiffness buckles at any wavelength: each finer mesh finds a shorter one."""
    earlier = excess[:-PATIENT]
    if not earlier or min(excess) <= 0.5 * min(earlier) or "bending_moment" in finer.arrays:
        return
    facts = finer.facts
    if facts["directions"] > 1 and facts["smallest_tension"] < -rounding(scene):
        raise PhysicallyUnstable(
            f"effective tension falls to {facts['smallest_tension']:.3g} N at s = "
            f"{facts['smallest_tension_s']:.4g} m, and without bending stiffness the riser buckles there at "
            f"any wavelength: {len(excess)} finer runs did not settle its peaks; give every section "
            "bending stiffness, or analysis.mesh and step"
        )


class Halved:
    """What halving mesh or step was seen to change, and the error that it left."""

    def __init__(self, change: dict[str, float], before: Halved | None) -> None:
        self.change = change
        # changes beside another mesh or step are alike, but not to the third order
        most = SURE_FALL if before and before.since else MOST_FALL
        self.error = estimate(change, before.change if before else None, most)
        self.since: int = 0  # halvings of the other


def _longest_step(scene: Scene) -> float:
    """The step that a refinement starts from (s): in turns of platform and riser, a whole part of one."""
    step = period(scene) / STEPS_A_PERIOD
    coupling = scene.vessel and scene.vessel.coupling
    return coupling.interval / steps_in(coupling.interval, step) if coupling else step


def _spent(refinements: list[dict[str, Any]]) -> float:
    return float(sum(one["solve_seconds"] for one in refinements))


def _worst(error: dict[str, float]) -> str:
    return ", ".join(f"{name} {100 * value:.2g} %" for name, value in error.items())


def _excess(error: dict[str, float], target: dict[str, float]) -> float:
    return max(error.get(name, 0.0) / limit for name, limit in target.items())
