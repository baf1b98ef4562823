"""Progress of a run: steps done and at work, points of studies, and the time left, from earlier runs.

The time of a step is its part of the elapsed time: of two steps at work each has half. The parts add up to
the elapsed time, however many cores a step uses; the sum over the remaining steps is thus the time left.
A first run has no earlier run: it uses the times of steps and rules that come with the project.
"""

from __future__ import annotations

import json
import re
import time
from collections import Counter, defaultdict
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from riserstudy.files.whole import write_whole

MEMORY = Path(".cache/steps.json")
PLANNED = Path(".cache/points.json")  # planned points and shards of each study
DATA_FILES = ("first_times.json",)
RECORDED = "standard"  # tier of the times that come with the project
FIRST = Path(__file__).with_name(DATA_FILES[0])  # times of rules without an earlier run
TAIL = 400  # bytes at the end of a log that contain its progress
STUDY = re.compile(r"simulate (\S+)/([^\s,]+)(?:, part (\d+) of (\d+))?")
PACE = 0.1  # share of a step's points that must be done before its own pace is used
MANY = 10  # least number of points done for a useful estimate of the pace
COUNTED = 20.0  # weight of the times of earlier runs in the pace of this machine (core seconds)
ALIKE = 4.0  # largest useful ratio of times: beyond it, for example, the points were in the store
POINTS = re.compile(r"(\d+) of (\d+) points\s*$")


class Taken(NamedTuple):
    """Time of a finished step: its rule, its part of the time (core seconds), its points (1 if none)."""

    rule: str
    seconds: float
    points: float


@dataclass
class Step:
    """A step at work: Snakemake's message about it, and its part of the time so far (core seconds)."""

    message: str
    seconds: float = 0.0


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
        self.took: dict[str, Taken] = {}  # by message
        self.points: dict[str, float] = {}  # by study
        self.shards: dict[str, int] = {}  # jobs that simulate a study, by study
        self.known: dict[str, tuple[str, float]] = {}  # rule and time (core seconds), by message
        self.before = _remembered(memory)
        self.first: dict[str, Any] = json.loads(FIRST.read_text("utf-8"))

    def plan(self, jobs: Mapping[str, int]) -> None:
        """Receive the number of steps of each rule that must be done."""
        self.left = Counter({rule: count for rule, count in jobs.items() if rule != "total"})
        planned = _planned(self.planned)
        self.points = {study: float(points) for study, (points, _) in planned.items()}
        self.shards = {study: shards for study, (_, shards) in planned.items()}
        self.known = self._known()

    def begin(self, job: int, message: str) -> None:
        """Receive the start of a step, with its message."""
        self._count()
        self.at_work[job] = Step(message.strip())

    def end(self, job: int, rule: str) -> None:
        """Receive the end of a step of a rule."""
        self._count()
        self.left[rule] -= 1
        step = self.at_work.pop(job, None)
        # Snakemake does not report the start of a rule that only collects files
        message = step.message if step else rule
        seconds = step.seconds if step else 0.0
        self.took[message] = Taken(rule, seconds, self._points(message))

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

    def _points(self, message: str) -> float:
        """Number of points that a step simulates; 1 for any other step."""
        found = STUDY.fullmatch(message)
        if not found:
            return 1.0
        paper, study, _, parts = found.groups()
        return self.points.get(f"{paper}/{study}", 1.0) / float(parts or 1)

    def _known(self) -> dict[str, tuple[str, float]]:
        """Rule and time (core seconds) of steps, by message.

        They are times of the last run of this tier, else of another tier, else those that come with the
        project; all are scaled to the present number of points of the study.
        """
        others = [steps for tier, steps in self.before.items() if tier != self.tier]
        every = self._of_project()
        for steps in (*others, self.before.get(self.tier, {})):
            every |= steps
        return {
            message: (step.rule, self._scaled(step, self._points(message))) for message, step in every.items()
        }

    def _scaled(self, step: Taken, points: float) -> float:
        """Time (core seconds) of a step with another number of points; the part without points is fixed."""
        fixed: float = min(self.first["a_step"].get(step.rule, 0.0), step.seconds)
        return fixed + (step.seconds - fixed) * points / step.points

    def _of_project(self) -> dict[str, Taken]:
        """Times that come with the project, of the steps that this run has.

        Measurements have no points by which to scale: their times are used only in the tier in which they
        were recorded.
        """
        steps = {message: Taken(*step) for message, step in self.first["steps"].items()}
        if self.tier != RECORDED:
            steps = {message: step for message, step in steps.items() if step.rule != "measure"}
        studies = {message for message in steps if STUDY.fullmatch(message)}
        planned = {f"simulate {study}" for study in self.points} & studies
        own = {m for m, step in steps.items() if step.rule == "compile"} | planned
        return {m: s for m, s in steps.items() if m in own or (planned and m not in studies)}

    def _at_first(self, rule: str) -> dict[str, float]:
        """Time (core seconds) of steps of a rule without an earlier run, by message; scaled by points.

        A shard uses the pace of the finished shards of its study. The job that joins shards uses the time per
        joined point.
        """
        step, point = (self.first[kind].get(rule) for kind in ("a_step", "a_point"))
        if step is None:
            return {}
        if point is None or not self.points:
            return {rule: step}
        joined, paces = self.first["a_point"]["join"], self._paces()
        times: dict[str, float] = {}
        for study, n in self.points.items():
            shards, message = self.shards[study], f"simulate {study}"
            if rule == "shard" and shards > 1:
                seconds = step + paces.get(study, point) * n / shards
                times |= {f"{message}, part {k} of {shards}": seconds for k in range(shards)}
            elif rule == "simulate":
                times[message] = step + (point if shards == 1 else joined) * n
        return times or {rule: step}

    def _paces(self) -> dict[str, float]:
        """Time per point (core seconds) by study, from the shards of this run, finished or at work."""
        seconds: dict[str, float] = defaultdict(float)
        points: dict[str, float] = defaultdict(float)
        for message, of in self.took.items():
            if of.rule == "shard" and (study := _study_of(message)):
                seconds[study] += of.seconds
                points[study] += of.points
        for step in self.at_work.values():
            done, of_all = points_done(step.message) or (0, 0)
            if of_all and done / of_all >= PACE and (study := _study_of(step.message)):
                seconds[study] += step.seconds
                points[study] += done
        return {study: seconds[study] / points[study] for study in points if points[study]}

    def text(self) -> str:
        """Progress in words: steps done, time elapsed and left, number of cores, steps at work."""
        so_far = f"{self.steps or 'no step'} done, {lasting(self.clock() - self.began)}"
        if (left := self.seconds_left()) is not None:
            word = "at least" if self._untimed() else "about"
            so_far = f"{self.percent(left)} %, {so_far}, {word} {lasting(left)} left"
        at_work = ", ".join(_shortened(step.message) for step in self.at_work.values())
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
        return share, self.steps, tuple(step.message for step in self.at_work.values())

    def seconds_left(self) -> float | None:
        """Time left (s), from the times of earlier runs per point, multiplied by the pace of this run.

        A rule without any known time counts as zero. None where nothing is left.
        """
        self._count()
        total = 0.0
        for rule, count in self.left.items():
            if count > 0:
                alike = self._alike(rule)
                to_do = [seconds for m, seconds in alike.items() if m not in self.took]
                times = to_do or list(alike.values()) or [0.0]
                total += count * sum(times) / len(times)
        if not total:
            return None
        pace = self._pace()
        spent = sum(self._spent(step, pace) for step in self.at_work.values())
        return max(total * pace - spent, 0.0) / self.cores

    def _alike(self, rule: str) -> dict[str, float]:
        """Times (core seconds) of steps of a rule, by message; empty where none is known."""
        known = {m: seconds for m, (of, seconds) in self.known.items() if of == rule}
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
        timed = [(of.seconds, known[m][1]) for m, of in self.took.items() if m in known]
        for step in self.at_work.values():
            done, of = points_done(step.message) or (0, 0)
            if of and done / of >= PACE and done >= MANY and step.message in known:
                timed.append((step.seconds, known[step.message][1] * done / of))
        for here, there in timed:
            if there / ALIKE < here < there * ALIKE:
                took, given = took + here, given + there
        return took / given

    def _spent(self, step: Step, pace: float) -> float:
        """Part (core seconds) of the expected time of a step at work that need not be spent any more.

        Once a tenth of its points is done the pace of these points is used; the result is negative where the
        step is slower than expected.
        """
        found = STUDY.fullmatch(step.message)
        rule = ("shard" if found[3] else "simulate") if found else ""
        at_first = self._at_first(rule).get(step.message)
        given = self.known[step.message][1] if step.message in self.known else at_first
        if given is None:
            return 0.0
        done, of = points_done(step.message) or (0, 0)
        if of and done / of >= PACE:
            return given * pace - step.seconds * (of - done) / done
        return min(step.seconds, given * pace) if step.message in self.known else 0.0

    def remember(self) -> None:
        """Store the times of this run for the next one, unless the disk is full or the folder read-only."""
        if self.took:
            kept = self.before | {self.tier: self.before.get(self.tier, {}) | self.took}
            with suppress(OSError):
                self.memory.parent.mkdir(mode=0o700, exist_ok=True)
                write_whole(self.memory, json.dumps(kept).encode())


