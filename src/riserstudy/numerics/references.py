"""What the error of a run is measured by: a stored history of another code, or a fine run of our own.

Stored ones share neither discretisation nor integrator with the engine (quintic elements with Radau IIA,
the method of characteristics). Where there is none, the reference is the engine's finest mesh halved once
more, by the fourth-order method. What other methods make of the same scene stands beside either.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError
from riserstudy.model.mesh import Mesh, even
from riserstudy.numerics.attempt import Attempt, attempt, attempt_on, errors
from riserstudy.numerics.outside import RADAU, outside
from riserstudy.numerics.stability import stepped, whole
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.starting_mesh import massless
from riserstudy.study.measured import Ladder

Array = NDArray[np.float64]
QUANTITIES = ("displacement", "moment", "tension")
FIELDS = {
    "displacement": ("x", "y", "z"),
    "moment": ("bending_moment",),
    "tension": ("effective_tension",),
}
HEAVE_STEP = 0.05  # s, between the values of the stored heave
ROUNDING = 1e-9  # riser lengths of displacement that count as none
TOLERANCE = 1e-9  # of Radau as a second opinion
AVERAGE = {"beta": 0.25, "gamma": 0.5}
OPINIONS = ("lumped masses, ESDIRK4", "lumped masses, gen.-alpha", "Hermite, Newmark", "Radau")


@dataclass(frozen=True)
class Reference:
    """How far a run is off, by quantity, and by what that is told."""

    about: str
    errors: Callable[[Result], dict[str, float]]


def reference(
    file: SceneFile, ladder: Ladder, config: Path
) -> tuple[Reference, dict[str, dict[str, float]]]:
    """The reference of a scene, and how far the opinions of other methods are from it."""
    runs = dict(zip(OPINIONS, opinions(file, ladder), strict=True))
    own = runs[OPINIONS[0]].result
    if own is None:
        raise SimulationError(runs[OPINIONS[0]].message)
    if ladder.stored:
        best = stored(config / ladder.stored)
    else:
        best = Reference(
            "own: finest mesh halved, half the finest step, ESDIRK4", lambda r: errors(r, own)
        )
        del runs[OPINIONS[0]]
    return best, {name: best.errors(r.result) for name, r in runs.items() if r.result}


def opinions(file: SceneFile, ladder: Ladder) -> list[Attempt]:
    """Fine runs by several methods; one that cannot do the scene is a refusal."""
    scene = whole(file.scene())
    mesh, step = even(scene, ladder.elements[-1]), ladder.steps[-1]
    finer = mesh if massless(scene) else even(scene, 2 * ladder.elements[-1])

    def one(on: Mesh, h: float, values: dict[str, object]) -> Attempt:
        return attempt_on(stepped(file, values, on, h), on, h, math.inf)

    found = [
        one(finer, 0.5 * step, {"analysis.method": "ESDIRK4"}),
        one(mesh, step, {"analysis.method": {"rho_inf": 0.9}}),
        one(finer, step, {"analysis.solver": "hermite", "analysis.method": AVERAGE}),
    ]
    if not massless(scene):
        return [*found, Attempt(None, None, "lumping would show", 0.0)]
    exact = stepped(file, {"analysis.method": "explicit"}, mesh, step)
    return [*found, attempt(lambda: outside(exact, mesh, RADAU, TOLERANCE))]


def stored(path: Path) -> Reference:
    """A history of another code, as ``tests/verification`` keeps it."""
    with np.load(path) as file:
        best = {name: file[name] for name in file.files}
    measure = _of_heave if "bottom" in best else _of_surge
    return Reference(f"stored: {best['about']}", lambda run: measure(run, best))


def by_run(best: Result) -> Reference:
    """A finer run: histories and envelopes at the nodes of a run, where splines take the finer ones."""
    return Reference("a finer run", lambda run: _beside(run, best))


def _beside(run: Result, best: Result) -> dict[str, float]:
    found = {}
    for quantity, fields in FIELDS.items():
        off, scale = 0.0, 0.0
        for name in (f + end for f in fields for end in ("", "_max", "_min", "_static")):
            if name in best.arrays and name in run.arrays:
                expected = _displaced(best, name)
                there = CubicSpline(best.arrays["s_node"], expected, axis=-1)
                off = max(off, _most(_displaced(run, name) - there(run.arrays["s_node"])))
                scale = max(scale, _most(expected))
        least = ROUNDING * best.arrays["s_node"][-1] if quantity == "displacement" else 0.0
        if scale > least:
            found[quantity] = off / scale
    return found


def _displaced(run: Result, name: str) -> Array:
    """Values of a quantity; of positions, from where they are at rest or straight."""
    return np.asarray(run.arrays[name] - run.arrays.get(f"zero_{name[0]}", 0.0))


def _most(values: Array) -> float:
    return float(np.abs(values).max())


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
    x = CubicSpline(a["s"], a["x"], axis=1)(best["s"])
    moment = CubicSpline(a["s"], a["bending_moment"], axis=1)(best["moment_s"])
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
