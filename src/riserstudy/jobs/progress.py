"""How far a run of the study is: steps, what is at work, points of studies, time left by earlier runs.

A first run has none before it: it takes the times of rules that come with the project.
"""

from __future__ import annotations

import json
import re
import time
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

MEMORY = Path(".cache/steps.json")
PLANNED = Path(".cache/points.json")  # points of each study of this run, as it was planned
DATA_FILES = ("first_times.json",)
FIRST = Path(__file__).with_name(DATA_FILES[0])  # times for rules that no earlier run had
TAIL = 400  # bytes of a log, at its end, in which its progress stands
STUDY = re.compile(r"simulate (\S+)/([^\s,]+)(?:, part (\d+) of (\d+))?")
PACE = 0.1  # share of a step's points from which its own pace is used
POINTS = re.compile(r"(\d+) of (\d+) points\s*$")


class Taken(NamedTuple):
    """What a step that is done took: its rule, time (s) and points, 1 where it has none."""

    rule: str
    seconds: float
    points: float


@dataclass
class Step:
    """A step at work: what Snakemake says that it does, and since when (s)."""

    message: str
    began: float


class Progress:
    """How far a run is, from what Snakemake reports of its steps.

    Parameters
    ----------
    tier : its times are remembered apart, in ``memory``.
    clock : gives the time (s).
    planned : where the plan of this run leaves the points of each study.
    """

    def __init__(
        self,
        tier: str,
        memory: Path = MEMORY,
        clock: Callable[[], float] = time.monotonic,
        planned: Path = PLANNED,
    ) -> None:
        self.tier, self.memory, self.clock, self.planned = tier, memory, clock, planned
        self.began = clock()
        self.cores = 1
        self.steps = ""
        self.left: Counter[str] = Counter()  # steps to do, by rule
        self.at_work: dict[int, Step] = {}  # by number of the job
        self.took: dict[str, Taken] = {}  # by message
        self.points: dict[str, float] = {}  # by study
        self.before = _remembered(memory)
        self.first: dict[str, dict[str, float]] = json.loads(FIRST.read_text("utf-8"))

    def plan(self, jobs: Mapping[str, int]) -> None:
        """Take in how many steps of each rule there are to do."""
        self.left = Counter({rule: count for rule, count in jobs.items() if rule != "total"})
        self.points = _planned(self.planned)

    def begin(self, job: int, message: str) -> None:
        """Take in that a step is at work, and what it does."""
        self.at_work[job] = Step(message.strip(), self.clock())

    def end(self, job: int, rule: str) -> None:
        """Take in that a step of a rule is done."""
        self.left[rule] -= 1
        step = self.at_work.pop(job, None)
        # what only gathers says nothing when it begins
        message = step.message if step else rule
        seconds = self.clock() - step.began if step else 0.0
        self.took[message] = Taken(rule, seconds, self._points(message))

    def fail(self, job: int) -> None:
        """Take in that a step has failed."""
        self.at_work.pop(job, None)

    def _points(self, message: str) -> float:
        """Points that a step simulates; 1 for any other."""
        found = STUDY.fullmatch(message)
        if not found:
            return 1.0
        paper, study, _, parts = found.groups()
        return self.points.get(f"{paper}/{study}", 1.0) / float(parts or 1)

    def _known(self) -> dict[str, tuple[str, float]]:
        """Rule and time (s) of steps, by message.

        As the last run of the tier had them, or that of another tier, by the points that a study has now.
        """
        others = [steps for tier, steps in self.before.items() if tier != self.tier]
        every: dict[str, Taken] = {}
        for steps in (*others, self.before.get(self.tier, {})):
            every |= steps
        return {
            message: (step.rule, step.seconds * self._points(message) / step.points)
            for message, step in every.items()
        }

    def _at_first(self, rule: str) -> dict[str, float]:
        """Time (s) of steps of a rule that no run had yet, by message: by points where it simulates."""
        step, point = (self.first[kind].get(rule) for kind in ("a_step", "a_point"))
        if step is None:
            return {}
        if point is None or not self.points:
            return {rule: step}
        return {f"simulate {study}": step + point * n for study, n in self.points.items()}

    def text(self) -> str:
        """Steps done, time gone and left, what is at work, on how many cores."""
        gone = f"{self.steps or 'no step'} done, {lasting(self.clock() - self.began)}"
        if (left := self.seconds_left()) is not None:
            gone = f"{self.percent(left)} %, {gone}, about {lasting(left)} left"
        at_work = ", ".join(_shortened(step.message) for step in self.at_work.values())
        cores = f"{self.cores} core{'s' if self.cores > 1 else ''}"
        return f"{gone} on {cores}: {at_work}" if at_work else f"{gone} on {cores}"

    def percent(self, left: float) -> int:
        """Share of the time that is gone (%), below 100 while some is left (s)."""
        gone = self.clock() - self.began
        return min(99, int(100.0 * gone / (gone + left))) if gone + left > 0.0 else 0

    def state(self) -> tuple[object, ...]:
        """What a log has a new line for: per cent, steps done, and what is at work."""
        left = self.seconds_left()
        share = None if left is None else self.percent(left)
        return share, self.steps, tuple(step.message for step in self.at_work.values())

    def seconds_left(self) -> float | None:
        """Time left (s) where steps take as long as in earlier runs, a point for a point.

        None where nothing is left, or nothing is known of a rule.
        """
        known = self._known()
        total = 0.0
        for rule, count in self.left.items():
            if count > 0:
                alike = {m: seconds for m, (of, seconds) in known.items() if of == rule}
                alike = alike or self._at_first(rule)
                if not alike:
                    return None
                to_do = [seconds for m, seconds in alike.items() if m not in self.took]
                times = to_do or list(alike.values())
                total += count * sum(times) / len(times)
        if not total:
            return None
        spent = sum(self._spent(step, known) for step in self.at_work.values())
        return max(total - spent, 0.0) / self.cores

    def _spent(self, step: Step, known: dict[str, tuple[str, float]]) -> float:
        """What is no longer to do (s) of the time that a step at work was given.

        By the pace of its own points once a tenth of them is done; negative where it is slower than thought.
        """
        gone = self.clock() - step.began
        rule = "simulate" if STUDY.fullmatch(step.message) else ""
        given = (
            known[step.message][1]
            if step.message in known
            else self._at_first(rule).get(step.message)
        )
        if given is None:
            return 0.0
        done, of = points_done(step.message) or (0, 0)
        if of and done / of >= PACE:
            return given - gone * (of - done) / done
        return min(gone, given) if step.message in known else 0.0

    def remember(self) -> None:
        """Keep the times of this run for the next one."""
        if self.took:
            kept = self.before | {self.tier: self.before.get(self.tier, {}) | self.took}
            self.memory.parent.mkdir(mode=0o700, exist_ok=True)
            self.memory.write_text(json.dumps(kept))


def _remembered(memory: Path) -> dict[str, dict[str, Taken]]:
    """Steps of earlier runs by tier and message; none where they cannot be read."""
    try:
        tiers = json.loads(memory.read_text())
        return {
            tier: {message: Taken(*step) for message, step in steps.items()}
            for tier, steps in tiers.items()
        }
    except (OSError, ValueError, TypeError, AttributeError):
        return {}


def _planned(planned: Path) -> dict[str, float]:
    """Points of each study; none where the plan has not been left."""
    try:
        return {
            str(study): float(count) for study, count in json.loads(planned.read_text()).items()
        }
    except (OSError, ValueError, AttributeError):
        return {}


def _shortened(message: str) -> str:
    """What a step does, with the points that it has done of how many, as its log tells."""
    points = points_done(message)
    return f"{message} ({points[0]} of {points[1]} points)" if points else message


def points_done(message: str) -> tuple[int, int] | None:
    """Points that a step at work has done, and how many it has, as its log tells."""
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
    """A time in words."""
    minutes = round(seconds / 60.0)
    return f"{seconds:.0f} s" if seconds < 90.0 else f"{minutes} min"
