"""What the error of a run is measured by: a stored history of another code, or a kept fine run of our own.

Stored ones share neither discretisation nor integrator with the engine (quintic elements with Radau IIA,
the method of characteristics). Where there is none, the mesh of the finest request was halved twice or more,
and its step with it, by the fourth-order method; what the last halving changed says what the reference is
worth. Runs on other meshes are compared where their own nodes are, and there a run is what its elements
mean. What other methods make of the same scene stands beside either, in the reference tier.
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
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.curve import at_stations
from riserstudy.simulation.starting_mesh import massless

Array = NDArray[np.float64]
QUANTITIES = ("displacement", "moment", "tension")
HEAVE_STEP = 0.05  # s, between the values of the stored heave
STUDY = "accuracy"  # folder of references
LONGEST = 30.0  # seconds of a request that a reference is refined from
ENOUGH = 2e-4  # change by a refinement, well below the finest request
FOURTH: dict[str, object] = {"analysis.method": "ESDIRK4"}
TOLERANCE = 1e-9  # of Radau as a second opinion
AVERAGE = {"beta": 0.25, "gamma": 0.5}
OPINIONS = ("lumped masses, ESDIRK4", "lumped masses, gen.-alpha", "Hermite, Newmark", "Radau")


@dataclass(frozen=True)
class Reference:
    """How far a run is off, by quantity, and by what that is told.

    ``change``: what the last refinement changed of it, by quantity; none where it is another code's.
    """

    about: str
    errors: Callable[[Result], dict[str, float]]
    change: dict[str, float] = field(default_factory=dict)


def reference(file: SceneFile, name: str, ladder: Ladder, config: Path) -> Reference:
    """The reference of a scene; one by which nothing is known where what is kept cannot be used."""
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
    """Our own reference, from the default accuracy, or from the finest rung where that takes long."""
    scene = whole(file.resolved())
    first = attempt(lambda: in_time(scene, LONGEST))
    if first.result is None:
        mesh, step = even(scene, ladder.elements[-1]), ladder.steps[-1]
        first = attempt_on(stepped(file, SMOOTH.method, mesh, step), mesh, step, math.inf)
    if first.result is None:
        return none(name, file, first.message)
    return converged(name, file, first.result, replace(SMOOTH, enough=ENOUGH))


def differences(best: Reference, file: SceneFile, ladder: Ladder) -> dict[str, dict[str, float]]:
    """How far the opinions of other methods are from a reference."""
    runs = zip(OPINIONS, opinions(file, ladder), strict=True)
    return {name: best.errors(r.result) for name, r in runs if r.result}


def opinions(file: SceneFile, ladder: Ladder) -> list[Attempt]:
    """Fine runs by several methods; one that cannot do the scene is a refusal."""
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
    """A history of another code, as ``tests/verification`` keeps it."""
    with np.load(path) as file:
        best = {name: file[name] for name in file.files}
    measure = _of_heave if "bottom" in best else _of_surge
    return Reference(f"stored: {best['about']}", lambda run: measure(run, best))


def by_run(best: Result) -> Reference:
    """A finer run, laid on the nodes of another by the shapes of its elements."""
    return Reference("a finer run", lambda run: errors(run, best))


def _off(found: Array, expected: Array) -> float:
    return float(np.abs(found - expected).max() / np.abs(expected).max())


def _rows(time: Array, of: Array) -> NDArray[np.int64]:
    """Rows of a stored history at the output times of a run."""
    rows = np.searchsorted(of, time - 1e-6)
    if rows[-1] >= len(of) or np.abs(of[rows] - time).max() > 1e-6:
        raise SimulationError("outputs at times that the stored reference has not")
    return rows


def _of_surge(run: Result, best: dict[str, Array]) -> dict[str, float]:
    """Sideways motion at the stored stations, moments along the riser, force at the top."""
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


def _of_heave(run: Result, best: dict[str, Array]) -> dict[str, float]:
    """Motion of the lower end and tension at the top."""
    a = run.arrays
    rows = _rows(a["time"], np.arange(len(best["bottom"]), dtype=np.float64) * HEAVE_STEP)
    return {
        "displacement": _off(a["z"][:, 0] - a["z_static"][0], best["bottom"][rows]),
        "tension": _off(a["effective_tension"][:, -1], best["top_tension"][rows]),
    }
