"""Verdicts without the points whose error is above the tolerance: they are graded again."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from riserstudy.database.names import quoted
from riserstudy.grading.cases import Dropped, regrade
from riserstudy.records.graded import Case, Place

Verdict = tuple[str, str]  # paper and id


class WithoutPoints(NamedTuple):
    """Verdicts, by their change without such points."""

    turned: list[tuple[Verdict, str]]  # with the new verdict
    stand: list[Verdict]
    # their base case, or every case, uses such a point and decides the verdict
    bound: list[Verdict]

    @property
    def turning(self) -> str:
        """Number of verdicts that use such points, and of those that change, in words."""
        count = len(self.turned) + len(self.stand) + len(self.bound)
        used = "1 verdict uses" if count == 1 else f"{count} verdicts use"
        changed, ends = len(self.turned) or "none", "s" if len(self.turned) < 2 else ""
        graded = f"{len(self.turned) + len(self.stand)} " if self.bound else ""
        which = f"the {graded}verdicts{' that can be graded without such points' if self.bound else ''}"
        return (
            f"{used} datasets with points whose error is above the tolerance, or above 1 % without a "
            f"tolerance. If points with larger errors are left out, {changed} of {which} change{ends}"
        )

    @property
    def left(self) -> str:
        """Number of verdicts that cannot be graded again, in words; "" if all can."""
        if not self.bound:
            return ""
        many, their = len(self.bound), "its" if len(self.bound) == 1 else "their"
        rest = "One verdict" if many == 1 else f"{many} verdicts"
        return (
            f"{rest} cannot be graded without points with larger errors, because {their} base case or all "
            f"{their} cases use such points"
        )


def without_points(
    db: sqlite3.Connection, verdicts: Iterable[Verdict], off: Mapping[str, list[int]]
) -> WithoutPoints:
    """Grade verdicts again without the cases that use points with too large errors.

    ``off``: numbers of the points with too large errors, by simulated study.
    """
    dropped = Dropped({study: places(db, study, points) for study, points in off.items()})
    of = WithoutPoints([], [], [])
    for verdict in verdicts:
        query = "select kind, verdict from numbers_and_claims where paper = ? and id = ?"
        kind, graded = db.execute(query, verdict).fetchone()
        cases = [*cases_of(db, verdict)]
        if not any(dropped.touches(case) for case in cases):
            of.stand.append(verdict)
            continue
        outcome = regrade(kind, cases, dropped)
        if outcome is None:
            of.bound.append(verdict)
        elif outcome == graded:
            of.stand.append(verdict)
        else:
            of.turned.append((verdict, outcome))
    return of


def cases_of(db: sqlite3.Connection, verdict: Verdict) -> Iterable[Case]:
    """Return the cases of a number or claim, as the grading wrote them."""
    query = "select place, base, judged, met, same, margin, calibrated, rests_on from margins"
    rows = db.execute(f"{query} where paper = ? and id = ?", verdict)
    for place, base, judged, met, same, margin, calibrated, rests_on in rows:
        yield Case(
            *verdict,
            json.loads(place),
            bool(base),
            bool(judged),
            None if met is None else bool(met),
            bool(same),
            margin,
            bool(calibrated),
            json.loads(rests_on),
        )


def places(db: sqlite3.Connection, study: str, points: Iterable[int]) -> list[Place]:
    """Return the positions of points of a study on its axes."""
    axes, table = db.execute("select axes, table_name from studies where study = ?", (study,)).fetchone()
    query = "select column_name from columns where table_name = ? and role = 'axis' order by position"
    columns = [quoted(name) for (name,) in db.execute(query, (table,))]
    names, wanted = [*json.loads(axes)], {*points}
    rows = db.execute(f"select {', '.join(['point', *columns])} from {quoted(table)}")
    return [dict(zip(names, at, strict=True)) for point, *at in rows if point in wanted]
