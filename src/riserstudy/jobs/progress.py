"""Progress of a run: steps done and at work, points of studies, and the time left, from earlier runs.

The time of a step is its part of the elapsed time: of two steps at work each has half. The parts add up to
the elapsed time, however many cores a step uses; the sum over the remaining steps is thus the time left.
A first run has no earlier run: it uses the times of steps and rules that come with the project.
"""

from __future__ import annotations

import json
import time
from collections import Counter, defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from riserstudy.jobs.points_done import PointsDone, last_points
from riserstudy.jobs.step_times import (
    SHARD,
    SIMULATE,
    StepName,
    Taken,
    Times,
    first_times,
    remember,
    remembered,
)

MEMORY = Path(".cache/steps.json")
PLANNED = Path(".cache/points.json")  # planned points and shards of each study
RECORDED = "standard"  # tier of the times that come with the project
PACE = 0.1  # share of a step's points that must be done before its own pace is used
MANY = 10  # least number of points done for a useful estimate of the pace
COUNTED = 20.0  # weight of the times of earlier runs in the pace of this machine (core seconds)
ALIKE = 4.0  # largest useful ratio of times: beyond it, for example, the points were in the store


@dataclass
class Step:
    """A step at work: its name, words and log, and its part of the time so far (core seconds)."""

    name: StepName
    words: str
    log: Path | None
    seconds: float = 0.0

    @property
    def points(self) -> PointsDone | None:
        """Numbers of finished points and of all points, from its log; None for a step without points."""
        return last_points(self.log) if self.log and self.name.study else None

    @property
    def share_done(self) -> float | None:
        """Share of its points that is done, once it is large enough for a pace; else None."""
        points = self.points
        if not points or not points.total or points.done / points.total < PACE:
            return None
        return points.done / points.total

    def __str__(self) -> str:
        """Its words, with the numbers of points."""
        points = self.points
        return f"{self.words} ({points})" if points else self.words


