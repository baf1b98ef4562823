"""Run time of accuracy: errors and elapsed times of every method on a ladder of meshes and steps.

In addition, runs to tolerances: the tolerance, the estimated error, the true error and the elapsed time.
"""

from __future__ import annotations

import math
import statistics
import time as clock
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import psutil

from chapters.numerics.attempt import Attempt, attempt, attempt_on, in_time, too_long
from chapters.numerics.fixed_step import freed, stepped, whole
from chapters.numerics.measured.stability import attempt_limit
from chapters.numerics.models import AccuracyStudy, Ladder, Method, in_tier
from chapters.numerics.outcome import Outcome
from chapters.numerics.outside import RADAU, outside
from chapters.numerics.reference.check import with_recomputed
from chapters.numerics.reference.store import Wanted
from chapters.numerics.references import OPINIONS, QUANTITIES, Reference, differences, reference, solved
from riserstudy.dataset.describe import label_variables
from riserstudy.dataset.result import Result
from riserstudy.model.mesh import Mesh, even
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.refine import run
from riserstudy.study.measured import Setting

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.study.axes import Tier


COSTS = ("wall_seconds", "wall_seconds_min", "cpu_seconds", "newton_iterations", "steps", "step", "elements")
EXPLICIT = "explicit"
SOON = 1.0  # s, time of a run to a tolerance below which it is timed a second time
SETTLED = 0.1  # relative change of an error, up to which a shorter step does not help
ENOUGH = 2.0  # s, total time of the runs of a rung after which it is not repeated
WHERE = "config/studies/numerics.yaml: measured.accuracy"


def accuracy(study: AccuracyStudy, setting: Setting) -> xr.Dataset:
    """Run all scenes with all methods: a dataset over scene, method, mesh and step of the ladder."""
    import xarray as xr

    scenes, methods = in_tier(study.scenes, setting.tier), in_tier(study.methods, setting.tier)
    most = [max(len(getattr(s, way)) for s in scenes.values()) for way in ("elements", "steps")]
    shape = (len(scenes), len(methods), *most)
    value: dict[str, Any] = {
        name: np.full(shape, np.nan) for name in (*COSTS, *(f"error_{q}" for q in QUANTITIES))
    }
    value["message"] = np.full(shape, "", object)
    opinion = np.full((len(scenes), len(OPINIONS), len(QUANTITIES)), np.nan)
    change = np.full((len(scenes), len(QUANTITIES)), np.nan)
    about: list[str] = []
    requested: list[dict[str, Any]] = []
    for i, (name, ladder) in enumerate(scenes.items()):
        file = scene_of(setting.config, name, ladder)
        met = requests(file, name, study.requested[setting.tier], study.patience)
        best = reference(file, name, ladder, setting.config)
        others = differences(best, file, ladder) if setting.tier == "reference" else {}
        about.append(best.about)
        change[i] = [best.change.get(q, np.nan) for q in QUANTITIES]
        for other, values in others.items():
            opinion[i, OPINIONS.index(other)] = [values.get(q, np.nan) for q in QUANTITIES]
        for j, method in enumerate(methods.values()):
            climb = Climb(file, method, ladder, best, study, setting.tier)
            for k in range(len(ladder.elements)):
                for m in range(most[1]):
                    tried = climb.rung(k, m)
                    value["message"][i, j, k, m] = tried.message
                    if tried.result is None:
                        continue
                    for q, error in climb.errors.items():
                        value[f"error_{q}"][i, j, k, m] = error
                    for cost in COSTS:
                        value[cost][i, j, k, m] = tried.result.facts.get(cost, np.nan)
        requested += [judged(one, best) for one in met]
    dims = ("scene", "method", "mesh_level", "step_level")
    data: dict[str, Any] = {
        name: (dims, array.astype(str) if array.dtype == object else array) for name, array in value.items()
    }
    data["opinion_difference"] = (("scene", "opinion", "quantity"), opinion)
    data["reference"] = ("scene", about)
    data["reference_change"] = (("scene", "quantity"), change)
    data |= peers(study, list(scenes))
    for name in requested[0] if requested else ():
        data[name] = ("request", [row[name] for row in requested])
    dataset = xr.Dataset(
        data,
        {"scene": list(scenes), "method": list(methods), "opinion": list(OPINIONS)}
        | {"quantity": list(QUANTITIES)},
    )
    label_variables(dataset, {name: of for name, of in ABOUT.items() if name in dataset})
    dataset.attrs["load_average"] = psutil.getloadavg()[0]
    return with_recomputed(dataset, setting, study.references, wanted(study, setting.config))


