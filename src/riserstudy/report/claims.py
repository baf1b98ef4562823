"""Numbers and claims with their verdicts, for the report."""

from __future__ import annotations

import sqlite3
from collections import Counter
from dataclasses import dataclass, fields
from typing import Any, NamedTuple

from riserstudy.grading.names import option_name
from riserstudy.grading.words import NOT_ONE, alone_in_words, margin_rows, remarks, result_of, too_few
from riserstudy.grading.words_by_reading import rows_by_reading, summary_by_reading
from riserstudy.records.graded import Grounds, Influence, ItemResult, Kind
from riserstudy.records.words import listed
from riserstudy.report.wording import number, sentence, share, unit

VERDICTS = {
    "reproduced": "within the printed rounding or 1 %, with nothing fitted",
    "holds": "true with the assumed inputs, in at least 95 % of the samples, and with every interpretation",
    "depends": "true or false, depending on an omitted input or on an interpretation; or too few samples",
    "fails": "false with the assumed inputs, and in at least 95 % of the samples (published values: in all)",
    "calibrated": "the published value is met, but an input was fitted to a published value",
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
    samples. ``band``: 95 % confidence interval of the share (%), if samples are enough. ``sentences``: how it
    was judged. ``results``: rows of a table, in addition to the row of the samples.
    """

    decided_by: str
    met: int | None
    samples: int | None
    band: tuple[int, int] | None
    sentences: list[str]
    results: list[tuple[str, str]]
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
    def _depends(self) -> str:
        """The sentence that names the deciding inputs."""
        if self.decided_by == NOT_ONE:
            return "No single input or pair of inputs decides the outcome."
        names = [f"“{influence.name}”" for influence in self.grounds.decided_by]
        if self.grounds.because != "inputs" or not names:
            return f"The verdict depends on {self.decided_by}."
        these = "the input" if len(names) == 1 else "the inputs"
        return f"The verdict depends on {these} {listed(names)}."

    @property
    def _by_reading(self) -> str:
        """The findings under each interpretation, after the deciding input."""
        found = summary_by_reading(self.kind, self.grounds.readings)
        if self.grounds.because == "too few samples":
            return f"{found} {too_few(self.grounds)}"
        if self.verdict == "depends" and self.grounds.because in ("inputs", "base case"):
            return f"{self._depends} {found}"
        return f"{sentence(self.decided_by)} {found}" if self.decided_by else found

    @property
    def by_reading(self) -> list[tuple[str, str]]:
        """Rows of a table: interpretations, and the result with them."""
        return rows_by_reading(self.kind, self.grounds.readings)

    @property
    def why(self) -> str:
        """One short reason for the verdict."""
        if self.verdict == "not comparable":
            return sentence(self.grounds.not_comparable)
        if self.verdict == "not reproducible":
            return sentence(self.grounds.impossible or "the paper gives too little information")
        if self.grounds.readings:
            return self._by_reading
        if self.verdict == "depends":
            if self.grounds.because == "too few samples":
                true = f"The claim is true in {self._of_samples}. " if self.samples else ""
                return f"{true}{too_few(self.grounds)}"
            return self._depends
        if self.published is not None:
            simulated, published = (f"{number(v)}{unit(self.unit)}" for v in (self.simulated, self.published))
            text = f"The simulation gives {simulated}; the published value is {published}"
            fitted = " An input was fitted to a published value." if self.verdict == "calibrated" else ""
            return f"{text} (error {share(self.error)}).{fitted}"
        if self.samples:
            return f"The claim is true in {self._of_samples}."
        if self.verdict == "calibrated":
            return "The claim is true with a fitted input."
        is_true = "is true" if self.verdict == "holds" else "is not true"
        return f"The claim {is_true}, and no unspecified input affects it."

    @property
    def _of_samples(self) -> str:
        every = {1: "the only sample", 2: "both samples"}.get(
            self.samples or 0, f"all {self.samples} samples"
        )
        some = {self.samples: every, 0: f"none of {self.samples} samples"}
        return some.get(self.met or 0, f"{self.met} of {self.samples} samples")

    @property
    def agreement(self) -> str:
        """Number of samples that agree with the paper; "" without samples."""
        chosen = ", if the paper is interpreted as in the base case" if self.grounds.readings else ""
        return f"{self.met or 0} of {self.samples}{chosen}" if self.samples else ""


def read_claims(db: sqlite3.Connection) -> list[Claim]:
    """Return all numbers and claims of the results database, in the order of its tables."""
    cursor = db.execute("select * from numbers_and_claims order by rowid")
    names = [column[0] for column in cursor.description]
    return [_claim_of(dict(zip(names, row, strict=True))) for row in cursor]


def _claim_of(row: dict[str, Any]) -> Claim:
    """Convert a row of the database."""
    grounds = Grounds.from_json(row["grounds"])
    results = _results(row["kind"], row["unit"], grounds)
    if row["margin"] is not None:
        results += margin_rows(row["margin"], row["margin_low"], row["margin_high"])
    low, high = row["share_low"], row["share_high"]
    return Claim(
        **{name: row[name] for name in AS_IT_IS},
        band=(round(100 * low), round(100 * high)) if low is not None else None,
        sentences=remarks(grounds),
        results=results,
        options=[_by_option(of) for of in grounds.decided_by if of.by_option],
        grounds=grounds,
    )


def _results(kind: Kind, unit: str, grounds: Grounds) -> list[tuple[str, str]]:
    """Rows of the table of results, without samples and margins."""
    rows = []
    if grounds.together is not None:
        rows.append(
            ("Cases that meet this value, with or without the others", alone_in_words(grounds.together))
        )
    if grounds.settled is not None:
        of = grounds.settled
        after = f"more than {of.samples}" if of.after is None else f"{of.after}"
        rows.append((f"Samples needed for the verdict at {100 * of.confidence:.0f} % confidence", after))
    names = [f"“{influence.name}”" for influence in grounds.decided_by]
    if grounds.decided_by and grounds.decided_by[0].total_effect is not None:
        effects = (
            f"{name} {100 * (of.total_effect or 0.0):.0f} %"
            for name, of in zip(names, grounds.decided_by, strict=True)
        )
        rows.append(("Total effects on the outcome (variance-based)", ", ".join(effects)))
    elif grounds.explained is not None and names:
        rows.append(
            (f"Variance of the outcome explained by {listed(names)}", f"{100 * grounds.explained:.0f} %")
        )
    elif grounds.explained is not None:
        rows.append(
            ("Inputs that explain the outcome better than chance", "none, with this number of samples")
        )
    for outcome in grounds.outcomes:
        value, found = result_of(kind, unit, outcome, grounds.together)
        values, are = ("values", "are") if " to " in value else ("value", "is")
        which = "" if kind == "number" else "by which the claim is judged "
        rows.append((outcome.name, f"The simulated {values} {which}{are} {value}; {found}."))
    return rows


def _by_option(of: Influence) -> ByOption:
    shares = [(option_name(option), round(100 * share)) for option, share in of.by_option.items()]
    return ByOption(of.name, shares)


def counted_verdicts(claims: list[Claim]) -> list[tuple[str, int]]:
    """Return the number of claims with each verdict, in the order of the legend."""
    counts: Counter[str] = Counter(claim.verdict for claim in claims)
    ordered = [*VERDICTS, *sorted(set(counts) - set(VERDICTS))]
    return [(verdict, counts[verdict]) for verdict in ordered if verdict in counts]
