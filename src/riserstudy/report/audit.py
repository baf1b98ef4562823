"""Audit of the runs, from the results database: errors, energy, warnings, times.

Only errors of variables that the study keeps count: a variable that is not stored reaches no figure and no
verdict.
"""

from __future__ import annotations

import json
import sqlite3
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from riserstudy.database.ask import rows_by_name
from riserstudy.dataset.limits import NOT_LIMITED
from riserstudy.dataset.variables import quantity_of
from riserstudy.records.numerals import spaced
from riserstudy.records.warning import RunWarning, joint_sentence, warning
from riserstudy.records.words import listed
from riserstudy.report.formats import counted, share
from riserstudy.report.without_points import WithoutPoints, without_points
from riserstudy.scene.fields import in_si
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.study.models import StudyFile
from riserstudy.study.study_model import StudyModel

TOLERANCE = 0.01  # largest accepted estimated error of a point without a requested accuracy
ROUNDING = 1e-9  # excess over a tolerance that is rounding
#: errors with a column in the report's tables
IN_COLUMNS = ("displacement", "moment", "tension", "ufj_angle", "lfj_angle")
#: all estimated errors, as quantities name them
ERRORS = tuple(dict.fromkeys((*IN_COLUMNS, *(name for of in QUANTITIES.values() for name in of.errors))))
LARGEST = ("unexplained_energy", "wall_seconds", *(f"error_{name}" for name in ERRORS))
NO_REASON = "one mesh and one time step are used for all points of the study"
#: points, whether their mesh is prescribed, and their requested accuracy, which an axis may set
POINTS = f"""
with prescribed as (select distinct point from parameters where path like 'analysis.mesh.%'),
  asked as (select point, value from parameters where path = 'analysis.accuracy')
select points.*, points.point in prescribed as fixed, coalesce(asked.value, {TOLERANCE}) as tolerance,
  studies.paper, studies.name, studies.caption, studies.accuracy
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
    counts: list[str]  # errors of the stored variables
    because: str  # why the errors may be large
    off: int  # points whose error is above the tolerance
    mesh: str  # fixed, tuned or refined
    warned: int
    total: float  # of all its points (s)
    longest: float

    @property
    def other_errors(self) -> dict[str, float]:
        """Errors of the dataset's variables that have no column of their own, as sentences call them."""
        names = {"damage": "fatigue damage", **NOT_LIMITED}
        others = [error for error in self.counts if error not in IN_COLUMNS]
        return {names[error]: self.errors[error] for error in others if self.errors[error]}

    @property
    def clean(self) -> bool:
        """Whether no point exceeds the tolerance and none has a warning."""
        return not self.off and not self.warned


class Warned(NamedTuple):
    """Warnings of one kind: joint sentence, number of warnings, and datasets."""

    text: str
    number: int
    datasets: list[str]


