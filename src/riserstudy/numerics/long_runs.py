"""Long simulations: what a published or a demanding one takes, over candidates of mesh, step and method.

Every candidate is timed and compared with a reference: moments of the whole history, and the largest
moment anywhere. The cheapest that is accurate enough is what a user could have; the paper's own setting is
one of the candidates.
"""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import psutil

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError
from riserstudy.model.mesh import Mesh, even
from riserstudy.numerics.accuracy import timed
from riserstudy.numerics.attempt import Attempt, attempt_on, largest
from riserstudy.numerics.fixed_step import FREE, stepped, whole
from riserstudy.numerics.references import by_run
from riserstudy.numerics.scenes import Setting, in_tier
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.scene.models import Scene
from riserstudy.simulation.starting_mesh import coarsest_mesh
from riserstudy.study.measured import LongCase, LongStudy

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.study.models import Tier

WHERE = "config/studies/numerics.yaml: measured.long_runs"


def long_runs(study: LongStudy, setting: Setting) -> xr.Dataset:
    """All candidates of all cases, one after another: they are timed. References, which are not, before."""
    import xarray as xr

    cases = in_tier(study.cases, setting.tier)
    files = [scene_of(setting.config, name, case, setting.tier) for name, case in cases.items()]
    with ThreadPoolExecutor(setting.threads) as pool:
        best = list(pool.map(reference, cases.values(), files))
    rows: list[dict[str, Any]] = []
    for (name, case), file, known in zip(cases.items(), files, best, strict=True):
        rows += candidates(name, case, file, known, study.repeats, setting.tier)
    dataset = xr.Dataset({key: ("run", [row[key] for row in rows]) for key in rows[0]})
    for name, (unit, words) in ABOUT.items():
        dataset[name].attrs = {"units": unit, "long_name": words}
    if setting.tier == "preview":  # which cuts runs short: what papers and we name is of whole ones
        for name in ("published_seconds", "target_seconds"):
            dataset[name] = dataset[name].where(False)
    dataset.attrs["load_average"] = psutil.getloadavg()[0]
    return dataset


def scene_of(config: Path, name: str, case: LongCase, tier: Tier) -> SceneFile:
    """The scene of a case, as long as the tier asks for."""
    sets = case.set | (case.preview or {} if tier == "preview" else {})
    return read_scene(config / case.scene).with_values(FREE | sets, f"{WHERE}: {name}")


def candidates(
    name: str, case: LongCase, file: SceneFile, best: Result, repeats: int, tier: Tier
) -> list[dict[str, Any]]:
    """Every candidate of a case as a row, the paper's own first."""
    scene = whole(file.scene())
    rows = []
    if case.own and tier != "preview":
        mesh, step = even(scene, case.own.elements), case.own.step
        tried = timed(
            partial(attempt_on, stepped(file, case.own.set, mesh, step), mesh, step, math.inf), 0
        )
        rows.append(row(name, case, "the paper's own", step, tried, best))
    for label, mesh in meshes(case, scene):
        for method, values in case.methods.items():
            for step in case.steps:
                own = stepped(file, values, mesh, step)
                one = partial(attempt_on, own, mesh, step, math.inf)
                tried = timed(one, repeats)
                rows.append(row(name, case, f"{method}, {label}", step, tried, best))
    return rows


def meshes(case: LongCase, scene: Scene) -> list[tuple[str, Mesh]]:
    """Even meshes, and those that a refinement would try."""
    named = [("even", even(scene, n)) for n in case.elements]
    mesh = coarsest_mesh(scene)
    for _ in range(case.graded):
        named.append(("graded", mesh))
        mesh = mesh.halved()
    return named


def reference(case: LongCase, file: SceneFile) -> Result:
    """A run finer in mesh and step than any candidate, by the fourth-order method.

    Raises
    ------
    SimulationError
        When it cannot be completed.
    """
    scene = whole(file.scene())
    mesh = meshes(case, scene)[-1][1].halved()
    step = 0.5 * case.steps[-1]
    own = stepped(file, {"analysis.method": "ESDIRK4"}, mesh, step)
    tried = attempt_on(own, mesh, step, math.inf)
    if tried.result is None:
        raise SimulationError(tried.message)
    return tried.result


def row(
    name: str, case: LongCase, label: str, step: float, tried: Attempt, best: Result
) -> dict[str, Any]:
    """What came of a candidate."""
    numbers = {
        "case": name,
        "candidate": label,
        "asked_step": step,
        "message": tried.message,
        "published_seconds": case.published_seconds or math.nan,
        "target_seconds": case.target_seconds or math.nan,
        "elements": 0,
        "wall_seconds": math.nan,
        "cpu_seconds": math.nan,
        "error_moment": math.nan,
        "error_peak": math.nan,
    }
    if tried.result is None:
        return numbers
    facts = tried.result.facts
    peak = largest(best, "bending_moment")
    return numbers | {
        "elements": facts["elements"],
        "wall_seconds": facts.get("wall_seconds_min", tried.seconds),
        "cpu_seconds": facts.get("cpu_seconds", math.nan),
        "error_moment": by_run(best).errors(tried.result)["moment"],
        "error_peak": abs(largest(tried.result, "bending_moment") / peak - 1.0),
    }


ABOUT = {
    "asked_step": ("s", "time step"),
    "elements": ("1", "segments"),
    "wall_seconds": ("s", "least wall time"),
    "cpu_seconds": ("s", "least processor time"),
    "published_seconds": ("s", "wall time that the paper names"),
    "target_seconds": ("s", "wall time that we aim at"),
    "error_moment": ("1", "error of the moment, all nodes and outputs, over its largest value"),
    "error_peak": ("1", "error of the largest moment"),
}
