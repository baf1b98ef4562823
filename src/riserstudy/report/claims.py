"""Numbers and claims with their verdicts, for the report."""

from __future__ import annotations

import sqlite3
from collections import Counter
from dataclasses import dataclass, fields
from typing import Any, NamedTuple

from riserstudy.database.ask import rows_by_name
from riserstudy.grading.names import option_name
from riserstudy.grading.reasons import reason, result_rows
from riserstudy.grading.sentences_by_reading import rows_by_reading
from riserstudy.grading.summary import VERDICTS
from riserstudy.grading.verdict_sentences import remarks
from riserstudy.records.graded import Grounds, Influence, ItemResult

#: columns of the database with the same names as fields of a result
AS_IT_IS = tuple(field.name for field in fields(ItemResult))


class ByOption(NamedTuple):
    """Share of the samples that meet the claim, under each option of an input."""

    input: str
    shares: list[tuple[str, int]]


@dataclass(frozen=True)
class Claim(ItemResult):
    """A number or claim, its verdict, and the reason.

    ``why``: one short reason. ``percent``: share (%) of the samples that meet it, None without samples;
    ``band``: its 95 % confidence interval, if samples are enough. ``sentences``: how it was judged.
    ``results``, ``by_reading``: rows of tables.
    """

    why: str
    percent: float | None
    band: tuple[int, int] | None
    sentences: list[str]
    results: list[tuple[str, str]]
    by_reading: list[tuple[str, str]]
    options: list[ByOption]
    grounds: Grounds

    @property
    def anchor(self) -> str:
        """Anchor on the page."""
        return f"claim-{self.paper}-{self.id}"


def read_claims(db: sqlite3.Connection) -> list[Claim]:
    """Return all numbers and claims of the results database, in the order of its tables."""
    return [_claim_of(row) for row in rows_by_name(db, "select * from numbers_and_claims order by rowid")]


def _claim_of(row: dict[str, Any]) -> Claim:
    """Convert a row of the database."""
    grounds = Grounds.from_json(row["grounds"])
    result = ItemResult(**{name: row[name] for name in AS_IT_IS})
    low, high = row["margin_low"], row["margin_high"]
    ends = None if low is None or high is None else (low, high)
    return Claim(
        **vars(result),
        why=reason(result, grounds),
        **_share(grounds),
        sentences=remarks(grounds),
        results=result_rows(result.kind, result.unit, grounds, row["margin"], ends),
        by_reading=rows_by_reading(result.kind, grounds.readings),
        options=[_by_option(of) for of in grounds.decided_by if of.by_option],
        grounds=grounds,
    )


def _share(grounds: Grounds) -> dict[str, Any]:
    """Share (%) of the samples, and its confidence interval."""
    of = grounds.share
    if of is None:
        return {"percent": None, "band": None}
    band = None
    if of.low is not None and of.high is not None:
        band = (round(100 * of.low), round(100 * of.high))
    return {"percent": 100.0 * of.met / of.samples, "band": band}


def _by_option(of: Influence) -> ByOption:
    shares = [(option_name(option), round(100 * share)) for option, share in of.by_option.items()]
    return ByOption(of.name, shares)


def counted_verdicts(claims: list[Claim]) -> list[tuple[str, int]]:
    """Return the number of claims with each verdict, in the order of the legend."""
    counts: Counter[str] = Counter(claim.verdict for claim in claims)
    ordered = [*VERDICTS, *sorted(set(counts) - set(VERDICTS))]
    return [(verdict, counts[verdict]) for verdict in ordered if verdict in counts]
