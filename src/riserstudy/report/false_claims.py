"""Number of deliberately false claims that the grader accepts, for the report."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from scipy.stats import binomtest

from riserstudy.files.csv_files import read_csv
from riserstudy.report.formats import counted

NAME = "false_claims.csv"
BELIEVED = ("holds", "reproduced", "calibrated")
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
    return FalseClaims(_summary(rows), [_of(row) for row in rows])


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


def _summary(rows: list[dict[str, str]]) -> str:
    """Return how many are accepted, undecided and refused, with the 95 % confidence interval of the rate.

    References
    ----------
    Clopper and Pearson (1934): bounds of a share from the number of hits among independent draws.
    """
    count = len(rows)
    accepted = sum(row["accepted"] == "1" for row in rows)
    failing = sum(row["verdict"] == "fails" for row in rows)
    subtle = sum(row["subtle"] == "1" for row in rows)
    originals = {(row["paper"], row["made_from"]): row["verdict_of_that"] for row in rows}
    believed = sum(verdict in BELIEVED for verdict in originals.values())
    high = 100.0 * binomtest(accepted, count).proportion_ci(method="exact").high
    undecided = sum(row["verdict"] == "depends" for row in rows)
    rest = count - accepted - failing - undecided
    others = f" {rest} cannot be graded." if rest else ""
    return (
        f"The checks that judge the claims were tested with {counted(count, 'deliberately false claim')}. "
        f"{subtle} of these differ only slightly from a claim of a paper. "
        f"The checks accept {accepted or 'none'} of the false claims. {failing} fail, "
        f"and {undecided} depend on unspecified inputs.{others} The false-positive rate is "
        f"{100.0 * accepted / count:.0f} % (95 % confidence interval up to {high:.0f} %). The same checks "
        f"accept {believed or 'none'} of the {counted(len(originals), 'original claim')}, from which the "
        "false claims were made."
    )
