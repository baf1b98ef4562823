"""Find the cheapest mesh, time step and method with which a study's points meet a tolerance.

Settings are tried on a few representative points. Their errors are differences from reference runs with
segments a quarter as long as in a run with the tolerance, plus the possible errors of the references. The
search follows the border between sufficient and insufficient settings, from long steps on fine meshes to
short steps on coarse meshes. Each method and kind of mesh takes about forty trials, most of which end at
their first point. The setting is then checked at other points. If it fails there, tuning is repeated with
these points included.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from riserstudy.dataset.result import Result
from riserstudy.errors import InputError, SimulationError
from riserstudy.model.mesh import Mesh
from riserstudy.records.numerals import percent
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.refine import run
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.run import single
from riserstudy.simulation.starting_mesh import massless
from riserstudy.simulation.tolerance import allowed_of
from riserstudy.study.corners import corners, others
from riserstudy.study.grid import Index
from riserstudy.study.setting import METHODS, Setting, layers_of, meshes, own_setting, steps
from riserstudy.study.study import Study

# largest assumed ratio of errors, from a run with the tolerance to segments a quarter as long
FALL = 6.0
ENOUGH = 0.9  # largest error at points for tuning, as a share of the tolerance
UNSURE = 0.4  # largest error of the reference run, as a share of the tolerance
ROUNDS = 4  # largest number of rounds of checks
TUNED = (None, *(method for method, _ in METHODS.values()))  # methods that may be replaced
OWN = ("mesh", "step", "method", "accuracy")  # keys of an analysis that tuning chooses
FREE = {f"analysis.{name}": None for name in OWN} | {"analysis.output.stations": None}
#: function that receives a description of the present run
Notify = Callable[[str], None]


@dataclass
class Place:
    """A point with its reference run, the errors of this run, and the work of a run with the tolerance."""

    index: Index
    file: SceneFile
    best: Result
    unsure: dict[str, float]
    work_of_request: float


@dataclass
class Tuned:
    """A setting with its error and cost.

    ``error``: largest ratio of error to tolerance at points for tuning; ``held_out``: the same at other
    points. ``work``: work relative to runs with the tolerance at each point. ``own``: the study's previous
    setting, its largest error and its work.
    """

    accuracy: str
    setting: Setting
    points: list[Index]
    checked: list[Index]
    error: float
    held_out: float
    work: float
    own: tuple[Setting, float, float] | None


def check_tunable(study: Study, count: int) -> None:
    """Refuse a study for which tuning is not useful.

    Raises InputError when its runs are static, its axes or solver prescribe the tuned settings, or it has few
    points.
    """
    where, analysis = study.where, study.base.tree.get("analysis") or {}
    if not isinstance(analysis, dict) or analysis.get("duration") is None:
        raise InputError(
            where,
            "analysis",
            "the runs are static, but only dynamic runs can be tuned",
            "run the study with a tolerance (analysis.accuracy)",
        )
    for name, tuned in (("solver", (None,)), ("method", TUNED)):
        if analysis.get(name) not in tuned:
            found = f"{analysis[name]!r} cannot be tuned"
            raise InputError(where, f"analysis.{name}", found, f"remove analysis.{name} to tune")
    own = [f"analysis.{name}" for name in (*OWN, "solver")]
    for axis, values in study.axes.items():
        for path in (path for _, sets in values for path in sets):
            if path == "analysis" or any(f"{path}.".startswith(f"{one}.") for one in own):
                found = f"sets {path}, which the tuning itself chooses"
                raise InputError(where, f"axes.{axis}", found, "tune a study without this axis")
    if (points := len(study.grid)) < 2 * count:
        found = f"the study has {points} points, fewer than twice the {count} points to tune on"
        raise InputError(
            where, "axes", found, "run the study with a tolerance (analysis.accuracy), or give fewer --points"
        )


def tune(study: Study, accuracy: str | None, count: int, seed: int, notify: Notify = lambda _: None) -> Tuned:
    """The cheapest setting that meets a tolerance at a few points, and at other points for the check.

    Raises InputError when there is nothing to tune, or the tolerance is invalid. Raises SimulationError when
    a reference run fails, or no setting suffices.

    Parameters
    ----------
    accuracy : tolerance, such as "1 %"; None: the tolerance of the study, or the default.
    count : number of points for tuning; half of this number, at least four, are used for the check.
    """
    check_tunable(study, count)
    tuner = Tuner(study, accuracy, notify)
    places = [tuner.place(index) for index in corners(study, count, seed)]
    seen: list[Index] = [one.index for one in places]
    for _ in range(ROUNDS):
        setting = tuner.least_work(places)
        fresh = others(study, seen, max(4, count // 2), seed)
        checks = [tuner.place(index) for index in fresh]
        found = [tuner.excess(setting, one) for one in checks]
        if max(found, default=0.0) <= 1.0:
            return tuner.worth(setting, places, checks)
        notify(f"{described(setting)} has an error of {max(found):.2f} times the tolerance at another point")
        seen += fresh
        places += checks
    raise SimulationError(
        f"{study.where}: {ROUNDS} attempts to tune failed, because errors at other points exceeded the "
        "tolerance; give more --points, or run the study with a tolerance (analysis.accuracy)"
    )


def described(setting: Setting) -> str:
    """A setting in words."""
    kind = "graded" if setting.layers else "even"
    return f"{setting.method}, {setting.elements} {kind} segments, {setting.step:g} s"


@dataclass
class Tuner:
    """A study and a tolerance, with all errors and work that were measured."""

    study: Study
    accuracy: str | None
    notify: Notify
    target: dict[str, float] = field(init=False)
    request: dict[str, str] = field(init=False)
    known: dict[tuple[Setting, Index], tuple[float, float]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        free = self.study.base.with_values(FREE, self.study.where)
        own = (self.study.base.tree.get("analysis") or {}).get("accuracy")
        wanted = self.accuracy or own
        self.request = {"analysis.accuracy": wanted} if wanted else {}
        self.target = allowed_of(free.with_values(self.request, "--accuracy").resolved())

    def place(self, index: Index) -> Place:
        """A point with its reference run.

        Raises SimulationError when this run cannot be completed, or is not accurate enough.
        """
        at = self.study.place(index)
        where = f"{self.study.where}: at {at}"
        self.notify(f"a run with the tolerance and a finer run at {at}")
        file = self.study.grid.file(index).with_values(FREE, "tune")
        scene = file.with_values(self.request, "--accuracy").resolved()
        try:
            refinement = Refinement(scene)
            requested = refinement.result()
            best = _finer(scene, refinement.finest_mesh, requested)
        except SimulationError as error:
            raise SimulationError(f"{where}: {error}") from None
        off = difference(requested, best)
        unsure = {name: value / FALL for name, value in off.items()}
        if self._over(requested.facts["error_estimate"]) > 1.0 or self._over(unsure) > UNSURE:
            found = f"estimated {_percent(requested.facts['error_estimate'])}, true {_percent(off)}"
            raise SimulationError(
                f"{where} a run with the tolerance has a larger error ({found}), so mesh and time step "
                "cannot be tuned; give a larger --accuracy"
            )
        work = sum(map(work_of, requested.facts["refinements"]))
        return Place(index, file, best, unsure, work)

    def _over(self, error: dict[str, float]) -> float:
        return max(error.get(name, 0.0) / limit for name, limit in self.target.items())

    @property
    def words(self) -> str:
        """The tolerance in words."""
        return str(self.request.get("analysis.accuracy") or _percent(self.target))

    def work(self, setting: Setting, places: list[Place]) -> float:
        """Sum over some points of segments times Newton iterations (1) with a setting."""
        return sum(self._tried(setting, place)[1] for place in places)

    def excess(self, setting: Setting, place: Place) -> float:
        """Ratio of error to tolerance (1) of a setting at a point; infinite if the run fails."""
        return self._tried(setting, place)[0]

    def _tried(self, setting: Setting, place: Place) -> tuple[float, float]:
        """Ratio of the largest possible error to the tolerance at a point, and segments times iterations."""
        key = (setting, place.index)
        if key not in self.known:
            try:
                result = run(place.file.with_values(setting.values, "tune").resolved(), estimated=False)
            except SimulationError:
                self.known[key] = (math.inf, math.inf)
            else:
                coarse, fine = sorted((result, place.best), key=lambda one: len(one.arrays["l0"]))
                error = difference(coarse, fine)
                sums = {name: off + place.unsure.get(name, 0.0) for name, off in error.items()}
                self.known[key] = (self._over(sums), work_of(result.facts))
        return self.known[key]

    def _suffices(self, setting: Setting, places: list[Place]) -> float:
        """Work of a setting that suffices at all points; infinite if it does not.

        A point at which a setting fails is tried first next time, because other settings probably fail there,
        too.
        """
        for k, place in enumerate(places):
            if self.excess(setting, place) > ENOUGH:
                places.insert(0, places.pop(k))
                return math.inf
        return self.work(setting, places)

    def least_work(self, places: list[Place]) -> Setting:
        """The setting of least work that suffices at all points.

        Raises SimulationError when no setting suffices.
        """
        scenes = [place.file.resolved() for place in places]
        own = self.own
        best: Setting | None = None
        # a setting with more work is not useful
        least = sum(place.work_of_request for place in places)
        if own and (work := self._suffices(own, places)) < least:
            best, least = own, work
        # twice as fine as the finest request
        counts = meshes(scenes, max(place.best.facts["elements"] for place in places) // 2)
        for layers in reversed(layers_of(scenes, own)):
            for method in reversed(METHODS):
                self.notify(f"{method} on {'graded' if layers else 'even'} meshes")
                every = [[Setting(n, layers, step, method) for step in steps(scenes)] for n in counts]
                found, work = self._along_border(every, places, least)
                if work < least:
                    best, least = found, work
        if best is None:
            raise SimulationError(
                f"{self.study.where}: no mesh, time step and method meets the tolerance at all points in "
                "less time than runs with the tolerance; run the study with analysis.accuracy"
            )
        return best

    @property
    def own(self) -> Setting | None:
        """The present setting of the study."""
        return own_setting(self.study.base.resolved())

    def _along_border(
        self, every: list[list[Setting]], places: list[Place], least: float
    ) -> tuple[Setting | None, float]:
        """The cheapest of settings, by mesh from coarse to fine and step from long to short, and its work.

        None if no setting needs less work than the best known one.
        """
        best, n, k = None, len(every) - 1, 0
        seconds = sum(place.file.resolved().analysis.duration or 0.0 for place in places)
        while n >= 0 and k < len(every[n]):
            setting, work = every[n][k], math.inf
            if setting.least_work * seconds < least:
                work = self._suffices(setting, places)
                if work == math.inf:
                    k += 1
                    continue
            if work < least:
                best, least = setting, work
            n -= 1
        return best, least

    def worth(self, setting: Setting, places: list[Place], checks: list[Place]) -> Tuned:
        """Error and cost of a setting, relative to runs with the tolerance and to the present setting."""
        requested = sum(place.work_of_request for place in places)
        work = self.work(setting, places)
        own = None
        if self.own:
            had = [self._tried(self.own, place) for place in places + checks]
            theirs = sum(one for _, one in had[: len(places)])
            own = self.own, max(off for off, _ in had), theirs / requested
        return Tuned(
            self.words,
            setting,
            [place.index for place in places],
            [place.index for place in checks],
            max(self.excess(setting, place) for place in places),
            max((self.excess(setting, place) for place in checks), default=0.0),
            work / requested,
            own,
        )


def _finer(scene: Resolved, mesh: Mesh, requested: Result) -> Result:
    """A fourth-order run with segments a quarter as long as in a run with the tolerance, and half its step.

    With events, the run with the tolerance already uses this method; the step is then a quarter. Raises
    SimulationError when it cannot be completed.
    """
    if not massless(scene):
        mesh = mesh.halved().halved()
    step = requested.facts["step"] * (0.25 if scene.events else 0.5)
    return single(scene.replaced(analysis=scene.analysis.replaced(method="ESDIRK4")), mesh, step)


def _percent(error: dict[str, float]) -> str:
    return ", ".join(f"{name} {percent(value)}" for name, value in error.items())


def work_of(spent: Mapping[str, Any]) -> float:
    """Segments times Newton iterations (1): a measure of cost that is the same on every machine."""
    return float(spent["elements"]) * float(spent["newton_iterations"])
