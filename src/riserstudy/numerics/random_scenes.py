"""Is a requested accuracy reached, its error estimated well, and cheap? Over seeded random scenes.

Scenes are drawn from what papers leave open and from the ranges of their studies; half of them are held
out, which nobody may look at when refinement is tuned. The true error is measured by a run on segments a
quarter as long (half as long on fine meshes), with half the step of the fourth-order method. The cost is
compared with that of the cheapest even mesh and step that err no more, which nobody knows beforehand.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import psutil

from riserstudy.dataset.result import Result
from riserstudy.model.mesh import Mesh, even
from riserstudy.numerics.attempt import Attempt, Outcome, attempt, attempt_on, in_time, mesh_of
from riserstudy.numerics.fixed_step import FREE, stepped, whole
from riserstudy.numerics.references import QUANTITIES, Reference, by_run
from riserstudy.numerics.scenes import Setting, in_tier
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.scene.models import Scene
from riserstudy.scene.origin import Origin
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import single
from riserstudy.simulation.starting_mesh import massless, period
from riserstudy.study.measured import Family, RandomStudy
from riserstudy.study.sampling import sample

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.study.models import Tier

WHERE = "config/studies/numerics.yaml: measured.random_scenes"
FINE = 64  # segments, beyond which a reference halves them instead of quartering
OTHER = {"analysis.method": "ESDIRK4"}
NOT_JUDGED = "not judged"
TIMES = 2  # runs, of which the shortest counts
LEVELS = tuple(2.0 ** (k / 2) for k in range(24))  # of mesh and step, finer and finer
COARSE = 6  # segments, and steps a period, of the first level
CHEAPEST = 32.0  # times less work than the request: where the search begins
FALLEN = 0.9  # of an error, that refinement must bring to be worth going on


@dataclass
class Drawn:
    """A scene, what was drawn, and what came of it."""

    family: str
    held_out: bool
    sets: dict[str, Any]
    file: SceneFile
    message: str = ""
    asked: Result | None = None
    true: dict[str, float] = field(default_factory=dict)
    fixed: tuple[Mesh, float, float] | None = None  # mesh, step and error of the cheapest
    cost: dict[str, float] = field(default_factory=dict)


def random_scenes(study: RandomStudy, setting: Setting) -> xr.Dataset:
    """Draw scenes, ask for the accuracy, and measure what was reached and spent."""
    families = in_tier(study.families, setting.tier).items()
    drawn = [one for item in families for one in draw(*item, study, setting.config, setting.tier)]
    with ThreadPoolExecutor(max(1, setting.threads)) as pool:
        list(pool.map(partial(judge, patience=study.patience[setting.tier]), drawn))
    for one in drawn:  # one after another: they are timed
        spend(one)
    return tabulated(study, drawn)


def draw(
    name: str, family: Family, study: RandomStudy, config: Path, tier: Tier
) -> Iterator[Drawn]:
    """The scenes of a family: assumptions and varied values by a seeded Sobol sequence."""
    base = read_scene(config / family.scene).with_values(FREE | family.set, f"{WHERE}: {name}")
    open_values = {
        path: origin
        for path, origin in base.origins.items()
        if origin.status == "assumed" and (origin.range or origin.options)
    }
    for path, (low, high) in family.vary.items():
        open_values[path] = Origin("assumed", low, range=(low, high))
    for k, sets in enumerate(sample(open_values, study.count[tier], study.seed)):
        asked = {"analysis.accuracy": study.accuracy}
        yield Drawn(name, k % 2 == 1, sets, base.with_values(sets | asked, f"{WHERE}: {name}"))


def judge(one: Drawn, patience: float) -> None:
    """Run at the requested accuracy, find the true error, and find the cheapest that errs no more.

    A request that takes more than ``patience`` (s) is not judged: its true error would take far longer.
    """
    scene = whole(one.file.scene())
    attempt(lambda: run(scene, 0.0))  # loads its kernels, which is not the request's time
    tried = attempt(lambda: in_time(scene, patience))
    if tried.result is None:
        late = f"{NOT_JUDGED}: " if tried.refused is Outcome.TOO_LONG else ""
        one.message = f"{late}{tried.message}"
        return
    best = reference_of(one.file, scene, tried.result)
    if best.result is None:
        one.message = f"reference: {best.message}"
        return
    one.asked = tried.result
    measure = by_run(best.result)
    one.true = measure.errors(tried.result)
    one.fixed = cheapest(one, scene, measure, max(one.true.values(), default=0.0))


def cheapest(
    one: Drawn, scene: Scene, measure: Reference, achieved: float
) -> tuple[Mesh, float, float] | None:
    """Even mesh and step of least work that err no more; none if that takes more than the request.

    A mesh that shorter steps do not help is not tried further, nor a step that finer meshes do not.
    """
    spent = sum(map(_work, one.asked.facts["refinements"])) if one.asked else 0.0
    duration = scene.analysis.duration or 0.0
    last: dict[tuple[str, float], float] = {}
    exhausted: set[tuple[str, float]] = set()
    for work, n, step in by_work(scene):
        levels = {("segments", float(n)), ("step", step)}
        if work * duration < spent / CHEAPEST or levels & exhausted:
            continue
        if work * duration > spent:
            break
        mesh = even(scene, n)
        attempted = attempt_on(stepped(one.file, {}, mesh, step), mesh, step, math.inf)
        if attempted.result is None:
            continue
        error = max(measure.errors(attempted.result).values(), default=0.0)
        if error <= achieved:
            return mesh, step, error
        exhausted |= {level for level in levels if error > FALLEN * last.get(level, math.inf)}
        last |= dict.fromkeys(levels, error)
    return None


def reference_of(file: SceneFile, scene: Scene, found: Result) -> Attempt:
    """A run much finer than one that was found, by another method of stepping."""
    mesh = mesh_of(scene, found)
    finer = mesh if massless(scene) else _quartered(scene, found)
    step = 0.5 * found.facts["step"]
    return attempt_on(stepped(file, OTHER, finer, step), finer, step, math.inf)


def _quartered(scene: Scene, found: Result) -> Mesh:
    mesh = mesh_of(scene, found)
    return mesh.halved().halved() if len(mesh.l0) <= FINE else mesh.halved()


def by_work(scene: Scene) -> Iterator[tuple[float, int, float]]:
    """Segments per second of step, segments of even meshes, and steps (s): the cheapest first."""
    counts = [len(scene.riser)] if massless(scene) else [round(COARSE * x) for x in LEVELS]
    steps = [period(scene) / (COARSE * x) for x in LEVELS]
    yield from sorted((n / step, n, step) for n in counts for step in steps)


def spend(one: Drawn) -> None:
    """Time of the request and that of the fixed mesh and step, in turn; work for work."""
    if one.asked is None:
        return
    one.cost["work_asked"] = sum(map(_work, one.asked.facts["refinements"]))
    scene = one.file.scene()
    seconds: dict[str, list[float]] = {"asked": [], "fixed": []}
    for _ in range(TIMES):
        seconds["asked"].append(run(scene).facts["solve_seconds"])
        if one.fixed:
            mesh, step, _ = one.fixed
            fixed = single(stepped(one.file, {}, mesh, step), mesh, step)
            seconds["fixed"].append(fixed.facts["solve_seconds"])
            one.cost["work_fixed"] = _work(fixed.facts)
    one.cost |= {f"seconds_{name}": min(walls) for name, walls in seconds.items() if walls}


def _work(facts: dict[str, Any]) -> float:
    """Segments times Newton iterations: what a run costs, free of noise."""
    return float(facts["elements"]) * float(facts["newton_iterations"])


def tabulated(study: RandomStudy, drawn: list[Drawn]) -> xr.Dataset:
    """All scenes as one dataset; a scene that cannot be run is a row with its message."""
    import xarray as xr

    names = [f"{one.family} {k}" for k, one in enumerate(drawn)]
    data: dict[str, Any] = {
        "family": [one.family for one in drawn],
        "held_out": [one.held_out for one in drawn],
        "sets": [json.dumps(one.sets) for one in drawn],
        "message": [one.message for one in drawn],
    }
    for kind in ("true", "estimated"):
        errors = [_estimated(one) if kind == "estimated" else one.true for one in drawn]
        for q in QUANTITIES:
            data[f"{kind}_{q}"] = [of.get(q, math.nan) for of in errors]
        data[kind] = [max(of.values(), default=math.nan) for of in errors]
    facts = [one.asked.facts if one.asked else {} for one in drawn]
    data["elements"] = [f.get("elements", 0) for f in facts]
    data["step"] = [f.get("step", math.nan) for f in facts]
    data["runs"] = [len(f.get("refinements", [])) for f in facts]
    data["warnings"] = ["\n".join(f.get("warnings", [])) for f in facts]
    data["fixed_elements"] = [len(one.fixed[0].l0) if one.fixed else 0 for one in drawn]
    data["fixed_step"] = [one.fixed[1] if one.fixed else math.nan for one in drawn]
    data["fixed_error"] = [one.fixed[2] if one.fixed else math.nan for one in drawn]
    for name in ("seconds_asked", "seconds_fixed", "work_asked", "work_fixed"):
        data[name] = [one.cost.get(name, math.nan) for one in drawn]
    dataset = xr.Dataset({name: ("drawn", values) for name, values in data.items()})
    dataset = dataset.assign_coords(drawn=names)
    for name, (unit, words) in ABOUT.items():
        dataset[name].attrs = {"units": unit, "long_name": words}
    dataset.attrs = {"requested": study.share, "load_average": psutil.getloadavg()[0]}
    return dataset


def _estimated(one: Drawn) -> dict[str, float]:
    """The estimate, of what the error is known of."""
    estimate = one.asked.facts["error_estimate"] if one.asked else {}
    return {q: estimate[q] for q in one.true if q in estimate}


ABOUT = {
    **{f"true_{q}": ("1", f"true error of {q}") for q in QUANTITIES},
    **{f"estimated_{q}": ("1", f"estimated error of {q}") for q in QUANTITIES},
    "true": ("1", "largest true error"),
    "estimated": ("1", "largest estimated error"),
    "elements": ("1", "segments that were chosen"),
    "step": ("s", "step that was chosen"),
    "runs": ("1", "runs that choosing took"),
    "fixed_elements": ("1", "even segments of the cheapest that errs no more"),
    "fixed_step": ("s", "its step"),
    "fixed_error": ("1", "its error"),
    "seconds_asked": ("s", "time of all runs that the request took"),
    "seconds_fixed": ("s", "time of the cheapest run that errs no more"),
    "work_asked": ("1", "segments times Newton iterations of all runs"),
    "work_fixed": ("1", "segments times Newton iterations of the cheapest run"),
}
