"""A platform and its riser solved alternately over intervals (turns), instead of as one system.

In each turn, the platform first moves alone, under a given force of the riser. Then the riser is solved, with
its top at the position of the platform at each step. In the staggered scheme, the force is the riser's force
at the start of the turn. In the iterated scheme, the turn is repeated with the force that the riser had at
each step, until the motion of the platform no longer changes.

The riser's side is the whole model, platform included, with the top held at the received position. The
reaction of this support is the difference between the given force and the riser's true force. Its work is
therefore the energy that the exchange adds, and the balance of energy includes it.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from riserstudy.effects.exchange import ForceTable, MotionTable
from riserstudy.errors import SimulationError
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.model.vessel import floating, loose_nodes, unknowns
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.vessel import Coupling
from riserstudy.simulation.time_stepping import steps_in
from riserstudy.solve.evaluate import forces_and_tangent, move_to
from riserstudy.solve.implicit import Method, march
from riserstudy.solve.program import Packed
from riserstudy.solve.record import Record, new_record
from riserstudy.solve.state import State
from riserstudy.solve.sums import DONE, HALVED, ITERATIONS, Sums, new_sums

MOST_ROUNDS = 50  # largest number of iterations of a turn


class Sides(NamedTuple):
    """The two models, and the tables that they exchange."""

    platform: Model
    force: ForceTable
    riser: Model
    motion: MotionTable
    reaction: list[int]  # probes of the riser's model with its force on the platform, by direction


def sides_of(scene: Resolved, model: Model, steps: int) -> Sides:
    """The two sides of a scene whose model is at rest, for turns of ``steps`` time steps."""
    s, top = model.s, len(model.s.l0)
    d, m = len(s.dim), len(s.dof) - len(s.dim)
    names: list[str] = []

    def probe(*new: str) -> int:
        names.extend(new)
        return len(names) - len(new)

    effects = list(floating(scene, d, 1, probe))
    free = unknowns(scene, d, 1)
    count = sum(node == 1 for node, _ in free)
    times = np.arange(steps + 1, dtype=np.float64)
    force = ForceTable(1, times.copy(), np.zeros((steps + 1, count)), probe(*"va" * count))
    effects.append(Effect("exchange", force, "vessel.coupling"))
    loose = loose_nodes(scene, d)
    held = [(i, u) for i in range(2 + loose) for u in range(m + d) if (i, u - m) not in free]
    # a metre of string without mass or stiffness, whose upper node is the platform
    platform = Model(Unknowns(np.ones(1), d, m, probes=names, loose=loose), effects, held)
    platform.s.r[:, :2] = s.r[:, [top]]
    platform.s.r[-1, 0] -= 1.0

    motion = MotionTable(top, times.copy(), np.zeros((3, steps + 1, count)))
    motion.path[0] = s.r[:count, top]
    riser = model.extended(
        [Effect("exchange", motion, "vessel.coupling")], [(top, m + c) for c in range(count)]
    )
    reaction = [model.probes[f"riser_reaction_{axis}"] for axis in "xy"[:count]]
    return Sides(platform, force, riser, motion, reaction)


def march_in_turns(
    sides: Sides, coupling: Coupling, method: Method, duration: float, record: Packed, sums: Sums
) -> tuple[int, dict[str, Any]]:
    """March both sides from the state of the riser's side; outputs go to ``record``, work to ``sums``.

    Raises SimulationError when the iterations of a turn do not converge.

    Parameters
    ----------
    method : method for one turn; the last turn may be shorter.
    duration : duration of all turns together (s).

    Returns
    -------
    The result of `march`, and facts about the exchange.
    """
    riser = sides.riser
    forces_and_tangent(riser.programs, riser.state)
    count = steps_in(duration, coupling.interval)
    times = np.append(coupling.interval * np.arange(count), duration)
    sides.force.load[:] = _reaction(sides)
    most, rounds = 0, 0
    for begin, end in pairwise(times):
        for table in (sides.force, sides.motion):
            table.time[:] = np.linspace(begin, end, method.steps + 1)
        one = method._replace(step=(end - begin) / method.steps)
        outcome, needed = _turn(sides, coupling, one, record, sums)
        if outcome != DONE:
            break
        sides.force.load[:] = _reaction(sides)
        most, rounds = max(most, needed), rounds + needed
    about = {
        "scheme": coupling.scheme,
        "interval": coupling.interval,
        "turns": count,
        "rounds": rounds,
        "most_rounds": most,
    }
    return outcome, about


def _turn(sides: Sides, coupling: Coupling, method: Method, record: Packed, sums: Sums) -> tuple[int, int]:
    """One turn; returns its result and its number of iterations."""
    platform, riser = sides.platform, sides.riser
    starts = [(side, _kept(side.s)) for side in (platform, riser)]
    tolerance = coupling.tolerance or method.tolerance.position
    alone = new_sums()._replace(stop=sums.stop)  # sums of the platform's side
    aside = new_sums()._replace(stop=sums.stop)  # sums of iterations that are repeated
    for rounds in range(1, MOST_ROUNDS + 1):
        for side, start in starts:
            _restore(side.s, start)
        outcome, seen = _step_by_step(platform, method, sides.force.time, alone)
        if outcome != DONE:
            time, _, size = alone.failure
            sums.failure[:] = time, sides.motion.node, size
            return outcome, rounds
        moved = _notify(sides, seen)
        move_to(riser.programs, riser.state, float(sides.motion.time[0]))
        if coupling.scheme == "staggered" or (rounds > 1 and moved <= tolerance):
            for kind in (ITERATIONS, HALVED):
                sums.count[kind] += aside.count[kind]
            outcome = march(riser.programs, riser.state, riser.spare, method, riser.fixed, record, sums)
            return int(outcome), rounds
        outcome, seen = _step_by_step(riser, method, sides.motion.time, aside)
        if outcome != DONE:
            sums.failure[:] = aside.failure
            return outcome, rounds
        sides.force.load[:] = seen.probe[:, sides.reaction]
    raise SimulationError(
        f"vessel.coupling: the iteration between riser and vessel did not converge in the interval from "
        f"{sides.motion.time[0]:.6g} s, where the last of {MOST_ROUNDS} iterations changed the motion by "
        f"{moved:.3g} m; give a shorter interval or a larger tolerance, or remove coupling"
    )


def _step_by_step(side: Model, method: Method, times: FloatArray, sums: Sums) -> tuple[int, Record]:
    """March one side; returns the result, and the record of its start and of each step."""
    seen = new_record(times, [0], side.s)
    outcome = march(side.programs, side.state, side.spare, method, side.fixed, seen, sums)
    return int(outcome), seen.value


def _notify(sides: Sides, seen: Record) -> float:
    """Give the platform's motion to the riser's top; returns the largest change of its position (m)."""
    path, first = sides.motion.path, sides.force.probe
    before = path[0].copy()
    count = path.shape[2]
    path[0] = seen.top[:, :count]
    path[1] = seen.probe[:, first : first + 2 * count : 2]
    path[2] = seen.probe[:, first + 1 : first + 2 * count : 2]
    return float(np.abs(path[0] - before).max())


def _reaction(sides: Sides) -> FloatArray:
    """Force of the riser on the platform at the last evaluation of its model, (c,), N."""
    ends, count = sides.riser.s.ends, sides.motion.path.shape[2]
    return np.asarray(ends[0, 1, :count] + ends[1, 1, :count])


def _moving(s: State) -> list[FloatArray]:
    """The arrays that must be restored before a turn is repeated."""
    return [s.r, s.v, s.a, s.moment, s.clock, s.internal, s.internal_rate]


def _kept(s: State) -> list[FloatArray]:
    return [array.copy() for array in _moving(s)]


def _restore(s: State, kept: list[FloatArray]) -> None:
    for array, old in zip(_moving(s), kept, strict=True):
        array[:] = old
