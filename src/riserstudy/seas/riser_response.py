"""Demands of a riser's limits in sea states, from runs with several seeds, stored point by point."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from riserstudy.dataset.limits import checked, error_of, labels
from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.limits import UNITS, Limit
from riserstudy.scene.load import SceneFile
from riserstudy.scene.pressures import not_in_demand
from riserstudy.study import store
from riserstudy.study.demand_in_sea import demand, ends, exceeded_on_average
from riserstudy.study.departures import check_stays
from riserstudy.study.in_sea import Sea, exposure, phases_of, values_of
from riserstudy.study.simulate_points import attempt
from riserstudy.study.study import Study
from riserstudy.study.sweep import as_study


@dataclass
class RiserResponse:
    """A riser in sea states.

    Parameters
    ----------
    file : a scene with limits, an irregular sea and a duration.
    seeds : number of runs for each sea state.
    interval : interval of the record (s), to which the demands refer.
    cores : number of processes.

    Raises
    ------
    InputError
        When the scene has no limits, no irregular sea or no duration, or its duration is too long. When a
        limit lacks inputs, or the riser does not stay in its place and state during a run.
    """

    file: SceneFile
    seeds: int
    interval: float
    cores: int
    deviation: dict[tuple[float, float], FloatArray] = field(default_factory=dict)
    scale: dict[tuple[float, float], FloatArray] = field(default_factory=dict)
    failures: dict[tuple[float, float], str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not self.limits:
            found = "missing, but the downtime is computed from them"
            raise InputError(self.file.source, "limits", found, "add the limits of the riser")
        phases_of(self.file, 1)  # refuses a scene without a sea, or a static scene
        check_stays(self.file)
        if not 0.0 < self.exposure <= self.interval:
            found = (
                f"the run lasts {self.exposure:g} s after ramps and analysis.output.start, but a row of the "
                f"record stands for {self.interval:g} s"
            )
            allowed = f"give a duration that leaves more than 0 s and at most {self.interval:g} s"
            raise InputError(self.file.source, "analysis.duration", found, allowed)

    @cached_property
    def limits(self) -> list[Limit]:
        """Limits of the scene."""
        return self.file.resolved().limits or []

    @cached_property
    def units(self) -> list[str]:
        """Unit of each limit's allowable."""
        return [UNITS[limit.output] for limit in self.limits]

    @cached_property
    def labels(self) -> list[str]:
        """Limits in words."""
        return labels(self.limits)

    @cached_property
    def allowed(self) -> FloatArray:
        """Allowable of each limit, (limits,), in the SI unit of its output."""
        return np.array([limit.allowable for limit in self.limits])

    @cached_property
    def mud(self) -> list[float]:
        """For each limit, what mud above the riser takes from a smallest tension (N); 0 for other limits."""
        scene = self.file.resolved()
        return [not_in_demand(scene, limit) for limit in self.limits]

    @cached_property
    def exposure(self) -> float:
        """Duration of a run after its ramps and the start of its outputs (s), in which extremes count."""
        return exposure(self.file.resolved())

    @property
    def runs(self) -> float:
        """Length of an interval of the record divided by the length of a run."""
        return self.interval / self.exposure

    @cached_property
    def ends(self) -> FloatArray:
        """Ends of the band of demands by few seeds, (2, limits): worse and better, in standard errors."""
        return np.array([ends(limit.side, self.runs, self.seeds) for limit in self.limits]).T

    @property
    def exceeded(self) -> float:
        """Share of intervals that exceed the demand of an extreme, on average over demands (1)."""
        return exceeded_on_average(self.runs, self.seeds)

    def seconds(self, states: FloatArray) -> float:
        """Elapsed time of a run (s), the smallest over sea states (m, 2), since the first also loads kernels.

        It includes stored runs and runs made now; NaN if all fail.
        """
        study = self._study(states)
        points = [point for point in study.plan if point.index[1] == 0]
        attempt(study, points, 1, lambda _: None)
        held = [store.about(point.key) for point in points]
        return min((float(one["facts"]["wall_seconds"]) for one in held if one is not None), default=math.nan)

    def __call__(self, states: FloatArray) -> FloatArray:
        """Demand of each limit, (m, limits), at sea states (m, 2); NaN where a run fails.

        Mud above the riser, whose weight the tension of a run does not include, decreases smallest tensions.
        """
        found = np.full((len(states), len(self.limits)), math.nan)
        kept = self._demands(states)
        for k, state in enumerate(states.tolist()):
            of_seeds = [kept[k, seed] for seed in range(self.seeds) if (k, seed) in kept]
            if len(of_seeds) < self.seeds:
                continue
            columns = np.array(of_seeds, float).T
            each = [
                demand(column, limit.side, self.runs)
                for column, limit in zip(columns, self.limits, strict=True)
            ]
            found[k] = [one.value for one in each]
            self.deviation[tuple(state)] = np.array([one.deviation for one in each])
            self.scale[tuple(state)] = np.array([one.scale for one in each])
        return found

    def facts(self, states: FloatArray) -> list[dict[str, Any]]:
        """Facts of the runs with the first seed at sea states (m, 2); empty for a failed run."""
        study = self._study(states)
        held = [store.about(point.key) for point in study.plan if point.index[1] == 0]
        return [one["facts"] if one else {} for one in held]

    def estimated_errors(self, states: FloatArray) -> FloatArray:
        """Estimated error of each limit's output, (m, limits), at sea states (m, 2).

        Runs have the first seed. Each error is in the SI unit of the output. It is zero for outputs whose
        error a tolerance limits, and NaN where a run fails.
        """
        study = replace(self._study(states), estimates=True)
        points = [point for point in study.plan if point.index[1] == 0]
        failures = attempt(study, points, self.cores, lambda _: None)
        found = np.full((len(states), len(self.limits)), math.nan)
        own_mesh = self.file.resolved().analysis.mesh is not None
        for point in points:
            held = None if point.key in failures else store.about(point.key)
            if held is not None:
                facts = held["facts"]
                found[point.index[0]] = [error_of(one.output, facts, own_mesh).size for one in self.limits]
        return found

    def _demands(self, states: FloatArray) -> dict[tuple[int, ...], list[float]]:
        """Demands of the limits by index of sea state and seed, for completed runs."""
        study = self._study(states)
        failures = attempt(study, study.plan, self.cores, lambda _: None)
        found = {}
        for point in study.plan:
            held = None if point.key in failures else store.about(point.key)
            if held is None:
                why = str(failures.get(point.key, "vanished from the store"))
                self.failures[tuple(states[point.index[0]].tolist())] = why
                continue
            file = study.grid.file(point.index)
            rows = checked(file, file.resolved(), held["facts"])
            found[point.index] = [
                math.nan if one.demand is None else one.demand - mud
                for one, mud in zip(rows, self.mud, strict=True)
            ]
        return found

    def _study(self, states: FloatArray) -> Study:
        """A study over sea states and seeds."""
        seas = {f"{h!r} m, {t!r} s": values_of(self.file, Sea(h, t)) for h, t in states.tolist()}
        seeds = {str(k + 1): phases_of(self.file, k + 1) for k in range(self.seeds)}
        # errors of demands are measured by other runs, or estimated in few runs
        return replace(as_study(self.file, {"sea": seas, "seed": seeds}, []), estimates=False)
