"""What becomes of verdicts without the points whose error is above tolerance: from margins of cases."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from riserstudy.grading.verdict import verdict_of_claim, verdict_of_number

Verdict = tuple[str, str]  # paper and id


class Without(NamedTuple):
    """Verdicts by what becomes of them."""

    turned: list[tuple[Verdict, str]]  # with what they are without such points
    stand: list[Verdict]
    bound: list[Verdict]  # every case rests on such a point, which cannot be left out

    @property
    def turning(self) -> str:
        """How many turn, in words."""
        many, ends = len(self.turned) or "none", "s" if len(self.turned) < 2 else ""
        graded = len(self.turned) + len(self.stand)
        return f"Without these points {many} of the {graded} verdicts that can be graded anew turn{ends}"

    @property
    def left(self) -> str:
        """How many cannot be graded anew, in words; "" where all can."""
        return (
            f"{len(self.bound)} cannot, as every case rests on such a point" if self.bound else ""
        )


def without(
    db: sqlite3.Connection,
    verdicts: Iterable[Verdict],
    off: Mapping[str, list[str]],
    judging: Mapping[Verdict, set[str]],
) -> Without:
    """Grade verdicts anew without the cases that rest on points that are off.

    Parameters
    ----------
    off : places of such points, by simulated study.
    judging : datasets whose cases make a verdict; of others only what is told with it is taken.
    """
    behind: dict[str, set[str]] = {}
    for study, source in db.execute("select study, source from simulated_behind"):
        behind.setdefault(study, set()).add(source)
    of = Without([], [], [])
    for verdict in verdicts:
        sources = set().union(*(behind.get(study, set()) for study in judging.get(verdict, set())))
        places = [place for source in sources for place in off.get(source, [])]
        if not places:
            of.stand.append(verdict)
            continue
        kind, graded, at_base = db.execute(
            "select kind, verdict, margin from numbers_and_claims where paper = ? and id = ?",
            verdict,
        ).fetchone()
        rows = db.execute("select place, margin from margins where paper = ? and id = ?", verdict)
        cases = [(_dims(place), margin) for place, margin in rows]
        left = [margin for dims, margin in cases if not any(_rests(dims, at) for at in places)]
        if not left:
            of.bound.append(verdict)
            continue
        # a case without a margin, which is no number, is true of nothing
        true = sum(margin is not None and margin > 0.0 for margin in left)
        share, fitted = true / len(left), graded == "calibrated"
        if kind == "number":
            anew = verdict_of_number((at_base or 0.0) > 0.0, share, fitted)
        else:
            anew = verdict_of_claim(share, fitted)
        if anew == graded:
            of.stand.append(verdict)
        else:
            of.turned.append((verdict, anew))
    return of


def _dims(place: str) -> dict[str, str]:
    """A case's place on its axes: ``sample=3; line=a chord``."""
    return dict(part.split("=", 1) for part in place.split("; ") if part)


def _rests(dims: Mapping[str, str], point: str) -> bool:
    """If a case rests on a point, ``sample=3, speed=1.0``: at the same place on each axis that both have."""
    shared = {name: value for name, value in dims.items() if f", {name}=" in f", {point}"}
    return all(f", {name}={value}," in f", {point}," for name, value in shared.items())
