"""Cost of each effect of a scene: the time of one of its calls, times the number of calls in a run.

A program is a list of calls; an effect that is absent has no entry in it. A program that repeats the entries
of one effect many times measures the time of this effect alone.
"""

from __future__ import annotations

import time as clock
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.result import Result
from riserstudy.effects.registry import ROLES
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.run import single
from riserstudy.solve.evaluate import one_call, shape_of
from riserstudy.solve.program import assemble

REPEATED = 200  # calls in a timed program
TIMES = 5  # repeats of a program, of which the shortest counts
RUNS = 3  # repeats of a run, of which the shortest counts
FORCES = ("drive", "internal", "law", "turn", "string", "device")
#: roles that a run calls only when it begins and ends
SELDOM = ("compliance", "potential")
#: count by which a run calls each role: per force evaluation, tangent, step or output
PER = dict.fromkeys(FORCES, "evaluations") | {
    "string_inertia": "inertias",
    "device_inertia": "inertias",
    "tangent": "iterations",
    "mass": "masses",
    "lump": "lumps",
    "motion": "moves",
    "place": "moves",
    "power": "steps",
    "kinetic": "steps",
    "probe": "outputs",
}
REST = "solver and bookkeeping"


class Cost(NamedTuple):
    """One effect: number of calls in a run, and its share of the run's time."""

    name: str
    calls: int
    share: float


def costs(scene: Resolved, mesh: Mesh, step: float | None) -> list[Cost]:
    """Return the share (1) of run time by effect; the rest, which comes last, is the solver's time."""
    best, counts = _timed(scene, mesh, step)
    model, _ = settle(scene, mesh)
    h = step or 1.0
    model.s.rate[:] = (2.0 / h, 4.0 / h**2) if step else (0.0, 0.0)
    seconds: dict[str, float] = {}
    calls: dict[str, int] = {}
    for effect, record in zip(model.effects, model.records, strict=True):
        for role, function in ROLES[type(effect.record)].items():
            many = 0 if role in SELDOM else counts.get(PER[role], 0)
            if not many:
                continue
            program = np.tile(assemble([(function, record)], model.state), (REPEATED, 1))
            seconds[effect.name] = seconds.get(effect.name, 0.0) + many * _time_of(model, program)
            calls[effect.name] = calls.get(effect.name, 0) + many
    rows = [Cost(name, calls[name], spent / best) for name, spent in seconds.items()]
    return [*rows, Cost(REST, 0, max(0.0, 1.0 - sum(cost.share for cost in rows)))]


def _timed(scene: Resolved, mesh: Mesh, step: float | None) -> tuple[float, dict[str, int]]:
    """Return the shortest time of a run (s), and its numbers of evaluations by kind."""
    runs = [_ran(scene, mesh, step) for _ in range(RUNS)]
    results, seconds = zip(*runs, strict=True)
    facts, best = results[-1].facts, min(seconds)
    iterations, steps = facts.get("newton_iterations", 0), facts.get("steps", 0)
    if not steps:  # nothing accelerates
        return best, dict.fromkeys(("evaluations", "iterations"), facts["statics_iterations"])
    outputs = len(results[-1].arrays["time"])
    often = {"evaluations": iterations + steps + outputs, "moves": steps + outputs}
    often |= {"inertias": often["evaluations"], "steps": steps, "outputs": outputs}
    if not iterations:  # explicit integration lumps the masses at every step
        return best, often | {"lumps": steps}
    return best, often | {"iterations": iterations, "masses": iterations}


def _ran(scene: Resolved, mesh: Mesh, step: float | None) -> tuple[Result, float]:
    """Return a run, and the time (s) that the processor spent on its solution.

    Other work of the machine makes its elapsed time longer, but not the shortest of many short calls.
    """
    began, used = clock.perf_counter(), clock.process_time()
    result = single(scene, mesh, step)
    busy = (clock.process_time() - used) / (clock.perf_counter() - began)
    return result, float(result.facts["solve_seconds"]) * min(busy, 1.0)


def _time_of(model: Model, program: NDArray[np.int64]) -> float:
    """Return the shortest time of one entry of a program (s); the state is restored afterwards."""
    state = model.s
    kept = [state.r.copy(), state.v.copy(), state.a.copy(), state.platform.copy()]
    shape_of(model.programs, model.state)
    shortest = np.inf
    for _ in range(TIMES):
        started = clock.perf_counter()
        one_call(program, model.state)
        shortest = min(shortest, clock.perf_counter() - started)
    for array, values in zip((state.r, state.v, state.a, state.platform), kept, strict=True):
        array[:] = values
    return shortest / len(program)


class Freedom(NamedTuple):
    """Unknowns of the solution, and their reasons."""

    unknowns: int
    directions: str  # of motion, with the reason for them
    by_node: str

    @property
    def because(self) -> str:
        """All reasons for the number of unknowns."""
        return f"{self.directions}: {self.by_node}"


def freedom(scene: Resolved, model: Model) -> Freedom:
    """Return the number of a model's degrees of freedom, their directions, and the reasons for them."""
    d, m, n = len(model.s.dim), len(model.s.dof) - len(model.s.dim), len(model.s.l0)
    directions = {1: "along the riser only", 2: "in the plane of x and z", 3: "in space"}[d]
    reason = scene.spatial if d == 3 else scene.lateral if d == 2 else "no lateral load or motion"
    held = len(model.fixed)
    moments = f" and {m} moment{'s' if m > 1 else ''}" if m else ""
    return Freedom(
        (d + m) * (n + 1) - held,
        f"{directions} ({reason})",
        f"{d} position{'s' if d > 1 else ''}{moments} at each of {n + 1} nodes, less {held} that are held",
    )
