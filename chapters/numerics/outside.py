"""Integrators from outside the engine, with the engine's forces: an independent check of its time stepping.

Both integrators need explicit accelerations and therefore use lumped masses; their mesh error equals the
mesh error of the explicit method. Semi-implicit Euler and the engine's leapfrog have an identical recursion
of positions; they differ in the velocity that belongs to a position, and in the first half step.
"""

from __future__ import annotations

import math
import time as clock
from typing import Any, NamedTuple

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.integrate import Radau

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError, StepFailed, TakesTooLong
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.outputs import quantities
from riserstudy.simulation.run import EXPLICIT_BOUND, single
from riserstudy.solve.envelopes import widen
from riserstudy.solve.evaluate import move
from riserstudy.solve.explicit import accelerate
from riserstudy.solve.jit import kernel
from riserstudy.solve.program import Packed
from riserstudy.solve.record import new_record
from riserstudy.solve.write_down import evaluate_and_note, remember

BoolArray = NDArray[np.bool_]
PATIENCE = 1.0  # CPU seconds of a Radau run: a busy machine refuses as many runs as an idle one
FASTEST = 10.0  # m/s; times the relative tolerance: absolute tolerance of speeds
RADAU = "Radau"
REACH = 4  # nodes: a bending moment acts on two on either side, ends may involve more


@kernel
def accelerations(p: Any, s: Any, time: float, fixed: Any) -> None:
    """Compute the accelerations of a state at a time (s); held nodes follow their supports."""
    move(p, s, time)
    accelerate(p, s, fixed)


@kernel
def note_output(p: Any, s: Any, fixed: Any, record: Any) -> None:
    """Write the next output from the current positions and velocities."""
    move(p, s, record.time[record.written[0]])
    accelerate(p, s, fixed)
    record.when[2] = record.time[record.written[0]]
    evaluate_and_note(p, s, record)
    widen(record, 0)
    remember(record)


@kernel
def march_euler(p: Any, s: Any, h: float, count: int, fixed: Any, bound: float) -> bool:
    """Make ``count`` steps of ``h`` (s); return whether the sum of squared speeds stayed below the bound."""
    start = s.clock[0]
    for step in range(count):
        move(p, s, start + step * h)
        accelerate(p, s, fixed)
        square = 0.0
        for c in range(s.r.shape[0]):
            for i in range(s.r.shape[1]):
                s.v[c, i] += h * s.a[c, i]
                s.r[c, i] += h * s.v[c, i]
                square += s.v[c, i] * s.v[c, i]
        if not square < bound:
            return False
    move(p, s, start + count * h)
    return True


def outside(scene: Resolved, mesh: Mesh, integrator: str, step: float) -> Result:
    """Make one run with a time step (s); for Radau, ``step`` is the relative tolerance instead.

    The scene's method must be explicit: this method has lumped masses, without coupling between nodes.

    Raises
    ------
    SimulationError
        When the run diverges or takes too long.
    """
    started = clock.perf_counter()
    a = scene.analysis
    if a.output is None or a.duration is None:
        raise SimulationError("a static scene has no time steps")
    still = single(scene, mesh, None)
    model, _ = settle(scene, mesh)
    model.s.rate[:] = 0.0, 1.0
    start = a.output.start or 0.0
    count = math.floor((a.duration - start) / a.output.interval * (1.0 + 1e-12) + 1e-9) + 1
    times = start + a.output.interval * np.arange(count)
    notes = new_record(times, list(range(len(mesh.s))), model.s)
    march = by_radau if integrator == RADAU else by_euler
    steps, evaluations = march(model, notes, step)
    record = notes.value
    arrays = still.arrays | {"time": record.time, "s": mesh.s}
    for k, name in enumerate(quantities(model)):
        arrays[name] = record.history[:, k, :]
        arrays[name + "_max"], arrays[name + "_min"] = record.largest[k], record.smallest[k]
    facts = still.facts | {"steps": steps, "step": times[-1] / steps}
    facts |= {"newton_iterations": evaluations, "solve_seconds": clock.perf_counter() - started}
    return Result(arrays, facts)


