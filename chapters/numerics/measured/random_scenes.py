"""Random scenes: whether tolerances are met, how well errors are estimated, and at which cost.

Scenes are sampled from the inputs that papers do not specify and from the ranges of their studies. Half of
the scenes are held out: they must not be used to tune the refinement. The seed fixes the list, so that the
reference of each scene can be stored; it was computed by the fourth-order method. The work is compared with
the work of the cheapest uniform mesh and step whose error is no larger, which a user cannot know beforehand.
Uniform meshes and steps that were tried for the reference are stored with it; the first of them that should
meet this condition is rerun.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from chapters.numerics.attempt import attempt, attempt_on, errors, in_time
from chapters.numerics.fixed_step import freed, stepped, whole
from chapters.numerics.models import Family, RandomStudy, in_tier
from chapters.numerics.outcome import Outcome
from chapters.numerics.reference.check import with_recomputed
from chapters.numerics.reference.converge import SMOOTH, converged, none
from chapters.numerics.reference.kept import Kept
from chapters.numerics.reference.store import NotUsed, Wanted, read
from chapters.numerics.references import QUANTITIES, by_run
from riserstudy.dataset.describe import label_variables
from riserstudy.dataset.result import Result
from riserstudy.model.mesh import even
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.scene.origin import Origin
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.refine import run
from riserstudy.simulation.starting_mesh import massless, period
from riserstudy.study.measured import Setting
from riserstudy.study.processes import each
from riserstudy.study.sampling import sample

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.records.facts import RunFacts
    from riserstudy.study.axes import Tier

WHERE = "config/studies/numerics.yaml: measured.random_scenes"
STUDY = "random_scenes"  # folder of references
QUICK = replace(SMOOTH, most_first=1e7)  # cheaper first refinement: there are many scenes
LONGEST = 30.0  # s, longest run to the tolerance for which a reference is computed
LEVELS = tuple(2.0 ** (k / 2) for k in range(24))  # factors on mesh and step, from coarse to fine
COARSE = 6  # segments, and steps per period, of the first level
CHEAPEST = 32.0  # the search begins at the work of the request divided by this factor
FALLEN = 0.9  # refinement continues only if the error decreases to this share of it

#: function that returns the errors of a result by quantity
Measure = Callable[[Result], dict[str, float]]


class Even(NamedTuple):
    """A uniform mesh and a step that were tried: largest error, and work in segments times iterations."""

    elements: int
    step: float  # s
    error: float
    work: float


@dataclass
class Drawn:
    """A random scene: its sampled values, and its results.

    ``message``: why it is not judged; ``refused``: whether because the engine refuses it.
    """

    family: str
    number: int
    held_out: bool
    sets: dict[str, Any]
    file: SceneFile
    message: str = ""
    refused: bool = False
    requested: Result | None = None
    true: dict[str, float] = field(default_factory=dict)
    fixed: Even | None = None  # the cheapest with no larger error

    @property
    def name(self) -> str:
        """Family and number."""
        return f"{self.family} {self.number}"


def random_scenes(study: RandomStudy, setting: Setting) -> xr.Dataset:
    """Run every scene to the tolerance, and measure the true error and the work."""
    every = drawn(study, setting.config, setting.tier)
    patience = study.patience[setting.tier]
    one = partial(judge, setting.config, patience, setting.tier == "reference")
    dataset = tabulated(study, list(each(one, every, setting.threads)))
    return with_recomputed(dataset, setting, study.references, wanted(study, setting.config))


def drawn(study: RandomStudy, config: Path, tier: Tier) -> list[Drawn]:
    """Return the scenes of a tier."""
    families = in_tier(study.families, tier).items()
    return [one for item in families for one in draw(*item, study, config, tier)]


def draw(name: str, family: Family, study: RandomStudy, config: Path, tier: Tier) -> Iterator[Drawn]:
    """Yield the scenes of a family: assumed and varied values from a seeded Sobol sequence."""
    where = f"{WHERE}: {name}"
    base = freed(config / family.scene, family.set, where)
    open_values = {
        path: origin
        for path, origin in base.origins.items()
        if origin.status == "assumed" and (origin.range or origin.options)
    }
    for path, (low, high) in family.vary.items():
        open_values[path] = Origin("assumed", low, range=(low, high))
    for k, sets in enumerate(sample(open_values, study.count[tier], study.seed)):
        requested = {"analysis.accuracy": study.accuracy}
        file = base.with_values(sets, where).with_values(requested, where)
        yield Drawn(name, k, k % 2 == 1, sets, file)


def judge(config: Path, patience: float, anew: bool, one: Drawn) -> Drawn:
    """Run to the tolerance; find the true error, and the cheapest uniform mesh and step with no larger one.

    A run that takes more than ``patience`` (s) is not judged.

    Parameters
    ----------
    anew : whether to search the cheapest without the stored meshes and steps.
    """
    scene = whole(one.file.resolved())
    try:
        kept = read(config, STUDY, one.name, scene)
    except NotUsed as error:
        one.message = f"reference: {error}"
        return one
    attempt(lambda: run(scene, 0.0))  # loads kernels, which must not be timed
    tried = attempt(lambda: in_time(scene, patience))
    if tried.result is None:
        one.message, one.refused = tried.message, tried.refused is not Outcome.TOO_LONG
        return one
    if kept.result is None:
        one.message = kept.missing
        return one
    one.requested = tried.result
    one.true = errors(tried.result, kept.result)
    known = [] if anew else [Even(*row) for row in kept.more["even"]]
    one.fixed = least_work(one, scene, by_run(kept.result).errors, known)
    one.requested = replace(tried.result, arrays={})  # only the rest is sent between processes
    return one


def least_work(one: Drawn, scene: Resolved, measure: Measure, known: list[Even]) -> Even | None:
    """Uniform mesh and step of least work whose error does not exceed the request's; None if none needs less.

    Parameters
    ----------
    known : meshes and steps tried before, cheapest first; their errors predict which will be sufficient.
    """
    achieved, spent = max(one.true.values(), default=0.0), spent_on(one)
    for even_one in known:
        if even_one.error <= achieved and even_one.work <= spent:
            again = tried_on(one.file, scene, measure, even_one.elements, even_one.step)
            if again and again.error <= achieved:
                return again
    if known:
        return None
    found = search(one.file, scene, measure, spent, achieved)
    return found[-1] if found and found[-1].error <= achieved else None


def search(file: SceneFile, scene: Resolved, measure: Measure, spent: float, achieved: float) -> list[Even]:
    """Try uniform meshes and steps, cheapest first, until an error does not exceed ``achieved``; return them.

    A mesh is not tried further when shorter steps no longer reduce its error enough, nor a step when finer
    meshes do not.
    """
    duration = scene.analysis.duration or 0.0
    last: dict[tuple[str, float], float] = {}
    exhausted: set[tuple[str, float]] = set()
    found: list[Even] = []
    for work, n, step in by_work(scene):
        levels = {("segments", float(n)), ("step", step)}
        if work * duration < spent / CHEAPEST or levels & exhausted:
            continue
        if work * duration > spent:
            break
        one = tried_on(file, scene, measure, n, step)
        if one is None:
            continue
        found.append(one)
        if one.error <= achieved:
            break
        exhausted |= {level for level in levels if one.error > FALLEN * last.get(level, math.inf)}
        last |= dict.fromkeys(levels, one.error)
    return found


def tried_on(file: SceneFile, scene: Resolved, measure: Measure, elements: int, step: float) -> Even | None:
    """Error and work of a uniform mesh and a step; None if they cannot be run."""
    mesh = even(scene, elements)
    tried = attempt_on(stepped(file, {}, mesh, step), mesh, step, math.inf)
    if tried.result is None:
        return None
    error = max(measure(tried.result).values(), default=0.0)
    return Even(elements, step, error, _work(tried.result.facts))


def by_work(scene: Resolved) -> Iterator[tuple[float, int, float]]:
    """Work (segments divided by step, 1/s), segments of uniform meshes, and steps (s), cheapest first."""
    counts = [len(scene.riser)] if massless(scene) else [round(COARSE * x) for x in LEVELS]
    steps = [period(scene) / (COARSE * x) for x in LEVELS]
    yield from sorted((n / step, n, step) for n in counts for step in steps)


def wanted(study: RandomStudy, config: Path) -> Iterator[Wanted]:
    """Yield the reference of every scene of the standard tier."""
    for one in drawn(study, config, "standard"):
        yield Wanted(one.name, one.file, partial(solved, one))


def solved(one: Drawn) -> Kept:
    """Compute the reference of a scene, with the uniform meshes and steps that the search tried."""
    scene = whole(one.file.resolved())
    first = attempt(lambda: in_time(scene, LONGEST))
    if first.result is None:
        return none(one.name, one.file, first.message)
    kept = converged(one.name, one.file, first.result, QUICK)
    if kept.result is None:
        return kept
    measure = by_run(kept.result).errors
    one.requested = first.result
    achieved = max(measure(first.result).values(), default=0.0)
    found = search(one.file, scene, measure, spent_on(one), achieved)
    return replace(kept, more={"even": [list(row) for row in found]})


def spent_on(one: Drawn) -> float:
    """Segments times iterations, summed over all runs of a request."""
    return sum(map(_work, one.requested.facts["refinements"])) if one.requested else 0.0


def _work(facts: Mapping[str, Any]) -> float:
    """Segments times Newton iterations: a measure of work without the noise of timing."""
    return float(facts["elements"]) * float(facts["newton_iterations"])


def tabulated(study: RandomStudy, drawn: list[Drawn]) -> xr.Dataset:
    """Return all scenes as one dataset; the row of a scene that cannot be run has its message."""
    import xarray as xr

    data: dict[str, Any] = {
        "family": [one.family for one in drawn],
        "held_out": [one.held_out for one in drawn],
        "sets": [json.dumps(one.sets) for one in drawn],
        "message": [one.message for one in drawn],
        "is_refused": [one.refused for one in drawn],
    }
    for kind in ("true", "estimated"):
        errors = [_estimated(one) if kind == "estimated" else one.true for one in drawn]
        for q in QUANTITIES:
            data[f"{kind}_{q}"] = [of.get(q, math.nan) for of in errors]
        data[kind] = [max(of.values(), default=math.nan) for of in errors]
    none: RunFacts = {}
    facts = [one.requested.facts if one.requested else none for one in drawn]
    data["elements"] = [f.get("elements", 0) for f in facts]
    data["step"] = [f.get("step", math.nan) for f in facts]
    data["runs"] = [len(f.get("refinements", [])) for f in facts]
    data["warnings"] = ["\n".join(sentences(f.get("warnings", []))) for f in facts]
    data["fixed_elements"] = [one.fixed.elements if one.fixed else 0 for one in drawn]
    for name in ("step", "error", "work"):
        values = [getattr(one.fixed, name) if one.fixed else math.nan for one in drawn]
        data["work_fixed" if name == "work" else f"fixed_{name}"] = values
    data["work_asked"] = [spent_on(one) or math.nan for one in drawn]
    dataset = xr.Dataset({name: ("drawn", values) for name, values in data.items()})
    dataset = dataset.assign_coords(drawn=[one.name for one in drawn])
    label_variables(dataset, ABOUT)
    dataset.attrs = {"requested": study.share}
    return dataset


def _estimated(one: Drawn) -> dict[str, float]:
    """Estimated errors of the quantities whose true error is known."""
    estimate = one.requested.facts["error_estimate"] if one.requested else {}
    return {q: estimate[q] for q in one.true if q in estimate}


ABOUT = {
    **{f"true_{q}": ("1", f"true error of {q}") for q in QUANTITIES},
    **{f"estimated_{q}": ("1", f"estimated error of {q}") for q in QUANTITIES},
    "true": ("1", "largest true error"),
    "estimated": ("1", "largest estimated error"),
    "elements": ("1", "segments that the program chose"),
    "step": ("s", "time step that the program chose"),
    "runs": ("1", "runs until the tolerance was met"),
    "fixed_elements": ("1", "equal segments of the cheapest run with at most this error"),
    "fixed_step": ("s", "its time step"),
    "fixed_error": ("1", "its error"),
    "work_asked": ("1", "segments times Newton iterations of all runs"),
    "work_fixed": ("1", "segments times Newton iterations of the cheapest run"),
}
