"""Long simulations: run times of published or demanding ones, over candidates of mesh, step and method.

Every candidate is timed and compared with a reference: moments of the whole history, and the largest
moment anywhere. The cheapest sufficiently accurate candidate shows what a user can achieve. The setting of
the paper is run in `papers_settings`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import psutil

from chapters.numerics.attempt import Attempt, attempt_on, largest
from chapters.numerics.fixed_step import freed, stepped, whole
from chapters.numerics.measured.accuracy import timed
from chapters.numerics.models import LongCase, LongStudy, in_tier
from chapters.numerics.reference.check import with_recomputed
from chapters.numerics.reference.converge import SMOOTH, converged, none
from chapters.numerics.reference.kept import Kept
from chapters.numerics.reference.store import Wanted, solution
from chapters.numerics.references import by_run
from riserstudy.dataset.describe import label_variables
from riserstudy.dataset.result import Result
from riserstudy.model.mesh import Mesh, even
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.starting_mesh import coarsest_mesh
from riserstudy.study.measured import Setting

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.study.axes import Tier

FEW = 10  # steps
STUDY = "long_runs"  # folder of references
WHERE = "config/studies/numerics.yaml: measured.long_runs"


def long_runs(study: LongStudy, setting: Setting) -> xr.Dataset:
    """Run all candidates of all cases, in sequence, because they are timed.

    Raises
    ------
    SimulationError
        When the reference of a case cannot be used.
    """
    cases = in_tier(study.cases, setting.tier)
    files = [scene_of(setting.config, name, case, setting.tier) for name, case in cases.items()]
    rows: list[dict[str, Any]] = []
    for (name, case), file in zip(cases.items(), files, strict=True):
        best = solution(setting.config, STUDY, named(name, setting.tier), file.resolved())
        rows += candidates(name, case, file, best, study.repeats)
    dataset = dataset_of(rows)
    if setting.tier == "preview":  # runs are shortened, but these times are for whole runs
        for name in ("published_seconds", "target_seconds"):
            dataset[name] = dataset[name].where(False)
    dataset.attrs["load_average"] = psutil.getloadavg()[0]
    return with_recomputed(dataset, setting, study.references, wanted(study, setting.config))


def dataset_of(rows: list[dict[str, Any]]) -> xr.Dataset:
    """Return the rows of runs as a dataset, which may be empty; numbers that no row has are NaN."""
    import xarray as xr

    kinds = dict.fromkeys(TEXTS, str) | dict.fromkeys(ABOUT, float) | {"elements": int}
    columns = {name: [row.get(name, math.nan) for row in rows] for name in kinds}
    dataset = xr.Dataset({name: ("run", np.array(columns[name], kind)) for name, kind in kinds.items()})
    label_variables(dataset, ABOUT)
    return dataset


def scene_of(config: Path, name: str, case: LongCase, tier: Tier) -> SceneFile:
    """Read the scene of a case, with the duration of the tier."""
    sets = case.set | (case.preview or {} if tier == "preview" else {})
    return freed(config / case.scene, sets, f"{WHERE}: {name}")


def candidates(
    name: str, case: LongCase, file: SceneFile, best: Result, repeats: int
) -> list[dict[str, Any]]:
    """Run every candidate of a case: one row each."""
    scene = whole(file.resolved())
    known = {"published_seconds": case.published_seconds, "target_seconds": case.target_seconds}
    rows = []
    for label, mesh in meshes(case, scene):
        for method, values in case.methods.items():
            for step in case.steps:
                tried = candidate(file, values, mesh, step, repeats)
                rows.append(row(name, (method, label), step, tried, best) | known)
    return rows


def candidate(file: SceneFile, values: dict[str, Any], mesh: Mesh, step: float, repeats: int) -> Attempt:
    """Time a candidate after a run of a few steps has loaded its kernels."""
    few = {"analysis.duration": f"{FEW * step!r} s", "analysis.output": {"interval": f"{FEW * step!r} s"}}
    attempt_on(stepped(file.with_values(few, "few steps"), values, mesh, step), mesh, step, math.inf)
    one = partial(attempt_on, stepped(file, values, mesh, step), mesh, step, math.inf)
    return timed(one, repeats, warm=True)


def meshes(case: LongCase, scene: Resolved) -> list[tuple[str, Mesh]]:
    """Return meshes of equal segments, and graded meshes that a refinement would try."""
    named = [("even", even(scene, n)) for n in case.elements]
    mesh = coarsest_mesh(scene)
    for _ in range(case.graded):
        named.append(("graded", mesh))
        mesh = mesh.halved()
    return named


def named(case: str, tier: Tier) -> str:
    """Name of the reference of a case: the preview tier, which shortens the case, has a separate one."""
    return f"{case}, preview" if tier == "preview" else case


def wanted(study: LongStudy, config: Path) -> Iterator[Wanted]:
    """Yield the references of all cases, with the duration of each tier."""
    tiers: tuple[Tier, ...] = ("preview", "standard")
    for tier in tiers:
        for name, case in in_tier(study.cases, tier).items():
            file = scene_of(config, name, case, tier)
            yield Wanted(named(name, tier), file, partial(solved, named(name, tier), case, file))


def solved(name: str, case: LongCase, file: SceneFile) -> Kept:
    """Compute a reference by the fourth-order method, with finer mesh and step than any candidate."""
    mesh, step = meshes(case, whole(file.resolved()))[-1][1], case.steps[-1]
    finest = attempt_on(stepped(file, SMOOTH.method, mesh, step), mesh, step, math.inf)
    if finest.result is None:
        return none(name, file, finest.message)
    return converged(name, file, finest.result, SMOOTH, mesh)


def row(name: str, of: tuple[str, str], step: float, tried: Attempt, best: Result) -> dict[str, Any]:
    """Return the row of a candidate: its times and errors, or the message of its refusal.

    ``of``: its method, and the kind of its mesh, "" for the mesh of a paper.
    """
    numbers = {
        "case": name,
        "method": of[0],
        "mesh": of[1],
        "asked_step": step,
        "message": tried.message,
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


TEXTS = ("case", "method", "mesh", "message")
ABOUT = {
    "asked_step": ("s", "time step"),
    "elements": ("1", "segments"),
    "wall_seconds": ("s", "shortest elapsed time"),
    "cpu_seconds": ("s", "shortest CPU time"),
    "published_seconds": ("s", "elapsed time that the paper gives"),
    "target_seconds": ("s", "aimed-at elapsed time"),
    "error_moment": ("1", "error of the moment, all nodes and outputs, over its largest value"),
    "error_peak": ("1", "error of the largest moment"),
}
