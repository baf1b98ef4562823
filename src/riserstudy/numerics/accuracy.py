"""What accuracy costs in time: every method on a ladder of meshes and steps, errors beside wall time.

Errors are against a run with the finest mesh halved once more and the finest step halved by the
fourth-order method; ``reference_difference`` says how far generalised-alpha on the finest rung is from it.
And the accuracy that a user asks for: what was asked, estimated, reached and spent.
"""

from __future__ import annotations

import math
import statistics
import time as clock
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from riserstudy.coarsest import massless
from riserstudy.mesh import even
from riserstudy.numerics.attempt import Attempt, attempt, attempt_on, errors
from riserstudy.numerics.models import AccuracyStudy, Ladder
from riserstudy.numerics.scenes import in_tier
from riserstudy.numerics.stability import FREE, attempt_limit, stepped, whole
from riserstudy.result import Result
from riserstudy.run import run
from riserstudy.scene.load import SceneFile, read_scene

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.study import Tier

QUANTITIES = ("displacement", "moment", "tension")
COSTS = ("wall_seconds", "wall_minimum", "newton_iterations", "steps", "step", "elements")
EXPLICIT = "explicit"
WHERE = "config/studies/numerics.yaml: measured.accuracy"


def accuracy(study: AccuracyStudy, config: Path, tier: Tier) -> xr.Dataset:
    """All scenes by all methods, as a dataset over scene, method, mesh and step of the ladder."""
    import xarray as xr

    scenes, methods = in_tier(study.scenes, tier), in_tier(study.methods, tier)
    most = [max(len(getattr(s, way)) for s in scenes.values()) for way in ("elements", "steps")]
    shape = (len(scenes), len(methods), *most)
    value: dict[str, Any] = {
        name: np.full(shape, np.nan) for name in (*COSTS, *(f"error_{q}" for q in QUANTITIES))
    }
    value["message"] = np.full(shape, "", object)
    doubt = np.full((len(scenes), len(QUANTITIES)), np.nan)
    asked: list[dict[str, Any]] = []
    for i, (name, ladder) in enumerate(scenes.items()):
        file = read_scene(config / ladder.scene).with_values(FREE | ladder.set, f"{WHERE}: {name}")
        best = reference(file, ladder)
        nearby = rung(file, {"analysis.method": {"rho_inf": 0.9}}, ladder, -1, -1, 1, study.budget)
        if nearby.result:
            found = errors(nearby.result, best)
            doubt[i] = [found.get(q, np.nan) for q in QUANTITIES]
        for j, method in enumerate(methods.values()):
            for k in range(len(ladder.elements)):
                for m in range(len(ladder.steps)):
                    one = rung(file, method.set, ladder, k, m, study.repeats, study.budget)
                    at = (i, j, k, m)
                    value["message"][at] = one.message
                    if one.result is None:
                        continue
                    for q, error in errors(one.result, best).items():
                        value[f"error_{q}"][at] = error
                    for cost in COSTS:
                        value[cost][at] = one.result.facts.get(cost, np.nan)
        asked += [spent(file, name, share, best) for share in study.asked[tier]]
    dims = ("scene", "method", "mesh_level", "step_level")
    data: dict[str, Any] = {
        name: (dims, array.astype(str) if array.dtype == object else array)
        for name, array in value.items()
    }
    data["reference_difference"] = (("scene", "quantity"), doubt)
    for name in asked[0] if asked else ():
        data[name] = ("request", [row[name] for row in asked])
    dataset = xr.Dataset(
        data, {"scene": list(scenes), "method": list(methods), "quantity": list(QUANTITIES)}
    )
    for name, (unit, words) in ABOUT.items():
        if name in dataset:
            dataset[name].attrs = {"units": unit, "long_name": words}
    return dataset


def reference(file: SceneFile, ladder: Ladder) -> Result:
    """The finest run of a scene."""
    scene = whole(file.scene())
    elements, step = 2 * ladder.elements[-1], 0.5 * ladder.steps[-1]
    if massless(scene):
        elements = ladder.elements[-1]
    mesh = even(scene, elements)
    other = stepped(file, {"analysis.method": "ESDIRK4"}, mesh, step)
    tried = attempt_on(other, mesh, step, math.inf)
    if tried.result is None:
        raise RuntimeError(tried.message)
    return tried.result


def rung(
    file: SceneFile,
    values: dict[str, Any],
    ladder: Ladder,
    k: int,
    m: int,
    repeats: int,
    budget: float,
) -> Attempt:
    """One rung, timed several times; explicit steps are shares of the predicted stable one."""
    scene = whole(file.scene())
    mesh, step = even(scene, ladder.elements[k]), ladder.steps[m]
    own = stepped(file, values, mesh, step)
    if values.get("analysis.method") == EXPLICIT:
        if m > 0:
            return Attempt(None, None, "one step alone", 0.0)
        limit = attempt_limit(own, mesh)
        step = 0.9 * limit if limit else step
    walls = []
    for _ in range(repeats + 1):  # the first one warms up
        started = clock.perf_counter()
        tried = attempt_on(own, mesh, step, budget)
        walls.append(clock.perf_counter() - started)
        if tried.result is None:
            return tried
        if walls[0] > 5.0:
            break
    timed = walls[1:] or walls
    if tried.result is not None:
        facts = tried.result.facts
        facts |= {"wall_seconds": statistics.median(timed), "wall_minimum": min(timed)}
    return tried


def spent(file: SceneFile, name: str, share: float, best: Result) -> dict[str, Any]:
    """What asking for an accuracy came to, for a scene."""
    scene = whole(file.with_values({"analysis.accuracy": f"{100 * share!r} %"}, WHERE).scene())
    attempt(lambda: run(scene))  # warms up
    tried = attempt(lambda: run(scene))
    row: dict[str, Any] = {"request_scene": name, "requested": share, "request_seconds": np.nan}
    row |= {f"{kind}_{q}": np.nan for kind in ("estimated", "reached") for q in QUANTITIES}
    row |= {"request_elements": 0, "request_step": np.nan}
    if tried.result is None:
        return row
    facts = tried.result.facts
    row |= {"request_seconds": tried.seconds, "request_elements": facts["elements"]}
    row["request_step"] = facts.get("step", np.nan)
    reached = errors(tried.result, best)
    for q in QUANTITIES:
        row[f"estimated_{q}"] = facts["error_estimate"].get(q, np.nan)
        row[f"reached_{q}"] = reached.get(q, np.nan)
    return row


ABOUT = {
    "wall_seconds": ("s", "median wall time of a run, compiling apart"),
    "wall_minimum": ("s", "least wall time of a run"),
    "newton_iterations": ("1", "Newton iterations"),
    "steps": ("1", "time steps"),
    "step": ("s", "time step"),
    "elements": ("1", "segments"),
    **{f"error_{q}": ("1", f"error of the {q} history over its largest value") for q in QUANTITIES},
    "reference_difference": ("1", "generalised-alpha on the finest rung beside the reference"),
    "requested": ("1", "accuracy asked for"),
    "request_seconds": ("s", "wall time of all runs that a request took"),
    "request_elements": ("1", "segments that were chosen"),
    "request_step": ("s", "step that was chosen"),
}
