"""Whether runs may be believed, asked of the results database: errors, energy, warnings, times.

An error counts where it is one of what the study keeps: what a run computes and nobody stores reaches no
figure and no verdict.
"""

from __future__ import annotations

import sqlite3
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from riserstudy.report.without_points import WithoutPoints, without_points
from riserstudy.report.wording import grouped, listed, share, spaced
from riserstudy.study.models import StudyFile, StudyModel

TOLERANCE = 0.01  # estimated error above which a point counts as off, where none is asked for
ROUNDING = 1e-9  # above a tolerance that is none
#: which error tells how good a variable is, by how its name begins; that of displacement tells the rest
RELEVANT_ERRORS = {
    "moment": ("bending_moment", "largest_stress"),
    "tension": ("effective_tension", "largest_stress", "tensioner_force", "riser_reaction"),
}
ERRORS = ("displacement", *RELEVANT_ERRORS)
LARGEST = ("unexplained_energy", "wall_seconds", *(f"error_{name}" for name in ERRORS))
UNSAID = "one mesh and one step serve all points of a study"
#: points with whether a mesh is prescribed, and the accuracy that each asks for: an axis may set it
POINTS = f"""
with prescribed as (select distinct point from parameters where path like 'analysis.mesh.%'),
  asked as (select point, value from parameters where path = 'analysis.accuracy')
select points.*, points.point in prescribed as fixed, coalesce(asked.value, {TOLERANCE}) as tolerance,
  studies.paper, studies.name, studies.caption
from points join studies using (study) left join asked using (point)
"""


class Row(NamedTuple):
    """One simulated dataset: the worst of its points."""

    paper: str
    name: str
    about: str
    points: int
    energy: float
    errors: dict[str, float]
    counts: list[str]  # errors of what is kept
    because: str  # why they may be large
    off: int  # points whose error is above the tolerance
    mesh: str  # fixed, tuned or refined
    warned: int
    total: float  # s of all its points
    longest: float

    @property
    def clean(self) -> bool:
        """Whether nothing is to be said of it."""
        return not self.off and not self.warned


class Warned(NamedTuple):
    """Warnings that differ in numbers alone: the text, and where they stand how often."""

    text: str
    points: int
    datasets: list[str]


class Missed(NamedTuple):
    """Points with an estimated error above the tolerance: how many, why, and what rests on them."""

    points: int
    off: int
    requested: int  # points that ask for an accuracy
    missed_by_request: int
    estimated: int  # points with mesh and step prescribed that tell an error
    not_estimated: int  # others that tell none, in tuned studies
    reasons: list[tuple[str, int, list[str]]]  # why of those that miss: points and datasets
    worst: float
    where: str
    verdicts: list[tuple[str, str]]  # paper and id of numbers and claims that rest on one
    without: WithoutPoints  # what becomes of these

    @property
    def sentences(self) -> str:
        """In words."""
        fixed, prescribed = self.off - self.missed_by_request, self.points - self.requested
        if not self.off:
            silent = self.not_estimated + prescribed - self.estimated
            if not silent:
                return f"All {spaced(self.points)} points have estimated errors within their tolerance."
            return (
                f"All {spaced(self.points - silent)} points with an estimated error are within their "
                f"tolerance. For the other {spaced(silent)}, the error was not estimated."
            )
        judged = spaced(self.requested - self.not_estimated)
        requested = (
            f"{spaced(self.missed_by_request)} of {judged} points with a tolerance miss it"
            if self.missed_by_request
            else f"All {judged} points with a tolerance meet it, by their estimated error"
        )
        if self.not_estimated:
            more = f"For {spaced(self.not_estimated)} more, in tuned studies"
            requested += f". {more}, the error was not estimated"
        sentence = (
            f"The other {spaced(prescribed)} use a fixed mesh and time step; "
            f"their error was estimated for {self.estimated} of them"
        )
        if not fixed:
            return f"{requested}. {sentence} and is at most {share(TOLERANCE)}."
        return (
            f"{requested}. {sentence} and exceeds {share(TOLERANCE)} for {fixed}. "
            f"The largest estimate is {share(self.worst)}, in {self.where}."
        )


def audit(db: sqlite3.Connection, files: dict[str, StudyFile]) -> list[Row]:
    """A row a simulated dataset, in the order of the database."""
    tallies: dict[str, Tally] = {}
    for point in _points(db, files):
        tallies.setdefault(point["study"], Tally(point)).add(point)
    return [tally.row() for tally in tallies.values()]


def relevant_errors(keep: list[str] | None) -> list[str]:
    """Errors that count for a study: of what it keeps, all where it keeps everything."""
    if keep is None:
        return list(ERRORS)
    names = {
        error: [name for name in keep if name.startswith(begins)]
        for error, begins in RELEVANT_ERRORS.items()
    }
    others = set(keep).difference(*names.values())
    return [*(["displacement"] if others else []), *(error for error, of in names.items() if of)]


