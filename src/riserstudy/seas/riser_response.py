"""What the limits of a riser ask for in sea states: runs of several seeds, stored point by point."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.limits import checked, label
from riserstudy.digests import engine_digest
from riserstudy.errors import InputError
from riserstudy.folders import remembered
from riserstudy.scene.limits import UNITS, Limit
from riserstudy.scene.load import SceneFile
from riserstudy.scene.tables import texts_of_tables
from riserstudy.seas.extremes import demand
from riserstudy.study import store
from riserstudy.study.grid import Point
from riserstudy.study.in_sea import Sea, phases_of, values_of
from riserstudy.study.setting import Setting
from riserstudy.study.settings import exceeds, from_plain, tuned_for, with_setting
from riserstudy.study.simulate_points import attempt
from riserstudy.study.store import canonical
from riserstudy.study.study import Study
from riserstudy.study.sweep import as_study

FloatArray = NDArray[np.float64]
Facts = dict[str, Any]


@dataclass
class RiserResponse:
    """A riser in sea states.

    Parameters
    ----------
    file : a scene with limits, an irregular sea and a duration.
    seeds : runs of each sea state.
    interval : of the record (s), in which what is demanded holds.
    cores : processes.
    say : is given what comes next.

    Raises
    ------
    InputError
        When the scene has no limits, no irregular sea or no duration, or one that is too long.
    """

    file: SceneFile
    seeds: int
    interval: float
    cores: int
    say: Callable[[str], None] = lambda _: None
    deviation: dict[tuple[float, float], FloatArray] = field(default_factory=dict)
    failures: dict[tuple[float, float], str] = field(default_factory=dict)
    runs: int = 0
    _setting: Setting | None = None

    def __post_init__(self) -> None:
        if not self.limits:
            raise InputError(self.file.source, "limits", "none", "give what the riser may do")
        phases_of(self.file, 1)  # refuses a scene without a sea or a time
        if not 0.0 < self.told <= self.interval:
            found = (
                f"{self.told:g} s after the ramps, the record has a row each {self.interval:g} s"
            )
            raise InputError(self.file.source, "analysis.duration", found, "allowed is up to that")

    @cached_property
    def limits(self) -> list[Limit]:
        """Limits of the scene."""
        return self.file.scene().limits or []

    @cached_property
    def units(self) -> list[str]:
        """Unit of what each limit allows."""
        return [UNITS[limit.output] for limit in self.limits]

    @cached_property
    def labels(self) -> list[str]:
        """Limits in words."""
        return [label(limit) for limit in self.limits]

    @cached_property
    def allowed(self) -> FloatArray:
        """What each limit allows, (limits,), in the SI unit of its output."""
        return np.array([limit.allowable for limit in self.limits])

    @cached_property
    def told(self) -> float:
        """Time of a run in which its sea is whole (s)."""
        scene = self.file.scene()
        return float(scene.analysis.duration or 0.0) - scene.built_up

    def prepare(self, states: FloatArray) -> None:
        """Tune mesh, step and method at the highest, the steepest and the longest of sea states, (n, 2).

        A scene that has its own mesh and step keeps them.
        """
        analysis = self.file.scene().analysis
        if analysis.mesh and analysis.step:
            return
        steepness = states[:, 0] / states[:, 1] ** 2
        severe = (states[:, 0], steepness * states[:, 0], states.prod(axis=1))
        hard = {int(values.argmax()) for values in severe}
        study = self._study(states[sorted(hard)])
        about = [engine_digest(), canonical(self.file.tree), sorted(map(str, study.axes["sea"]))]
        about += [texts_of_tables([self.file.tree], Path(self.file.source).parent)]
        name = hashlib.sha256(json.dumps(about, default=str).encode()).hexdigest()[:32]
        held = remembered(f"tuned/{name}", lambda: asdict(tuned_for(study, self.say)))
        self._setting = from_plain(held).setting

    def __call__(self, states: FloatArray) -> FloatArray:
        """Demand of each limit, (m, limits), at sea states (m, 2); no number where a run fails."""
        found = np.full((len(states), len(self.limits)), math.nan)
        kept = self._demands(states)
        for k, state in enumerate(states.tolist()):
            of_seeds = [kept[k, seed] for seed in range(self.seeds) if (k, seed) in kept]
            if len(of_seeds) < self.seeds:
                continue
            columns = np.array(of_seeds, float).T
            each = [
                demand(column, limit.side, self.interval / self.told)
                for column, limit in zip(columns, self.limits, strict=True)
            ]
            found[k] = [one.value for one in each]
            self.deviation[tuple(state)] = np.array([one.deviation for one in each])
        return found

    def _demands(self, states: FloatArray) -> dict[tuple[int, ...], list[float]]:
        """Demands of the limits by number of sea state and of seed, of runs that are completed."""
        study = self._study(states)
        if not self._setting:
            found, left = self._run(study, study.plan)
        else:
            tuned = with_setting(study, self._setting)
            found, unserved = self._run(tuned, tuned.plan, serves=partial(_serves, study))
            asked = {point.index: point for point in study.plan}
            more, left = self._run(study, [asked[index] for index in unserved])
            found |= more
        for index, why in left.items():
            self.failures[tuple(states[index[0]].tolist())] = why
        return found

    def _run(
        self, study: Study, points: list[Point], serves: Callable[[Facts], bool] = lambda _: True
    ) -> tuple[dict[tuple[int, ...], list[float]], dict[tuple[int, ...], str]]:
        """Demands by index of points that are completed and serve, and why the others are not."""
        failures = attempt(study, points, self.cores, lambda _: None)
        self.runs += len(points)
        found, left = {}, {}
        for point in points:
            held = None if point.key in failures else store.about(point.key)
            if held is None:
                left[point.index] = str(failures.get(point.key, "vanished from the store"))
            elif not serves(held["facts"]):
                left[point.index] = "an estimated error above the request"
            else:
                file = study.grid.file(point.index)
                rows = checked(file, file.scene(), held["facts"])
                found[point.index] = [
                    math.nan if one.demand is None else one.demand for one in rows
                ]
        return found, left

    def _study(self, states: FloatArray) -> Study:
        """Sea states by seeds as a study."""
        seas = {f"{h!r} m, {t!r} s": values_of(self.file, Sea(h, t)) for h, t in states.tolist()}
        seeds = {str(k + 1): phases_of(self.file, k + 1) for k in range(self.seeds)}
        return as_study(self.file, {"sea": seas, "seed": seeds}, [])


def _serves(study: Study, facts: Facts) -> bool:
    """Whether a run as tuned estimates no error above what the study requests."""
    return not exceeds(study, facts)
