"""References for the error of a run: a stored history of another code, or a stored fine run of riserstudy.

Histories of other codes share neither discretisation nor integrator with the engine (quintic elements with
Radau IIA, the method of characteristics). In scenes without one, the segments and the time step of a run with
the default accuracy were halved at least twice, with the fourth-order method; the change by the last halving
indicates the error of the reference. A run on another mesh is compared at its own nodes, where the
reference is interpolated by the shapes of its elements. The reference tier also compares either reference
with results of other methods for the scene.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from chapters.numerics.attempt import Attempt, attempt, attempt_on, errors, in_time
from chapters.numerics.fixed_step import stepped, whole
from chapters.numerics.models import Ladder
from chapters.numerics.outside import RADAU, outside
from chapters.numerics.reference.converge import SMOOTH, converged, none
from chapters.numerics.reference.kept import Kept
from chapters.numerics.reference.store import NotUsed, read
from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError
from riserstudy.model.mesh import Mesh, even
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.curve import at_stations
from riserstudy.simulation.starting_mesh import massless

QUANTITIES = ("displacement", "moment", "tension")
HEAVE_STEP = 0.05  # s, time between the values of the stored heave
STUDY = "accuracy"  # folder of references
LONGEST = 30.0  # s, longest run that a reference is refined from
ENOUGH = 2e-4  # relative change by a refinement at which it ends, well below the finest tolerance
FOURTH: dict[str, object] = {"analysis.method": "ESDIRK4"}
TOLERANCE = 1e-9  # relative tolerance of Radau as an independent check
AVERAGE = {"beta": 0.25, "gamma": 0.5}
OPINIONS = ("lumped masses, ESDIRK4", "lumped masses, gen.-alpha", "Hermite, Newmark", "Radau")


@dataclass(frozen=True)
class Reference:
    """A reference solution: its description, and a function that returns the errors of a run by quantity.

    ``change``: change of the reference by its last refinement, by quantity; empty for another code's history.
    ``code``: description of another code, whose history it is; "" for a solution by riserstudy.
    """

    about: str
    errors: Callable[[Result], dict[str, float]]
    change: dict[str, float] = field(default_factory=dict)
    code: str = ""


def reference(file: SceneFile, name: str, ladder: Ladder, config: Path) -> Reference:
    """Return the reference of a scene; if the stored file cannot be used, one that returns no errors."""
    if ladder.stored:
        return stored(config / ladder.stored)
    try:
        kept = read(config, STUDY, name, file.resolved())
    except NotUsed as error:
        return Reference(str(error), lambda _: {})
    if kept.result is None:
        return Reference(kept.missing, lambda _: {})
    return Reference(f"own: {kept.how}", by_run(kept.result).errors, kept.error)


def solved(name: str, file: SceneFile, ladder: Ladder) -> Kept:
    """Compute riserstudy's reference from a run with the default accuracy.

    If this run fails or takes long, compute it from the finest mesh and step of the ladder.
    """
    scene = whole(file.resolved())
    first = attempt(lambda: in_time(scene, LONGEST))
    if first.result is None:
        mesh, step = even(scene, ladder.elements[-1]), ladder.steps[-1]
        first = attempt_on(stepped(file, SMOOTH.method, mesh, step), mesh, step, math.inf)
    if first.result is None:
        return none(name, file, first.message)
    return converged(name, file, first.result, replace(SMOOTH, enough=ENOUGH))


def differences(best: Reference, file: SceneFile, ladder: Ladder) -> dict[str, dict[str, float]]:
    """Differences of the results of other methods from a reference, by method and quantity."""
    runs = zip(OPINIONS, opinions(file, ladder), strict=True)
    return {name: best.errors(r.result) for name, r in runs if r.result}


def opinions(file: SceneFile, ladder: Ladder) -> list[Attempt]:
    """Fine runs by several methods; a method that cannot simulate the scene gives a refusal."""
    scene = whole(file.resolved())
    mesh, step = even(scene, ladder.elements[-1]), ladder.steps[-1]
    finer = mesh if massless(scene) else even(scene, 2 * ladder.elements[-1])

    def one(on: Mesh, h: float, values: dict[str, object]) -> Attempt:
        return attempt_on(stepped(file, values, on, h), on, h, math.inf)

    attempts = [
        one(finer, 0.5 * step, FOURTH),
        one(mesh, step, {"analysis.method": {"rho_inf": 0.9}}),
        one(finer, step, {"analysis.solver": "hermite", "analysis.method": AVERAGE}),
    ]
    if not massless(scene):
        return [*attempts, Attempt(None, None, "lumping would show", 0.0)]
    exact = stepped(file, {"analysis.method": "explicit"}, mesh, step)
    return [*attempts, attempt(lambda: outside(exact, mesh, RADAU, TOLERANCE))]


def stored(path: Path) -> Reference:
    """Read a history of another code, in the format of the files in ``tests/verification``."""
    with np.load(path) as file:
        best = {name: file[name] for name in file.files}
    measure = _of_heave if "bottom" in best else _of_surge
    code = str(best["about"])
    return Reference(f"stored: {code}", lambda run: measure(run, best), code=code)


def by_run(best: Result) -> Reference:
    """Reference from a finer run, interpolated at the nodes of another run by the shapes of its elements."""
    return Reference("a finer run", lambda run: errors(run, best))


def _off(found: FloatArray, expected: FloatArray) -> float:
    return float(np.abs(found - expected).max() / np.abs(expected).max())


def _rows(time: FloatArray, of: FloatArray) -> NDArray[np.int64]:
    """Rows of a stored history at the output times of a run (s)."""
    rows = np.searchsorted(of, time - 1e-6)
    if rows[-1] >= len(of) or np.abs(of[rows] - time).max() > 1e-6:
        raise SimulationError("outputs at times that the stored reference has not")
    return rows


def _of_surge(run: Result, best: dict[str, FloatArray]) -> dict[str, float]:
    """Errors of lateral position at the stored stations, moment along the riser, and force at the top."""
    a = run.arrays
    rows, there = _rows(a["time"], best["time"]), _rows(a["time"], best["moment_time"])
    x = at_stations(a, best["s"])["x"]
    moment = at_stations(a, best["moment_s"])["bending_moment"]
    pull = np.hypot(*best["top_force"][rows].T)
    return {
        "displacement": _off(x, best["x"][rows]),
        "moment": _off(moment, best["moment"][there]),
        "tension": _off(a["effective_tension"][:, -1], pull),
    }


def _of_heave(run: Result, best: dict[str, FloatArray]) -> dict[str, float]:
    """Errors of the motion of the lower end and of the tension at the top."""
    a = run.arrays
    rows = _rows(a["time"], np.arange(len(best["bottom"]), dtype=np.float64) * HEAVE_STEP)
    return {
        "displacement": _off(a["z"][:, 0] - a["z_static"][0], best["bottom"][rows]),
        "tension": _off(a["effective_tension"][:, -1], best["top_tension"][rows]),
    }
