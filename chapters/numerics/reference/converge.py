"""Refinement of a scene's solution until further refinement changes it very little."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from chapters.numerics.attempt import attempt_on, errors, mesh_of
from chapters.numerics.fixed_step import stepped, whole
from chapters.numerics.outcome import Outcome
from chapters.numerics.reference.identity import PHYSICS, scene_digest
from chapters.numerics.reference.kept import Kept, reduced
from riserstudy.dataset.result import Result
from riserstudy.files.digests import engine_digest
from riserstudy.model.mesh import Mesh
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.error_estimate import deciding
from riserstudy.simulation.sampling_error import DOUBTFUL, floor
from riserstudy.simulation.starting_mesh import massless


@dataclass(frozen=True)
class Recipe:
    """How a reference is computed.

    ``enough``: change of the deciding error by a refinement, at or below which refinement ends.
    ``most_work``: largest number of node-steps of a further refinement. ``most_first``: largest number of
    node-steps of the first refinement; if it needs more, there is no reference.
    """

    method: dict[str, Any]
    name: str
    enough: float
    most_work: float
    most_first: float = math.inf


#: fourth order
SMOOTH = Recipe({"analysis.method": "ESDIRK4"}, "ESDIRK4", 1e-3, 1e7)
#: second order with dissipation, for end stops, snap loads and disconnects
HARD = Recipe({"analysis.method": {"rho_inf": 0.6}}, "generalised-alpha 0.6", 1e-3, 3e7)
LEAST, MOST = 2, 8  # refinements


def none(case: str, file: SceneFile, why: str) -> Kept:
    """Return the record of a case that has no reference, with the reason."""
    return Kept(case, scene_digest(file.resolved()), PHYSICS, engine_digest(), "", missing=why)


def converged(case: str, file: SceneFile, first: Result, recipe: Recipe, mesh: Mesh | None = None) -> Kept:
    """Compute the reference of a scene by repeated halving of the mesh and step of a run.

    Parameters
    ----------
    mesh : mesh of the run; None: derived from its segments, which represents a graded mesh less smoothly.

    Returns
    -------
    The finest run. Its error is the change by the last refinement; for vortex-induced vibration at least
    twice the standard error of its statistics, which refinement does not reduce.
    """
    scene = whole(file.resolved())
    mesh, step = mesh or mesh_of(scene, first), first.facts.get("step")
    change: dict[str, float] = {}
    best, runs, enough = first, 0, recipe.enough
    while runs < LEAST or (runs < MOST and not deciding(change) <= enough):
        mesh = mesh if massless(scene) else mesh.halved()
        step = 0.5 * step if step else None
        own = stepped(file, recipe.method, mesh, step) if step else scene
        tried = attempt_on(own, mesh, step, recipe.most_work if runs else recipe.most_first)
        if tried.result is None:
            break
        best, change, runs = tried.result, errors(best, tried.result), runs + 1
        if "sampling_error" in best.facts:
            enough = max(recipe.enough, deciding(floor(best.facts["sampling_error"])))
    if not runs or (runs < LEAST and tried.refused is not Outcome.TOO_LONG):
        return none(case, file, tried.message)
    sampling = best.facts.get("sampling_error", {})
    return Kept(
        case,
        scene_digest(file.resolved()),
        PHYSICS,
        engine_digest(),
        method_of(recipe, best),
        {name: max(value, DOUBTFUL * sampling.get(name, 0.0)) for name, value in change.items()},
        reduced(best, first.arrays["s_node"]),
    )


def method_of(recipe: Recipe, best: Result) -> str:
    """Describe in words how a reference was computed."""
    step = best.facts.get("step")
    at = f"{step:.3g} s" if step else "at rest"
    return f"{recipe.name}, {len(best.arrays['l0'])} segments, {at}"