def scene_of(config: Path, name: str, ladder: Ladder) -> SceneFile:
    """Read the scene of a ladder, without mesh, step and method."""
    return freed(config / ladder.scene, ladder.set, f"{WHERE}: {name}")


def wanted(study: AccuracyStudy, config: Path) -> Iterator[Wanted]:
    """Yield the reference of every scene for which no history of another code is stored."""
    for name, ladder in study.scenes.items():
        if not ladder.stored:
            file = scene_of(config, name, ladder)
            yield Wanted(name, file, partial(solved, name, file, ladder))


def peers(study: AccuracyStudy, scenes: list[str]) -> dict[str, Any]:
    """Run-time ratios of other simulators from the study file, one row per error."""
    rows = [
        (scene, peer, error, ratio)
        for scene in scenes
        for peer, known in study.peers.get(scene, {}).items()
        for error, ratio in known
    ]
    names = ("peer_scene", "peer", "peer_error", "peer_ratio")
    columns = zip(*rows, strict=True) if rows else ([] for _ in names)
    return {name: ("measured", list(of)) for name, of in zip(names, columns, strict=True)}


class Climb:
    """A method on the rungs of a scene, mesh by mesh, and from long to short time steps.

    After a step took too long, it and shorter ones are omitted on this mesh and on finer ones. Except in the
    reference tier, further steps are omitted on a mesh on which a shorter step no longer changed the error.
    Omitted runs cannot be on the lower edge of error against time.
    """

    def __init__(
        self,
        file: SceneFile,
        method: Method,
        ladder: Ladder,
        best: Reference,
        study: AccuracyStudy,
        tier: Tier,
    ):
        self.file, self.method, self.ladder, self.best = file, method, ladder, best
        self.budget, self.repeats = study.budget, study.repeats[tier]
        self.whole = tier == "reference"
        self.errors: dict[str, float] = {}
        self._given_up: tuple[float, str] = (math.inf, "")  # longest step that took too long, by number
        self._last: dict[int, float] = {}  # largest error by mesh
        self._settled: set[int] = set()  # meshes
        self._warm = False

    def rung(self, k: int, m: int) -> Attempt:
        """Run and time a mesh and a step; its errors are stored in ``errors``."""
        longest, because = self._given_up
        if m >= longest:
            return Attempt(None, None, f"on a coarser mesh, or with a longer time step: {because}", 0.0)
        if k in self._settled:
            return Attempt(None, None, "on this mesh, a longer time step has the same error", 0.0)
        one = rung(self.file, self.method, self.ladder, (k, m), self.budget, self.repeats, self._warm)
        if one.refused == Outcome.TOO_LONG:
            self._given_up = (m, one.message)
        if one.result is not None:
            self._warm = True
            self.errors = self.best.errors(one.result)
            self._see(k, max(self.errors.values(), default=np.nan))
        return one

    def _see(self, k: int, error: float) -> None:
        """Note whether shorter steps can still reduce the error on a mesh."""
        last = self._last.get(k, np.inf)
        if not self.whole and abs(error - last) <= SETTLED * last < np.inf:
            self._settled.add(k)
        self._last[k] = error


def rung(
    file: SceneFile,
    method: Method,
    ladder: Ladder,
    at: tuple[int, int],
    budget: float,
    repeats: int,
    warm: bool,
) -> Attempt:
    """Run one rung, timed several times; the explicit method has one step, 0.9 of its stable one."""
    k, m = at
    steps = method.tolerances or ladder.steps
    if m >= len(steps):
        return Attempt(None, None, "no such rung", 0.0)
    mesh = even(whole(file.resolved()), ladder.elements[k])
    own = stepped(file, method.set, mesh, ladder.steps[-1] if method.tolerances else steps[m])
    step = steps[m]
    if method.set.get("analysis.method") == EXPLICIT and not method.tolerances:
        if m > 0:
            return Attempt(None, None, "one step alone", 0.0)
        limit = attempt_limit(own, mesh)
        step = 0.9 * limit if limit else step
    return timed(lambda: once(own, mesh, step, method, budget), repeats, warm)


def once(scene: Resolved, mesh: Mesh, step: float, method: Method, budget: float) -> Attempt:
    """Make one run with a method of the engine or from outside."""
    which = method.integrator
    if which is None or (which != RADAU and too_long(scene, mesh, step, budget)):
        return attempt_on(scene, mesh, step, budget)
    return attempt(lambda: outside(scene, mesh, which, step))