class Missed(NamedTuple):
    """Points with an estimated error above the tolerance: how many, why, and which verdicts use them."""

    points: int
    off: int
    requested: int  # points with a requested accuracy
    missed_by_request: int
    estimated: int  # points with prescribed mesh and step and an estimated error
    not_estimated: int  # points of tuned studies without an estimated error
    reasons: list[tuple[str, int, list[str]]]  # reason for missing the tolerance, points, datasets
    worst: float
    where: str
    verdicts: list[tuple[str, str]]  # paper and id of numbers and claims that use such a point
    without: WithoutPoints  # how these verdicts change without such points
    tuned: bool = False  # whether a prescribed mesh or step was tuned to another tolerance
    exact: int = 0  # other points with a requested accuracy and without an estimate: static massless springs

    @property
    def sentences(self) -> str:
        """The same in words."""
        fixed, prescribed = self.off - self.missed_by_request, self.points - self.requested
        if not self.off:
            silent = self.not_estimated + self.exact + prescribed - self.estimated
            known = self.points - silent
            kept = f"At {counted(known, 'grid point')}, the estimated errors are within the tolerance."
            other = f"At {counted(silent, 'further grid point')}, the error was not estimated."
            return f"{kept} {other}" if silent else kept
        requested = self._with_a_tolerance
        points = counted(prescribed, "grid point")
        sentence = (
            f"Mesh and time step are prescribed, instead of a tolerance, at {points}. "
            f"Of the points with a prescribed mesh, the error was estimated at {spaced(self.estimated)}"
        )
        most = share(TOLERANCE)
        if self.tuned:
            most += ", or the tolerance to which mesh and time step were tuned,"
        if not fixed:
            return f"{requested}. {sentence}, and is at most {most}".rstrip(",") + "."
        return (
            f"{requested}. {sentence}, and exceeds {most} at {fixed}. "
            f"The largest estimated error is {share(self.worst)}, in the dataset {self.where}."
        )

    @property
    def _with_a_tolerance(self) -> str:
        """Errors of the points with a requested accuracy, in words."""
        judged = counted(self.requested - self.not_estimated - self.exact, "grid point")
        text = (
            f"{spaced(self.missed_by_request)} of {judged} with a tolerance have larger errors"
            if self.missed_by_request
            else f"At {judged} with a tolerance, the estimated errors are within the tolerance"
        )
        if self.not_estimated:
            more = counted(self.not_estimated, "further grid point")
            their = "its" if self.not_estimated == 1 else "their"
            text += (
                f". At {more} with a tolerance, the error was not estimated, because {their} mesh and "
                "time step were tuned in advance"
            )
        if self.exact:
            more = counted(self.exact, "further grid point")
            text += f". At {more}, the riser is a massless spring in equilibrium, so the mesh causes no error"
        return text


def audit(db: sqlite3.Connection, files: dict[str, StudyFile]) -> list[Row]:
    """Return one row per simulated dataset, in the order of the database."""
    tallies: dict[str, Tally] = {}
    for point in _points(db, files):
        tallies.setdefault(point["study"], Tally(point)).add(point)
    return [tally.row() for tally in tallies.values()]


def relevant_errors(keep: list[str] | None) -> list[str]:
    """Return the errors that count for a study: of the variables that it keeps; None keeps all."""
    if keep is None:
        return list(ERRORS)
    relevant = {error for name in keep for error in QUANTITIES[quantity_of(name)].errors}
    return [error for error in ERRORS if error in relevant]


def _points(db: sqlite3.Connection, files: dict[str, StudyFile]) -> Iterator[dict[str, Any]]:
    """Yield points (there may be a million) with their largest counting error and its possible reason."""
    of_study: dict[str, dict[str, Any]] = {}
    for point in rows_by_name(db, POINTS):
        if point["study"] not in of_study:
            study = _study(files, point)
            because = study.error_because if study and study.error_because else NO_REASON
            counts = relevant_errors(study.keep if study else None)
            tuned = bool(study and study.settings)
            tuned_to = _tuned_to(study, point["accuracy"])
            of_study[point["study"]] = {
                "counts": counts,
                "because": because,
                "tuned": tuned,
                "tuned_to": tuned_to,
            }
        point |= of_study[point["study"]]
        if point["fixed"]:
            point["tolerance"] = point["tuned_to"]
        else:
            point["counts"] = [name for name in point["counts"] if name not in NOT_LIMITED]
        errors = [point[f"error_{name}"] for name in point["counts"]]
        point["has_estimate"] = any(point[f"error_{name}"] is not None for name in ERRORS)
        point["error"] = max((error or 0.0 for error in errors), default=0.0)
        yield point


def _tuned_to(study: StudyModel | None, accuracy: str | None) -> float:
    """Return the tolerance for points with a prescribed mesh and step: the one to which these were tuned.

    ``accuracy``: tolerance of the dataset, to which a job tuned them.
    """
    record = study.tuned if study else None
    written = record.accuracy if record else accuracy if study and study.settings else None
    return (in_si("analysis.accuracy", written)[0] if written else None) or TOLERANCE


def _study(files: dict[str, StudyFile], point: dict[str, Any]) -> StudyModel | None:
    return files[point["paper"]].studies.get(point["name"]) if point["paper"] in files else None


def _misses(point: dict[str, Any]) -> bool:
    return bool(point["error"] > point["tolerance"] * (1.0 + ROUNDING))