class Progress:
    """Progress of a run, from Snakemake's reports about its steps.

    Parameters
    ----------
    tier : tier of the run; the times of each tier are stored separately, in ``memory``.
    clock : returns the time (s).
    planned : file into which the planning of this run writes the points of each study.
    """

    def __init__(
        self,
        tier: str,
        memory: Path = MEMORY,
        clock: Callable[[], float] = time.monotonic,
        planned: Path = PLANNED,
    ) -> None:
        self.tier, self.memory, self.clock, self.planned = tier, memory, clock, planned
        self.began = self.counted = clock()
        self.cores = 1
        self.steps = ""
        self.left: Counter[str] = Counter()  # remaining steps, by rule
        self.at_work: dict[int, Step] = {}  # by number of the job
        self.took: Times = {}
        self.points: dict[str, float] = {}  # by study
        self.shards: dict[str, int] = {}  # jobs that simulate a study, by study
        self.known: dict[StepName, float] = {}  # times (core seconds) of earlier runs, for these points
        self.before = remembered(memory)
        self.first = first_times()

    def plan(self, jobs: Mapping[str, int]) -> None:
        """Receive the number of steps of each rule that must be done."""
        self.left = Counter({rule: count for rule, count in jobs.items() if rule != "total"})
        planned = _planned(self.planned)
        self.points = {study: float(points) for study, (points, _) in planned.items()}
        self.shards = {study: shards for study, (_, shards) in planned.items()}
        self.known = self._known()

    def begin(self, job: int, name: StepName, words: str = "", log: Path | None = None) -> None:
        """Receive the start of a step: its name, words about it (absent: its rule), and its log."""
        self._count()
        self.at_work[job] = Step(name, words.strip() or name.rule, log)

    def end(self, job: int) -> None:
        """Receive the end of a step that has begun."""
        self._count()
        if step := self.at_work.pop(job, None):
            self.left[step.name.rule] -= 1
            self.took[step.name] = Taken(step.seconds, self._points(step.name))

    def fail(self, job: int) -> None:
        """Receive the failure of a step."""
        self._count()
        self.at_work.pop(job, None)

    def _count(self) -> None:
        """Distribute the time since the last call over the steps that were at work."""
        now = self.clock()
        for step in self.at_work.values():
            step.seconds += self.cores * (now - self.counted) / len(self.at_work)
        self.counted = now

    def _points(self, name: StepName) -> float:
        """Number of points that a step simulates; 1 for any other step."""
        return self.points.get(name.study, 1.0) * name.share if name.study else 1.0

    def _known(self) -> dict[StepName, float]:
        """Times (core seconds) of steps.

        They are times of the last run of this tier, else of another tier, else those that come with the
        project; all are scaled to the present number of points of the study.
        """
        others = [steps for tier, steps in self.before.items() if tier != self.tier]
        every = self._of_project()
        for steps in (*others, self.before.get(self.tier, {})):
            every |= steps
        return {name: self._scaled(name, taken) for name, taken in every.items()}

    def _scaled(self, name: StepName, taken: Taken) -> float:
        """Time (core seconds) of a step with its present points; the part without points is fixed."""
        fixed = min(self.first.a_step.get(name.rule, 0.0), taken.seconds)
        return fixed + (taken.seconds - fixed) * self._points(name) / taken.points

    def _of_project(self) -> Times:
        """Times that come with the project, of the steps that this run has.

        Measurements have no points by which to scale: their times are used only in the tier in which they
        were recorded.
        """
        steps = self.first.steps
        if self.tier != RECORDED:
            steps = {name: taken for name, taken in steps.items() if name.rule != "measure"}
        planned = {name for name in steps if name.study in self.points}
        own = {name for name in steps if name.rule == "compile"} | planned
        return {n: taken for n, taken in steps.items() if n in own or (planned and not n.study)}

    def _at_first(self, rule: str) -> dict[StepName, float]:
        """Times (core seconds) of steps of a rule without an earlier run, scaled by points.

        A shard uses the pace of the finished shards of its study. The job that joins shards uses the time per
        joined point.
        """
        step, point = self.first.a_step.get(rule), self.first.a_point.get(rule)
        if step is None:
            return {}
        if point is None or not self.points:
            return {StepName(rule): step}
        joined, paces = self.first.a_point["join"], self._paces()
        times: dict[StepName, float] = {}
        for study, n in self.points.items():
            shards = self.shards[study]
            if rule == SHARD and shards > 1:
                seconds = step + paces.get(study, point) * n / shards
                times |= {StepName.of_study(study, k, shards): seconds for k in range(1, shards + 1)}
            elif rule == SIMULATE:
                times[StepName.of_study(study)] = step + (point if shards == 1 else joined) * n
        return times or {StepName(rule): step}

    def _paces(self) -> dict[str, float]:
        """Time per point (core seconds) by study, from the shards of this run, finished or at work."""
        seconds: dict[str, float] = defaultdict(float)
        points: dict[str, float] = defaultdict(float)
        for name, of in self.took.items():
            if name.rule == SHARD and name.study:
                seconds[name.study] += of.seconds
                points[name.study] += of.points
        for step in self.at_work.values():
            done = step.points
            if done and step.share_done and step.name.study:
                seconds[step.name.study] += step.seconds
                points[step.name.study] += done.done
        return {study: seconds[study] / points[study] for study in points if points[study]}

    def text(self) -> str:
        """Progress in words: steps done, time elapsed and left, number of cores, steps at work."""
        so_far = f"{self.steps or 'no step'} done, {lasting(self.clock() - self.began)}"
        if (left := self.seconds_left()) is not None:
            word = "at least" if self._untimed() else "about"
            so_far = f"{self.percent(left)} %, {so_far}, {word} {lasting(left)} left"
        at_work = ", ".join(map(str, self.at_work.values()))
        cores = f"{self.cores} core{'s' if self.cores > 1 else ''}"
        return f"{so_far} on {cores}: {at_work}" if at_work else f"{so_far} on {cores}"

    def percent(self, left: float) -> int:
        """Elapsed share of the time (%), at most 99; ``left`` is the time left (s)."""
        elapsed = self.clock() - self.began
        return min(99, int(100.0 * elapsed / (elapsed + left))) if elapsed + left > 0.0 else 0

    def state(self) -> tuple[object, ...]:
        """State of the run, whose change makes a new line in a log: percentage, steps done and at work."""
        left = self.seconds_left()
        share = None if left is None else self.percent(left)
        return share, self.steps, tuple(step.name for step in self.at_work.values())

    def seconds_left(self) -> float | None:
        """Time left (s), from the times of earlier runs per point, multiplied by the pace of this run.

        A rule without any known time counts as zero. None where nothing is left.
        """
        self._count()
        total = 0.0
        for rule, count in self.left.items():
            if count > 0:
                alike = self._alike(rule)
                to_do = [seconds for name, seconds in alike.items() if name not in self.took]
                times = to_do or list(alike.values()) or [0.0]
                total += count * sum(times) / len(times)
        if not total:
            return None
        pace = self._pace()
        spent = sum(self._spent(step, pace) for step in self.at_work.values())
        return max(total * pace - spent, 0.0) / self.cores

    def _alike(self, rule: str) -> dict[StepName, float]:
        """Times (core seconds) of steps of a rule; empty where none is known."""
        known = {name: seconds for name, seconds in self.known.items() if name.rule == rule}
        return known or self._at_first(rule)

    def _untimed(self) -> bool:
        """Whether steps of a rule without any known time are left, as of a rule that a user wrote."""
        return any(count > 0 and not self._alike(rule) for rule, count in self.left.items())

    def _pace(self) -> float:
        """Ratio of the times of this run's steps to their expected times.

        Of steps at work the finished points count. A step that was much quicker or slower than expected does
        not count: the cause is a store that had its points, or an edit, not the machine.
        """
        took, given = COUNTED, COUNTED
        known = self.known
        timed = [(of.seconds, known[name]) for name, of in self.took.items() if name in known]
        for step in self.at_work.values():
            done, share = step.points, step.share_done
            if done and share and done.done >= MANY and step.name in known:
                timed.append((step.seconds, known[step.name] * share))
        for here, there in timed:
            if there / ALIKE < here < there * ALIKE:
                took, given = took + here, given + there
        return took / given

    def _spent(self, step: Step, pace: float) -> float:
        """Part (core seconds) of the expected time of a step at work that need not be spent any more.

        Once a tenth of its points is done the pace of these points is used; the result is negative where the
        step is slower than expected.
        """
        at_first = self._at_first(step.name.rule) if step.name.study else {}
        given = self.known.get(step.name, at_first.get(step.name))
        if given is None:
            return 0.0
        if share := step.share_done:
            return given * pace - step.seconds * (1.0 - share) / share
        return min(step.seconds, given * pace) if step.name in self.known else 0.0

    def remember(self) -> None:
        """Store the times of this run for the next one."""
        if self.took:
            times = self.before.get(self.tier, {}) | self.took
            remember(self.memory, self.before | {self.tier: times})


def _planned(planned: Path) -> dict[str, tuple[float, int]]:
    """Numbers of points and of jobs of each study; empty where the plan was not written."""
    try:
        counts = json.loads(planned.read_text())
        return {str(study): (float(n), int(shards)) for study, (n, shards) in counts.items()}
    except (OSError, ValueError, TypeError, AttributeError):
        return {}


def lasting(seconds: float) -> str:
    """Return a time (s) in words."""
    minutes = round(seconds / 60.0)
    return f"{seconds:.0f} s" if seconds < 90.0 else f"{minutes} min"