def _remembered(memory: Path) -> dict[str, dict[str, Taken]]:
    """Steps of earlier runs by tier and message; none where they cannot be read."""
    try:
        tiers = json.loads(memory.read_text())
        return {
            tier: {message: Taken(*step) for message, step in steps.items()} for tier, steps in tiers.items()
        }
    except (OSError, ValueError, TypeError, AttributeError):
        return {}


def _planned(planned: Path) -> dict[str, tuple[float, int]]:
    """Numbers of points and of jobs of each study; empty where the plan was not written."""
    try:
        counts = json.loads(planned.read_text())
        return {str(study): (float(n), int(shards)) for study, (n, shards) in counts.items()}
    except (OSError, ValueError, TypeError, AttributeError):
        return {}


def _study_of(message: str) -> str | None:
    """Return the study that a step simulates, as ``paper/study``; None for another step."""
    found = STUDY.fullmatch(message)
    return f"{found[1]}/{found[2]}" if found else None


def _shortened(message: str) -> str:
    """Return the message of a step with its number of finished points and of all, from its log."""
    points = points_done(message)
    return f"{message} ({points[0]} of {points[1]} points)" if points else message


def points_done(message: str) -> tuple[int, int] | None:
    """Return the numbers of finished points and of all points of a step at work, from its log."""
    found = STUDY.fullmatch(message)
    if not found:
        return None
    paper, study, part, parts = found.groups()
    log = Path("logs", paper, f"{study}.{part}-of-{parts}.log" if part else f"{study}.log")
    try:
        end = log.read_bytes()[-TAIL:].decode(errors="replace")
    except OSError:
        return None
    points = POINTS.search(end)
    return (int(points[1]), int(points[2])) if points else None


def lasting(seconds: float) -> str:
    """Return a time (s) in words."""
    minutes = round(seconds / 60.0)
    return f"{seconds:.0f} s" if seconds < 90.0 else f"{minutes} min"
