"""Number of deliberately false claims that the grader accepts, for the report."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from riserstudy.files.csv_files import read_csv
from riserstudy.grading.summary import totals_of_false

NAME = "false_claims.csv"
#: how a claim was made false, in words
HOW = {
    "opposite": "the opposite statement",
    "magnitude": "a very different size",
    "sign": "one sign changed",
    "factor": "a number changed by a factor of at most two",
    "limit": "another limit",
    "cases": "two cases exchanged",
}


class FalseClaim(NamedTuple):
    """A false claim and its verdict; ``share``: of the samples in which it holds, "" without samples."""

    paper: str
    made_from: str
    statement: str
    how: str
    share: str
    verdict: str
    verdict_of_that: str


class FalseClaims(NamedTuple):
    """All false claims, and one sentence about their verdicts."""

    sentences: str
    rows: list[FalseClaim]


def false_claims(folder: Path) -> FalseClaims | None:
    """Read the table of a results folder; None if it does not exist or is empty."""
    path = folder / NAME
    rows = read_csv(path) if path.exists() else []
    if not rows:
        return None
    originals = {(row["paper"], row["made_from"]): row["verdict_of_that"] for row in rows}
    subtle = sum(row["subtle"] == "1" for row in rows)
    sentences = totals_of_false([row["verdict"] for row in rows], [*originals.values()], subtle)
    return FalseClaims(sentences, [_of(row) for row in rows])


def _of(row: dict[str, str]) -> FalseClaim:
    share = f"{row['met']} of {row['samples']}" if row["samples"] else ""
    return FalseClaim(
        row["paper"],
        row["made_from"],
        row["statement"],
        HOW.get(row["how"], row["how"]),
        share,
        row["verdict"],
        row["verdict_of_that"],
    )