def timed(one: Callable[[], Attempt], repeats: int, warm: bool) -> Attempt:
    """Return the last of several runs, with the median and the minimum of their elapsed times (s).

    CPU time is included because it is less affected by other programs on the machine.

    Parameters
    ----------
    warm : whether kernels are loaded; if not, a first run, whose elapsed time is not counted, loads them.
    """
    walls, own = [], []
    for _ in range(repeats + (not warm)):
        started, begun = clock.perf_counter(), clock.thread_time()
        tried = one()
        walls.append(clock.perf_counter() - started)
        own.append(clock.thread_time() - begun)
        if tried.result is None:
            return tried
        if sum(walls) > ENOUGH:
            break
    measured = walls if warm else walls[1:] or walls
    if tried.result is not None:
        facts = tried.result.facts
        facts |= {"wall_seconds": statistics.median(measured), "wall_seconds_min": min(measured)}
        facts["cpu_seconds"] = min(own)
    return tried


class Request(NamedTuple):
    """Result for one tolerance: a row of the dataset, and the run, which is None if it was refused."""

    row: dict[str, Any]
    result: Result | None
    refused: Outcome | None


def requests(file: SceneFile, name: str, shares: Iterable[float], patience: float) -> list[Request]:
    """Results for finer and finer tolerances; after one takes too long, finer ones count as too long."""
    met: list[Request] = []
    for share in sorted(shares, reverse=True):
        if met and met[-1].refused == Outcome.TOO_LONG:
            met.append(met[-1]._replace(row=met[-1].row | {"requested": share}))
        else:
            met.append(spent(file, name, share, patience))
    return met


def spent(file: SceneFile, name: str, share: float, patience: float) -> Request:
    """Run a scene to a tolerance in at most ``patience`` (s); of two short runs, keep the faster one."""
    scene = whole(file.with_values({"analysis.accuracy": f"{100 * share!r} %"}, WHERE).resolved())
    attempt(lambda: run(scene, 0.0))  # loads kernels
    tried = attempt(lambda: in_time(scene, patience))
    if tried.result is not None and tried.seconds < SOON:
        tried = min(tried, attempt(lambda: run(scene)), key=lambda one: one.seconds)
    row: dict[str, Any] = {"request_scene": name, "requested": share, "request_seconds": np.nan}
    row["request_last_seconds"] = np.nan
    row |= {f"{kind}_{q}": np.nan for kind in ("estimated", "reached") for q in QUANTITIES}
    row |= {"request_elements": 0, "request_step": np.nan, "request_message": tried.message}
    if tried.result is None:
        return Request(row, None, tried.refused)
    facts = tried.result.facts
    row |= {"request_seconds": tried.seconds, "request_elements": facts["elements"]}
    row["request_step"] = facts.get("step", np.nan)
    row["request_last_seconds"] = facts["refinements"][-1]["solve_seconds"]
    row |= {f"estimated_{q}": facts["error_estimate"].get(q, np.nan) for q in QUANTITIES}
    return Request(row, tried.result, None)


def judged(one: Request, best: Reference) -> dict[str, Any]:
    """Return the row of a request with its true errors."""
    reached = best.errors(one.result) if one.result else {}
    return one.row | {f"reached_{q}": reached[q] for q in QUANTITIES if q in reached}


ABOUT = {
    "wall_seconds": ("s", "median elapsed time of a run, without compilation"),
    "wall_seconds_min": ("s", "shortest elapsed time of a run"),
    "cpu_seconds": ("s", "shortest CPU time of a run"),
    "newton_iterations": ("1", "Newton iterations; of Radau, evaluations of the forces"),
    "steps": ("1", "time steps"),
    "step": ("s", "time step; of Radau, the mean of its own"),
    "elements": ("1", "segments"),
    **{f"error_{q}": ("1", f"error of the {q} history over its largest value") for q in QUANTITIES},
    "reference_change": ("1", "change of riserstudy's reference solution by its last refinement"),
    "opinion_difference": ("1", "difference of fine runs by other methods from the reference"),
    "peer_error": ("1", "error of displacement of another simulator"),
    "peer_ratio": ("1", "its time divided by the time of riserstudy's cheapest run with the same error"),
    "requested": ("1", "tolerance"),
    "request_seconds": ("s", "elapsed time of all runs for a tolerance"),
    "request_last_seconds": ("s", "elapsed time of the last of these runs"),
    "request_elements": ("1", "segments that the program chose"),
    "request_step": ("s", "time step that the program chose"),
}
