"""Numbers and claims with their verdicts, for the report."""

from __future__ import annotations

import sqlite3
from collections import Counter
from dataclasses import dataclass, fields
from typing import Any, NamedTuple

from riserstudy.grading.names import option_name
from riserstudy.grading.words import NOT_ONE, margin_in_words, remarks, sentences_by_reading, too_few
from riserstudy.records.graded import Grounds, Influence, ItemResult
from riserstudy.report.wording import counted, number, sentence, share, unit

VERDICTS = {
    "reproduced": "within the printed rounding or 1 %, with nothing fitted",
    "calibrated": "met, but an input was fitted to a published number",
    "holds": "true in the base case and in at least 95 % of the samples (59 or more) of the unspecified "
    "inputs, with every interpretation",
    "depends": "true or false, depending on an input that the paper omits or on an interpretation",
    "fails": "no sample meets the number, or at most 5 % of the samples support the claim",
    "not comparable": "the paper defines the quantity differently",
    "not reproducible": "the paper gives too little information",
}
#: columns of the database with the same names as fields of a claim
AS_IT_IS = (*(field.name for field in fields(ItemResult)), "decided_by", "met", "samples")


class ByOption(NamedTuple):
    """Share of the samples that meet the claim, under each option of an input."""

    input: str
    shares: list[tuple[str, int]]


@dataclass(frozen=True)
class Claim(ItemResult):
    """A number or claim, its verdict, and the reason.

    ``met``, ``samples``: number of samples of the unspecified inputs that meet it, and of all; None without
    samples. ``band``: 95 % interval of the share (%), if samples are enough. ``said``, ``options``: further
    information from the grading.
    """

    decided_by: str
    met: int | None
    samples: int | None
    band: tuple[int, int] | None
    sentences: list[str]
    options: list[ByOption]
    grounds: Grounds

    @property
    def anchor(self) -> str:
        """Anchor on the page."""
        return f"claim-{self.paper}-{self.id}"

    @property
    def percent(self) -> float | None:
        """Share (%) of the samples that meet it."""
        if self.met is None or not self.samples:
            return None
        return 100.0 * self.met / self.samples

    @property
    def _by_reading(self) -> str:
        """The findings under each interpretation, after the deciding input."""
        found = sentences_by_reading(self.kind, self.grounds.readings)
        depends = self.verdict == "depends" and self.grounds.because in ("inputs", "base case")
        if depends and self.decided_by == NOT_ONE:
            return f"{NOT_ONE} of inputs decides the outcome. {found}"
        if self.grounds.because == "too few samples":
            return f"{found} {too_few(self.grounds)}"
        by = f"depends on {self.decided_by}" if depends else self.decided_by
        return f"{by}. {found}" if by else found

    @property
    def why(self) -> str:
        """One short reason for the verdict."""
        if self.verdict == "not comparable":
            return sentence(self.grounds.not_comparable)
        if self.verdict == "not reproducible":
            return sentence(self.grounds.impossible or "the paper gives too little information")
        if self.grounds.readings:
            return sentence(self._by_reading)
        if self.verdict == "depends":
            if self.grounds.because == "too few samples":
                return f"True in {self._of_samples}. {too_few(self.grounds)}"
            if not self.grounds.decided_by and self.grounds.because == "inputs":
                return sentence(f"{self.decided_by} of inputs decides the outcome")
            return f"Depends on {self.decided_by}."
        if self.published is not None:
            simulated, published = (f"{number(v)}{unit(self.unit)}" for v in (self.simulated, self.published))
            text = f"The simulation gives {simulated}; the published value is {published}"
            fitted = " An input was fitted to a published value." if self.verdict == "calibrated" else ""
            return f"{text} (error {share(self.error)}).{fitted}"
        if self.samples:
            return f"True in {self._of_samples}."
        if self.verdict == "calibrated":
            return "True with a fitted input."
        return (
            f"{'True' if self.verdict == 'holds' else 'Not true'}; no unspecified input affects this claim."
        )

    @property
    def _of_samples(self) -> str:
        every = {1: "the only sample", 2: "both samples"}.get(
            self.samples or 0, f"all {self.samples} samples"
        )
        some = {self.samples: every, 0: f"none of {counted(self.samples or 0, 'sample')}"}
        return some.get(self.met or 0, f"{self.met} of {self.samples} samples")

    @property
    def agreement(self) -> str:
        """Number of samples that agree with the paper, in a sentence; "" without samples."""
        if not self.samples:
            return ""
        chosen = "with the interpretation of the base case, " if self.grounds.readings else ""
        agree = "agrees" if self.met in (0, 1) else "agree"
        return sentence(f"{chosen}{self._of_samples} of the unspecified inputs {agree} with the paper")


def read_claims(db: sqlite3.Connection) -> list[Claim]:
    """Return all numbers and claims of the results database, in the order of its tables."""
    cursor = db.execute("select * from numbers_and_claims order by rowid")
    names = [column[0] for column in cursor.description]
    return [_claim_of(dict(zip(names, row, strict=True))) for row in cursor]


def _claim_of(row: dict[str, Any]) -> Claim:
    """Convert a row of the database."""
    grounds = Grounds.from_json(row["grounds"])
    sentences = remarks(row["kind"], row["unit"], grounds)
    if row["margin"] is not None:
        sentences.append(margin_in_words(row["margin"], row["margin_low"], row["margin_high"]))
    low, high = row["share_low"], row["share_high"]
    return Claim(
        **{name: row[name] for name in AS_IT_IS},
        band=(round(100 * low), round(100 * high)) if low is not None else None,
        sentences=sentences,
        options=[_by_option(of) for of in grounds.decided_by if of.by_option],
        grounds=grounds,
    )


def _by_option(of: Influence) -> ByOption:
    shares = [(option_name(option), round(100 * share)) for option, share in of.by_option.items()]
    return ByOption(of.name, shares)


def counted_verdicts(claims: list[Claim]) -> list[tuple[str, int]]:
    """Return the number of claims with each verdict, in the order of the legend."""
    counts: Counter[str] = Counter(claim.verdict for claim in claims)
    ordered = [*VERDICTS, *sorted(set(counts) - set(VERDICTS))]
    return [(verdict, counts[verdict]) for verdict in ordered if verdict in counts]
