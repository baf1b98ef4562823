"""Whether runs may be believed, asked of the results database: errors, energy, warnings, times."""

from __future__ import annotations

import sqlite3
from typing import Any, NamedTuple

from riserstudy.report.wording import grouped, listed, share

TOLERANCE = 0.01  # estimated error above which a point counts as off, where none is asked for
ROUNDING = 1e-9  # above a tolerance that is none
ERRORS = ("displacement", "moment", "tension")
#: points with whether a mesh is prescribed; the largest of the errors that are estimated
POINTS = f"""
with prescribed as (select distinct point from parameters where path like 'analysis.mesh.%')
select points.*, point in prescribed as fixed,
  max(coalesce(error_displacement, 0), coalesce(error_moment, 0), coalesce(error_tension, 0)) as error,
  coalesce(cast(replace(accuracy, '%', '') as real) / 100, {TOLERANCE}) as tolerance,
  studies.paper, studies.name, studies.caption
from points join studies using (study)
"""


class Row(NamedTuple):
    """One simulated dataset: the worst of its points."""

    paper: str
    name: str
    about: str
    points: int
    energy: float
    errors: dict[str, float]
    off: int  # points whose error is above the tolerance
    fixed: bool  # mesh and step prescribed
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
    asked: int  # points that ask for an accuracy
    asked_off: int
    worst: float
    where: str
    verdicts: list[tuple[str, str]]  # paper and id of numbers and claims that rest on one

    @property
    def said(self) -> str:
        """In words."""
        if not self.off:
            return f"All {self.points} points have estimated errors within their tolerance."
        asked = (
            f"{self.asked_off} of the {self.asked} points that ask for an accuracy miss it"
            if self.asked_off
            else f"All {self.asked} points that ask for an accuracy are estimated to reach it"
        )
        fixed, prescribed = self.off - self.asked_off, self.points - self.asked
        return (
            f"{asked}. Of the {prescribed} points whose mesh and step are prescribed, by a paper or for all "
            f"samples of a study, {fixed} have an estimated error above {share(TOLERANCE)}; the largest is "
            f"{share(self.worst)}, in {self.where}."
        )


def audit(db: sqlite3.Connection) -> list[Row]:
    """A row a simulated dataset, in the order of the database."""
    by_text: dict[str, list[dict[str, Any]]] = {}
    for point in _points(db):
        by_text.setdefault(point["study"], []).append(point)
    return [_row(points) for points in by_text.values()]


def _points(db: sqlite3.Connection) -> list[dict[str, Any]]:
    cursor = db.execute(POINTS)
    names = [column[0] for column in cursor.description]
    return [dict(zip(names, row, strict=True)) for row in cursor]


def _misses(point: dict[str, Any]) -> bool:
    return bool(point["error"] > point["tolerance"] * (1.0 + ROUNDING))


def _largest(point: dict[str, Any]) -> str:
    """The quantity that errs most."""
    return max(ERRORS, key=lambda name: point[f"error_{name}"] or 0.0)


def _row(points: list[dict[str, Any]]) -> Row:
    first = points[0]

    def largest(name: str) -> float:
        return max((p[name] for p in points if p[name] is not None), default=0.0)

    return Row(
        paper=first["paper"],
        name=first["name"],
        about=first["caption"],
        points=len(points),
        energy=largest("unexplained_energy"),
        errors={name: largest(f"error_{name}") for name in ERRORS},
        off=sum(map(_misses, points)),
        fixed=all(p["fixed"] for p in points),
        warned=sum(bool(p["warnings"]) for p in points),
        total=sum(p["wall_seconds"] or 0.0 for p in points),
        longest=largest("wall_seconds"),
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


def missed(db: sqlite3.Connection) -> Missed:
    """How many points miss the tolerance, and which verdicts rest on one."""
    points = _points(db)
    off = [p for p in points if _misses(p)]
    asked = [p for p in points if not p["fixed"]]
    worst = max(off, key=lambda p: p["error"], default=None)
    studies = sorted({p["study"] for p in off})
    marks = ", ".join("?" * len(studies))
    verdicts = db.execute(
        "select distinct rests_on.paper, rests_on.id from rests_on join simulated_behind using (study) "
        f"join numbers_and_claims as n on n.paper = rests_on.paper and n.id = rests_on.id "
        f"where source in ({marks}) order by 1, 2",
        studies,
    ).fetchall()
    return Missed(
        len(points),
        len(off),
        len(asked),
        sum(map(_misses, asked)),
        worst["error"] if worst else 0.0,
        f"{worst['study']} ({_largest(worst)})" if worst else "",
        verdicts,
    )


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