class Count(NamedTuple):
    """Numbers of steps and force evaluations of a run."""

    steps: int
    evaluations: int


def by_euler(model: Model, record: Packed, longest: float) -> Count:
    """Integrate by semi-implicit Euler; steps of at most ``longest`` (s) end at the output times.

    Raises
    ------
    StepFailed
        When velocities grow without bound.
    """
    done, now = 0, 0.0
    move_state(model)
    for time in record.value.time:
        count = math.ceil((time - now) / longest * (1.0 - 1e-9))
        h = (time - now) / max(1, count)
        if (
            not march_euler(model.programs, model.state, h, count, model.fixed, EXPLICIT_BOUND)
            or not np.isfinite(model.s.v).all()
        ):
            raise StepFailed(f"velocities grow without bound before t = {time:.4g} s")
        done, now = done + count, time
        note_output(model.programs, model.state, model.fixed, record)
    return Count(done, done)


def by_radau(model: Model, record: Packed, tolerance: float) -> Count:
    """Integrate by SciPy's Radau IIA of order 5, which chooses its steps, with a sparse difference Jacobian.

    Raises
    ------
    StepFailed
        When the solver fails.
    TakesTooLong
        When the run takes more CPU time than allowed.
    """
    s, times = model.s, record.value.time
    free = np.ones(s.r.shape, bool)
    moments = len(s.dof) - len(s.dim)
    for node, unknown in model.fixed:
        if unknown >= moments:
            free[unknown - moments, node] = False
    half = int(free.sum())

    def put(y: FloatArray) -> None:
        s.r[free], s.v[free] = y[:half], y[half:]

    evaluations = 0

    def rate(time: float, y: FloatArray) -> FloatArray:
        nonlocal evaluations  # SciPy's count excludes the evaluations for the Jacobian
        evaluations += 1
        put(y)
        accelerations(model.programs, model.state, time, model.fixed)
        return np.concatenate([y[half:], s.a[free]])

    move_state(model)
    length = float(s.l0.sum())
    absolute = tolerance * np.repeat([1e-3 * length, FASTEST], half)
    y0 = np.concatenate([s.r[free], s.v[free]])
    # positions count from the initial ones: their absolute size is no measure of displacements
    solver = Radau(
        lambda t, y: rate(t, y + y0), 0.0, 0.0 * y0, float(times[-1]),
        rtol=tolerance, atol=absolute, first_step=1e-3, jac_sparsity=neighbours(free),
    )  # fmt: skip
    started, steps, k = clock.thread_time(), 0, 0
    while k < len(times):
        if solver.status == "running" and (k == 0 or times[k] > solver.t):
            _step(solver)
            steps += 1
            if clock.thread_time() - started > PATIENCE:
                raise TakesTooLong(f"more than {PATIENCE:g} s, at t = {solver.t:.3g} s after {steps} steps")
            inside = solver.dense_output()
        while k < len(times) and times[k] <= solver.t + 1e-9:
            put(y0 + inside(times[k]))
            note_output(model.programs, model.state, model.fixed, record)
            k += 1
    return Count(steps, evaluations)


def _step(solver: Radau) -> None:
    """Make one step of a solver; it fails if forces are not finite or a matrix is singular."""
    try:
        failure = solver.step()
    except (ValueError, RuntimeError) as error:
        failure = str(error)
    if failure:
        raise StepFailed(f"Radau, at t = {solver.t:.3g} s: {failure}")


def neighbours(free: BoolArray) -> sp.csc_array:
    """Sparsity of the Jacobian of the rates by the unknowns: positions, then velocities.

    A missing dependence would cost iterations, not accuracy, because the rates contain all dependences.

    Parameters
    ----------
    free : (m, n), true for each component and node that is free to move.

    Returns
    -------
    sparse array : (2 f, 2 f), with f the number of free components
    """
    node = np.nonzero(free)[1]
    near = sp.csc_array(np.abs(node[:, None] - node) <= REACH)
    return sp.block_array([[None, sp.eye_array(len(node))], [near, near]], format="csc")


def move_state(model: Model) -> None:
    """Move held nodes to their positions at the beginning, and compute the accelerations."""
    accelerations(model.programs, model.state, 0.0, model.fixed)
