"""Hard cases by every method over a ladder of steps: which runs finish, which are accurate, their messages.

The step that the default accuracy chooses is the middle of the ladder; methods run on the mesh that it
chooses. A ladder is searched by bisection, but in the reference tier all its steps are run. The reference
of a case is stored. It was computed with another spectral radius, from this mesh and step, by halving both
until the result changed little; the change by the last halving indicates the error of the reference.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from chapters.numerics.attempt import ACCURATE_TO, Attempt, attempt, attempt_on, judged, mesh_of
from chapters.numerics.fixed_step import FREE, stepped, whole
from chapters.numerics.models import Case, Method, StabilityStudy, case_file, in_tier
from chapters.numerics.outcome import Outcome
from chapters.numerics.reference.check import with_recomputed
from chapters.numerics.reference.converge import HARD, converged, none
from chapters.numerics.reference.kept import Kept
from chapters.numerics.reference.store import NotUsed, Wanted, read
from riserstudy.dataset.describe import label_variables
from riserstudy.dataset.result import Result
from riserstudy.errors import InputError
from riserstudy.model.mesh import Mesh, even
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.error_estimate import deciding
from riserstudy.simulation.refine import run
from riserstudy.simulation.stable_step import explicit_limit
from riserstudy.study.measured import Setting
from riserstudy.study.processes import each

if TYPE_CHECKING:
    from pathlib import Path

    import xarray as xr

    from riserstudy.study.axes import Tier

STUDY = "stability"  # folder of references
EXPLICIT = "explicit"
WRITTEN = "as written"  # the scene's own method and accuracy


@dataclass
class Rung:
    """One run of a ladder, which is a series of increasing time steps."""

    step: float
    outcome: Outcome
    error: float
    tried: Attempt

    @property
    def survived(self) -> bool:
        """Whether the run finished with plausible values."""
        return self.outcome in (Outcome.ACCURATE, Outcome.INACCURATE, Outcome.UNJUDGED)


@dataclass
class Standard:
    """The reference that the runs of a case are compared with."""

    reference: Result | None = None
    doubt: float = math.nan  # change by the reference's last refinement
    why_not: str = ""


@dataclass
class CaseResult:
    """Results for one case by every method."""

    written: Rung
    estimate: float
    warned: str
    standard: Standard
    explicit_limit: float = math.nan  # predicted stable step (s), if explicit stepping is tried
    rungs: dict[str, list[Rung]] = field(default_factory=dict)


def run_case(
    study: StabilityStudy, case: Case, file: SceneFile, tier: Tier, standard: Standard
) -> CaseResult:
    """Run one case by every method."""
    scene = file.resolved()
    tried = attempt(lambda: run(whole(scene)))
    outcome, error = judged(tried, standard.reference)
    if tried.result and case.expect == "unstable":
        outcome, error = Outcome.MISSED, math.nan
    facts = tried.result.facts if tried.result else {}
    estimate = deciding(facts.get("error_estimate", {}))
    written = Rung(facts.get("step", math.nan), outcome, error, tried)
    result = CaseResult(written, estimate, "\n".join(sentences(facts.get("warnings", []))), standard)
    on = chosen(scene, tried)
    if on is None or outcome in (Outcome.UNSTABLE, Outcome.MISSED):
        return result
    for name, method in in_tier(study.methods, tier).items():
        result.rungs[name] = rungs(study, method, file, on, tier, result)
    return result


class Chosen(NamedTuple):
    """Mesh and step (s) that methods are run with; ``alone`` if the scene prescribes the mesh."""

    mesh: Mesh
    step: float
    alone: bool


def chosen(scene: Resolved, written: Attempt) -> Chosen | None:
    """Return the prescribed mesh and step of a scene, or the ones that its run chose; None without any."""
    own, result = scene.analysis, written.result
    if own.mesh and own.step:
        return Chosen(even(scene, own.mesh.elements), own.step, True)
    if result is None or "step" not in result.facts:
        return None
    return Chosen(mesh_of(scene, result), result.facts["step"], own.mesh is not None)


def rungs(
    study: StabilityStudy, method: Method, file: SceneFile, on: Chosen, tier: Tier, result: CaseResult
) -> list[Rung]:
    """Run a case by a method; for explicit stepping, also store the predicted limit of the step."""
    explicit = method.set.get("analysis.method") == EXPLICIT
    steps = [on.step] if on.alone else [on.step * factor for factor in study.ladder[tier]]
    try:
        own = stepped(file, method.set, on.mesh, steps[0])
    except InputError as error:  # a method that such scenes do not have
        none = Attempt(None, Outcome.REFUSED, str(error), 0.0)
        return [Rung(math.nan, Outcome.REFUSED, math.nan, none)]
    if explicit and not on.alone:
        limit = attempt_limit(own, on.mesh)
        result.explicit_limit = limit or math.nan
        steps = [limit * factor for factor in study.explicit_ladder] if limit else []
    budget = study.explicit_budget if explicit else study.budget
    known = result.standard.reference
    one = partial(rung, own, on.mesh, budget=budget, reference=known)
    return [one(h) for h in steps] if tier == "reference" else climbed(one, steps)


def climbed(one: Callable[[float], Rung], steps: Sequence[float]) -> list[Rung]:
    """Find the largest accurate and the largest surviving step by bisection; return all rungs tried.

    Parameters
    ----------
    one : function that runs a step (s).
    steps : increasing (s). The step of a run that would take too long counts as too short to be of interest.
    """
    tried: dict[int, Rung] = {}
    for good in (lambda r: r.outcome == Outcome.ACCURATE, lambda r: r.survived):
        low, high = -1, len(steps)
        while high - low > 1:
            k = (low + high + 1) // 2
            if k not in tried:
                tried[k] = one(steps[k])
            if good(tried[k]) or tried[k].outcome == Outcome.TOO_LONG:
                low = k
            else:
                high = k
    return [tried[k] for k in sorted(tried)]


def attempt_limit(scene: Resolved, mesh: Mesh) -> float | None:
    """Predicted stable step (s); None unless it is positive and finite."""
    limit = explicit_limit(scene, settle(scene, mesh)[0])
    return limit if 0.0 < limit < math.inf else None


def rung(scene: Resolved, mesh: Mesh, step: float, *, budget: float, reference: Result | None) -> Rung:
    """Make one run of a ladder, and determine its outcome."""
    tried = attempt_on(scene, mesh, step, budget)
    return Rung(step, *judged(tried, reference), tried)


def standard_of(config: Path, name: str, scene: Resolved) -> Standard:
    """Read the stored reference of a case; if it cannot be used, return the reason."""
    try:
        kept = read(config, STUDY, name, scene)
    except NotUsed as error:
        return Standard(why_not=str(error))
    if kept.result is None:
        return Standard(why_not=kept.missing)
    doubt = deciding(kept.error)
    if not doubt <= ACCURATE_TO:
        return Standard(doubt=doubt, why_not=f"two fine runs differ by {100 * doubt:.2g} %")
    return Standard(kept.result, doubt)


def wanted(study: StabilityStudy, config: Path) -> Iterator[Wanted]:
    """Yield the reference of every case."""
    for name, case in study.cases.items():
        file = case_file(config, name, case)
        yield Wanted(name, file, partial(solved, name, file))


def solved(name: str, file: SceneFile) -> Kept:
    """Compute the reference of a case, from the mesh and step that the default accuracy chooses."""
    free = file.with_values(FREE, "reference") if file.resolved().analysis.mesh is not None else file
    first = attempt(lambda: run(whole(free.resolved())))
    if first.result is None:
        return none(name, file, first.message)
    return converged(name, free, first.result, HARD)


def as_expected(case: Case, result: CaseResult) -> tuple[bool, str]:
    """Return whether a case ended as expected of a sound engine; if not, also its outcome in words."""
    outcome, error = result.written.outcome, result.written.error
    if case.expect == "accurate":
        if outcome == Outcome.ACCURATE:
            return True, ""
        why = result.written.tried.message or result.standard.why_not
        return False, f"{outcome}: {why or f'error {100 * error:.2g} %'}"
    if case.expect == "unstable":
        return outcome == Outcome.UNSTABLE, "" if outcome == Outcome.UNSTABLE else str(outcome)
    if outcome in (Outcome.REFUSED, Outcome.UNSTABLE, Outcome.ACCURATE):
        return True, ""
    warned_so = result.estimate > ACCURATE_TO or bool(result.warned)
    words = f"error {100 * error:.2g} %, estimated {100 * result.estimate:.2g} %"
    return warned_so, "" if warned_so else f"{outcome} and not said: {words}"


def stability(study: StabilityStudy, setting: Setting) -> xr.Dataset:
    """Run all cases: a dataset over case, method and rung of the ladder."""
    cases = in_tier(study.cases, setting.tier)
    one = partial(_case_result, study, setting.config, setting.tier)
    outcomes = dict(zip(cases, each(one, list(cases.items()), setting.threads), strict=True))
    dataset = tabulated(study, cases, outcomes, setting.tier)
    return with_recomputed(dataset, setting, study.references, wanted(study, setting.config))


def _case_result(study: StabilityStudy, config: Path, tier: Tier, item: tuple[str, Case]) -> CaseResult:
    file = case_file(config, *item)
    return run_case(study, item[1], file, tier, standard_of(config, item[0], file.resolved()))


def tabulated(
    study: StabilityStudy, cases: dict[str, Case], results: dict[str, CaseResult], tier: Tier
) -> xr.Dataset:
    """Return the results of all cases as a labelled dataset."""
    import xarray as xr

    methods = list(in_tier(study.methods, tier))
    most = max(len(study.ladder[tier]), len(study.explicit_ladder))
    shape = (len(cases), len(methods), most)
    number = {name: np.full(shape, np.nan) for name in ("step", "error", "wall_seconds", *COUNTS)}
    word = {name: np.full(shape, "", object) for name in ("rung_outcome", "rung_message")}
    best: dict[str, Any] = {name: np.full(shape[:2], np.nan) for name in BEST}
    best["outcome"] = np.full(shape[:2], str(Outcome.NOT_RUN), object)
    best["message"] = np.full(shape[:2], "", object)
    for i, of_case in enumerate(results.values()):
        for j, method in enumerate(methods):
            rungs = of_case.rungs.get(method, [])
            for name, value in (summed_up(rungs) if rungs else unrun(of_case)).items():
                best[name][i, j] = value
            for k, r in enumerate(rungs):
                at = (i, j, k)
                number["step"][at], number["error"][at] = r.step, r.error
                number["wall_seconds"][at] = r.tried.seconds
                for name, value in counted(r.tried).items():
                    number[name][at] = value
                word["rung_outcome"][at], word["rung_message"][at] = r.outcome, r.tried.message
    dims = ("case", "method", "rung")
    data: dict[str, Any] = {name: (dims, values) for name, values in number.items()}
    data |= {name: (dims, values.astype(str)) for name, values in word.items()}
    for name, values in best.items():
        data["best_" + name if name in COUNTS else name] = (
            dims[:2],
            values.astype(str) if values.dtype == object else values,
        )
    data |= {name: ("case", values) for name, values in by_case(cases, results).items()}
    dataset = xr.Dataset(data, {"case": list(cases), "method": methods})
    label_variables(dataset, ABOUT)
    return dataset


def by_case(cases: dict[str, Case], results: dict[str, CaseResult]) -> dict[str, Any]:
    """Variables with one value per case: run of the unchanged scene, expected outcome, reference."""
    verdicts = [as_expected(case, results[name]) for name, case in cases.items()]
    written = [t.written for t in results.values()]
    runs = [w.tried.result for w in written]
    return {
        "about": [case.about for case in cases.values()],
        "family": [case.family for case in cases.values()],
        "expected": [case.expect for case in cases.values()],
        "as_expected": [met for met, _ in verdicts],
        "finding": [finding for _, finding in verdicts],
        "written_outcome": [str(w.outcome) for w in written],
        "written_message": [w.tried.message for w in written],
        "written_warnings": [t.warned for t in results.values()],
        "written_error": [w.error for w in written],
        "written_estimate": [t.estimate for t in results.values()],
        "written_step": [w.step for w in written],
        "written_elements": [len(r.arrays["l0"]) if r else 0 for r in runs],
        "written_seconds": [w.tried.seconds for w in written],
        "explicit_limit": [t.explicit_limit for t in results.values()],
        "reference_difference": [t.standard.doubt for t in results.values()],
        "reference_missing": [t.standard.why_not for t in results.values()],
    }


def summed_up(rungs: list[Rung]) -> dict[str, Any]:
    """Summary of a ladder: outcome, largest steps, and counts and energies at the best step."""
    survived = [r for r in rungs if r.survived]
    accurate = [r for r in rungs if r.outcome == Outcome.ACCURATE]
    ran = [r for r in rungs if r.outcome != Outcome.TOO_LONG]
    shortest = min(survived or ran or rungs, key=lambda r: r.step)
    taken = max(accurate, key=lambda r: r.step) if accurate else shortest
    return counted(taken.tried) | {
        "outcome": str(taken.outcome),
        "message": taken.tried.message,
        "largest_stable_step": max((r.step for r in survived), default=math.nan),
        "largest_accurate_step": max((r.step for r in accurate), default=math.nan),
        "smallest_error": min((r.error for r in rungs if r.error == r.error), default=math.nan),
        "best_seconds": taken.tried.seconds,
    }


def unrun(result: CaseResult) -> dict[str, Any]:
    """Outcome and message for methods that were not run."""
    if result.written.tried.refused == Outcome.UNSTABLE:
        return {"outcome": str(Outcome.UNSTABLE), "message": result.written.tried.message}
    return {"message": result.standard.why_not or "statics has no time steps"}


def _audit(name: str) -> Any:
    def share(facts: dict[str, Any]) -> float:
        audit = facts.get("audit", {})
        exchanged = audit.get("exchanged", 0.0)
        return float(abs(audit[name]) / exchanged) if exchanged > 0.0 else math.nan

    return share


def counted(tried: Attempt) -> dict[str, float]:
    """Counts and energies of a run; empty if it was refused."""
    if tried.result is None:
        return {}
    return {name: float(extract(tried.result.facts)) for name, extract in COUNTS.items()}


COUNTS: dict[str, Any] = {
    "newton_iterations": lambda f: f.get("newton_iterations", math.nan),
    "steps": lambda f: f.get("steps", math.nan),
    "halved_steps": lambda f: f.get("halved_steps", math.nan),
    "unexplained_energy": _audit("unexplained"),
    "numerical_dissipation": _audit("numerically_dissipated"),
}
BEST: Iterable[str] = (
    *COUNTS,
    "largest_stable_step",
    "largest_accurate_step",
    "smallest_error",
    "best_seconds",
)

ABOUT = {
    "step": ("s", "time step"),
    "error": ("1", "error of moment, or of tension and displacement, against the reference"),
    "wall_seconds": ("s", "elapsed time of a run, with other runs at the same time"),
    "largest_stable_step": ("s", "largest step at which the run completes"),
    "largest_accurate_step": ("s", "largest step accurate to 1 %"),
    "best_seconds": ("s", "elapsed time at the largest accurate step"),
    "best_unexplained_energy": ("1", "energy residual divided by the energy exchanged"),
    "best_numerical_dissipation": ("1", "share of the energy exchanged dissipated by the method"),
    "written_error": ("1", "error of the scene as written"),
    "written_estimate": ("1", "error estimated by the run itself"),
    "explicit_limit": ("s", "longest stable step of explicit stepping as predicted"),
    "reference_difference": ("1", "difference of the two finest runs"),
}