def _largest(point: dict[str, Any]) -> str:
    """Return the quantity with the largest error."""
    counts: list[str] = point["counts"]
    return max(counts, key=lambda name: point[f"error_{name}"] or 0.0)


@dataclass
class Tally:
    """Collects the points of a dataset one by one, for its row."""

    first: dict[str, Any]
    points: int = 0
    largest: dict[str, float] = field(default_factory=lambda: dict.fromkeys(LARGEST, 0.0))
    off: int = 0
    fixed: bool = True
    warned: int = 0
    total: float = 0.0

    def add(self, point: dict[str, Any]) -> None:
        """Add a point."""
        self.points += 1
        for name, most in self.largest.items():
            self.largest[name] = max(most, point[name] or 0.0)
        self.off += _misses(point)
        self.fixed = self.fixed and bool(point["fixed"])
        self.warned += bool(point["warnings"])
        self.total += point["wall_seconds"] or 0.0

    def row(self) -> Row:
        """Return the row of the dataset."""
        first, largest = self.first, self.largest
        return Row(
            paper=first["paper"],
            name=first["name"],
            about=first["caption"],
            points=self.points,
            energy=largest["unexplained_energy"],
            errors={name: largest[f"error_{name}"] for name in ERRORS},
            counts=first["counts"],
            because=first["because"] if first["because"] != NO_REASON else "",
            off=self.off,
            mesh="fixed" if self.fixed else "tuned" if first["tuned"] else "refined",
            warned=self.warned,
            total=self.total,
            longest=largest["wall_seconds"],
        )


def warned(db: sqlite3.Connection) -> list[Warned]:
    """Return all warnings, those of one kind together, the most frequent first."""
    of_kind: dict[tuple[str, str], list[tuple[RunWarning, str]]] = {}
    cells = "select study, warnings, warning_records from points where warnings != '' order by point"
    for study, lines, records in db.execute(cells):
        # datasets of earlier versions have only the sentences, or another text for a kind
        told = json.loads(records) if records else [warning(s, "{it}", {"it": s}) for s in lines.splitlines()]
        for one in told:
            of_kind.setdefault((one["kind"], one["text"]), []).append((one, study))
    kinds = []
    for given in of_kind.values():
        warnings, datasets = zip(*given, strict=True)
        kinds.append(Warned(joint_sentence(warnings), len(given), list(dict.fromkeys(datasets))))
    return sorted(kinds, key=lambda one: -one.number)


def missed(db: sqlite3.Connection, files: dict[str, StudyFile]) -> Missed:
    """Return how many points miss the tolerance, why, and which verdicts use such a point."""
    off: list[dict[str, Any]] = []
    count: Counter[str] = Counter()
    for point in _points(db, files):
        missing = _misses(point)
        count["points"] += 1
        count["requested"] += not point["fixed"]
        count["missed by request"] += missing and not point["fixed"]
        count["tuned"] += bool(point["fixed"] and point["tuned_to"] != TOLERANCE)
        count["estimated"] += bool(point["fixed"] and point["has_estimate"])
        silent = not point["fixed"] and not point["has_estimate"]
        count["not_estimated"] += silent and point["tuned"]
        count["exact"] += silent and not point["tuned"]
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
        bool(count["tuned"]),
        count["exact"],
    )


def _reasons(off: list[dict[str, Any]]) -> list[tuple[str, int, list[str]]]:
    """Return reasons for exceeding the tolerance, with points and datasets, the most frequent first."""
    many = Counter(point["because"] for point in off)
    return [
        (why, points, sorted({point["study"] for point in off if point["because"] == why}))
        for why, points in many.most_common()
    ]


def run_facts(db: sqlite3.Connection) -> str:
    """Return tier, version, engine, points and time, in one line."""
    about = [
        listed(str(row[0]) for row in db.execute(f"select distinct {name} from {table} order by 1"))
        for name, table in (
            ("tier", "studies where tier is not null"),
            ("riserstudy", "about"),
            ("engine", "points"),
        )
    ]
    return f"Tier {about[0]}; riserstudy {about[1]}, engine {about[2]}"
