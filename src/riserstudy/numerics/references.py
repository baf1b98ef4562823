"""What the error of a run is measured by: a stored history of another code, or a fine run of our own.

Stored ones share neither discretisation nor integrator with the engine (quintic elements with Radau IIA,
the method of characteristics). Where there is none, the mesh of the finest request is halved twice, and its
step with it, by the fourth-order method; what the second halving changed says what the reference is worth.
Runs on other meshes are compared where their own nodes are, and there a run is what its elements mean. What
other methods make of the same scene stands beside either.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError
from riserstudy.model.mesh import Mesh, even
from riserstudy.numerics.attempt import Attempt, attempt, attempt_on, errors, mesh_of
from riserstudy.numerics.fixed_step import stepped, whole
from riserstudy.numerics.outside import RADAU, outside
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.curve import at_stations
from riserstudy.simulation.starting_mesh import massless
from riserstudy.study.measured import Ladder

Array = NDArray[np.float64]
QUANTITIES = ("displacement", "moment", "tension")
HEAVE_STEP = 0.05  # s, between the values of the stored heave
HALVINGS = 2  # of mesh and step, from a finest request to a reference
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


def reference(
    file: SceneFile, ladder: Ladder, config: Path, finest: Result | None
) -> tuple[Reference, dict[str, dict[str, float]]]:
    """The reference of a scene, and how far the opinions of other methods are from it.

    Parameters
    ----------
    finest : what the finest request that could be met chose; None where none could, which leaves the
        finest rung of the ladder.

    Raises
    ------
    SimulationError
        When our own run cannot be completed.
    """
    best = stored(config / ladder.stored) if ladder.stored else refined(file, ladder, finest)
    runs = zip(OPINIONS, opinions(file, ladder), strict=True)
    return best, {name: best.errors(r.result) for name, r in runs if r.result}


def refined(file: SceneFile, ladder: Ladder, finest: Result | None) -> Reference:
    """Our own reference: mesh and step of a run halved twice, with what the second time changed.

    Raises
    ------
    SimulationError
        When a run cannot be completed.
    """
    scene = whole(file.scene())
    mesh = mesh_of(scene, finest) if finest else even(scene, ladder.elements[-1])
    step = finest.facts["step"] if finest else ladder.steps[-1]
    runs: list[Result] = []
    for _ in range(HALVINGS):
        mesh, step = mesh if massless(scene) else mesh.halved(), 0.5 * step
        tried = attempt_on(stepped(file, FOURTH, mesh, step), mesh, step, math.inf)
        if tried.result is None:
            raise SimulationError(f"reference on {len(mesh.l0)} segments: {tried.message}")
        runs.append(tried.result)
    best = by_run(runs[-1])
    about = f"own: {len(mesh.l0)} segments, {step:.3g} s, ESDIRK4"
    return Reference(about, best.errors, best.errors(runs[-2]))


def opinions(file: SceneFile, ladder: Ladder) -> list[Attempt]:
    """Fine runs by several methods; one that cannot do the scene is a refusal."""
    scene = whole(file.scene())
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