def _points(db: sqlite3.Connection, files: dict[str, StudyFile]) -> Iterator[dict[str, Any]]:
    """Points with the largest of the errors that count, and why it may be large; there may be a million."""
    cursor = db.execute(POINTS)
    names = [column[0] for column in cursor.description]
    of_study: dict[str, dict[str, Any]] = {}
    for row in cursor:
        point = dict(zip(names, row, strict=True))
        if point["study"] not in of_study:
            study = _study(files, point)
            because = study.error_because if study and study.error_because else UNSAID
            counts = relevant_errors(study.keep if study else None)
            tuned = bool(study and study.settings)
            of_study[point["study"]] = {"counts": counts, "because": because, "tuned": tuned}
        point |= of_study[point["study"]]
        errors = [point[f"error_{name}"] for name in point["counts"]]
        point["has_estimate"] = any(point[f"error_{name}"] is not None for name in ERRORS)
        point["error"] = max((error or 0.0 for error in errors), default=0.0)
        yield point


def _study(files: dict[str, StudyFile], point: dict[str, Any]) -> StudyModel | None:
    return files[point["paper"]].studies.get(point["name"]) if point["paper"] in files else None


def _misses(point: dict[str, Any]) -> bool:
    return bool(point["error"] > point["tolerance"] * (1.0 + ROUNDING))


def _largest(point: dict[str, Any]) -> str:
    """The quantity that errs most."""
    counts: list[str] = point["counts"]
    return max(counts, key=lambda name: point[f"error_{name}"] or 0.0)


@dataclass
class Tally:
    """What the points of a dataset have in all, taken in one by one."""

    first: dict[str, Any]
    points: int = 0
    largest: dict[str, float] = field(default_factory=lambda: dict.fromkeys(LARGEST, 0.0))
    off: int = 0
    fixed: bool = True
    warned: int = 0
    total: float = 0.0

    def add(self, point: dict[str, Any]) -> None:
        """Take in a point."""
        self.points += 1
        for name, most in self.largest.items():
            self.largest[name] = max(most, point[name] or 0.0)
        self.off += _misses(point)
        self.fixed = self.fixed and bool(point["fixed"])
        self.warned += bool(point["warnings"])
        self.total += point["wall_seconds"] or 0.0

    def row(self) -> Row:
        """The dataset's row."""
        first, largest = self.first, self.largest
        return Row(
            paper=first["paper"],
            name=first["name"],
            about=first["caption"],
            points=self.points,
            energy=largest["unexplained_energy"],
            errors={name: largest[f"error_{name}"] for name in ERRORS},
            counts=first["counts"],
            because=first["because"] if first["because"] != UNSAID else "",
            off=self.off,
            mesh="fixed" if self.fixed else "tuned" if first["tuned"] else "refined",
            warned=self.warned,
            total=self.total,
            longest=largest["wall_seconds"],
        )


def warned(db: sqlite3.Connection) -> list[Warned]:
    """All warnings, equal ones as one, the most frequent first."""
    where: dict[str, list[str]] = {}
    rows = db.execute("select study, warnings from points where warnings != '' order by point")
    for study, text in rows:
        for line in text.splitlines():
            where.setdefault(line, []).append(study)
    kinds = grouped(line for line, studies in where.items() for _ in studies)
    warnings = []
    for text, lines, count in kinds:
        datasets = dict.fromkeys(study for line in lines for study in where[line])
        warnings.append(Warned(text, count, list(datasets)))
    return sorted(warnings, key=lambda one: -one.points)


def missed(db: sqlite3.Connection, files: dict[str, StudyFile]) -> Missed:
    """How many points miss the tolerance, why, and which verdicts rest on one."""
    off: list[dict[str, Any]] = []
    count: Counter[str] = Counter()
    for point in _points(db, files):
        missing = _misses(point)
        count["points"] += 1
        count["requested"] += not point["fixed"]
        count["missed by request"] += missing and not point["fixed"]
        count["estimated"] += bool(point["fixed"] and point["has_estimate"])
        count["not_estimated"] += not point["fixed"] and not point["has_estimate"]
        if missing:
            off.append(point)
    worst = max(off, key=lambda p: p["error"], default=None)
    studies = sorted({p["study"] for p in off})
    marks = ", ".join("?" * len(studies))
    verdicts = db.execute(
        "select n.paper, n.id from rests_on join simulated_behind using (study) "
        "join numbers_and_claims as n on n.paper = rests_on.paper and n.id = rests_on.id "
        f"where source in ({marks}) group by n.rowid order by n.rowid",
        studies,
    ).fetchall()
    numbers: dict[str, list[int]] = {}
    for point in off:
        numbers.setdefault(point["study"], []).append(point["point"])
    return Missed(
        count["points"],
        len(off),
        count["requested"],
        count["missed by request"],
        count["estimated"],
        count["not_estimated"],
        _reasons([point for point in off if point["fixed"]]),
        worst["error"] if worst else 0.0,
        f"{worst['study']} ({_largest(worst)})" if worst else "",
        verdicts,
        without_points(db, verdicts, numbers),
    )


def _reasons(off: list[dict[str, Any]]) -> list[tuple[str, int, list[str]]]:
    """Why points are off, how many and where, the most frequent reason first."""
    many = Counter(point["because"] for point in off)
    return [
        (why, points, sorted({point["study"] for point in off if point["because"] == why}))
        for why, points in many.most_common()
    ]


def run_facts(db: sqlite3.Connection) -> str:
    """Tier, version, engine, points and time, in one line."""
    about = [
        listed(str(row[0]) for row in db.execute(f"select distinct {name} from {table} order by 1"))
        for name, table in (
            ("tier", "studies where tier is not null"),
            ("riserstudy", "about"),
            ("engine", "points"),
        )
    ]
    return f"Tier {about[0]}; riserstudy {about[1]}, engine {about[2]}"
