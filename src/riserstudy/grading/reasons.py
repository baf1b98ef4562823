"""The reason for a verdict in a sentence or two, and rows of a table of results, from records alone."""

from __future__ import annotations

from collections.abc import Iterator

from riserstudy.grading.sentences_by_reading import summary_by_reading
from riserstudy.grading.verdict_sentences import (
    alone_in_words,
    decided_by,
    deciding,
    finding_of,
    margin_rows,
    too_few,
    values_of,
)
from riserstudy.records.graded import Grounds, ItemResult, Kind, Share
from riserstudy.records.numerals import percent
from riserstudy.records.units import after_number
from riserstudy.records.words import listed, sentence

Rows = list[tuple[str, str]]


def reason(of: ItemResult, grounds: Grounds) -> str:
    """One short reason for the verdict."""
    if of.verdict == "not comparable":
        return sentence(grounds.not_comparable)
    if of.verdict == "not reproducible":
        return sentence(grounds.impossible or "the paper gives too little information")
    if grounds.readings:
        return _by_reading(of, grounds)
    if of.verdict == "depends":
        if grounds.because == "too few samples":
            true = f"The claim is true in {_samples_that_agree(grounds.share)}. " if grounds.share else ""
            return f"{true}{too_few(grounds)}"
        return _depends(grounds)
    if of.published is not None:
        return _compared(of)
    if grounds.share:
        return f"The claim is true in {_samples_that_agree(grounds.share)}."
    if of.verdict == "calibrated":
        return "The claim is true with a fitted input."
    is_true = "is true" if of.verdict == "holds" else "is not true"
    return f"The claim {is_true}, and no unspecified input affects it."


def _compared(of: ItemResult) -> str:
    """Simulated and published value, and the error."""
    simulated, published = (
        f"{value:.4g}{after_number(of.unit)}" if value is not None else "no value"
        for value in (of.simulated, of.published)
    )
    text = f"The simulation gives {simulated}; the published value is {published}"
    fitted = " An input was fitted to a published value." if of.verdict == "calibrated" else ""
    error = f" (error {percent(of.error)})" if of.error is not None else ""
    return f"{text}{error}.{fitted}"


def _depends(grounds: Grounds) -> str:
    """The sentence that names the deciding inputs."""
    if grounds.because != "inputs":
        return f"The verdict depends on {decided_by(grounds)}."
    names = [f"“{name}”" for name in deciding(grounds)]
    if not names:
        return "No single input or pair of inputs decides the outcome."
    these = "the input" if len(names) == 1 else "the inputs"
    return f"The verdict depends on {these} {listed(names)}."


def _by_reading(of: ItemResult, grounds: Grounds) -> str:
    """The findings under each interpretation, after the deciding input."""
    found = summary_by_reading(of.kind, grounds.readings)
    if grounds.because == "too few samples":
        return f"{found} {too_few(grounds)}"
    if of.verdict == "depends" and grounds.because in ("inputs", "base case"):
        return f"{_depends(grounds)} {found}"
    by = decided_by(grounds)
    return f"{sentence(by)} {found}" if by else found


def _samples_that_agree(share: Share) -> str:
    every = {1: "the only sample", 2: "both samples"}.get(share.samples, f"all {share.samples} samples")
    some = {share.samples: every, 0: f"none of {share.samples} samples"}
    return some.get(share.met, f"{share.met} of {share.samples} samples")


def result_rows(
    kind: Kind, unit: str, grounds: Grounds, margin: float | None, ends: tuple[float, float] | None
) -> Rows:
    """Rows of a table of results.

    Parameters
    ----------
    kind : "number" or "claim".
    unit : unit of the simulated value.
    margin : margin of the base case, -1 to 1; None if not known.
    ends : range of the margins of nine in ten judged cases; None if not known.
    """
    rows = [*_way(grounds), *_influence(grounds)]
    for outcome in grounds.outcomes:
        value, found = values_of(unit, outcome), finding_of(kind, outcome, grounds.together)
        values, are = ("values", "are") if value.several else ("value", "is")
        which = "" if kind == "number" else "by which the claim is judged "
        rows.append((outcome.name, f"The simulated {values} {which}{are} {value.text}; {found}."))
    return rows if margin is None else [*rows, *margin_rows(margin, *(ends or (None, None)))]


def _way(grounds: Grounds) -> Iterator[tuple[str, str]]:
    """Rows on samples, and on values that are judged together."""
    if grounds.share is not None:
        chosen = ", if the paper is interpreted as in the base case" if grounds.readings else ""
        yield "Samples that agree with the paper", f"{grounds.share.met} of {grounds.share.samples}{chosen}"
    if grounds.together is not None:
        alone = alone_in_words(grounds.together)
        yield "Cases that meet this value, alone or together with other values", alone
    if grounds.settled is not None:
        of = grounds.settled
        after = f"more than {of.samples}" if of.after is None else f"{of.after}"
        yield f"Samples needed for the verdict at {100 * of.confidence:.0f} % confidence", after


def _influence(grounds: Grounds) -> Iterator[tuple[str, str]]:
    """A row on the inputs that explain the outcome."""
    names = [f"“{influence.name}”" for influence in grounds.decided_by]
    if grounds.decided_by and grounds.decided_by[0].total_effect is not None:
        effects = (
            f"{name} {100 * (of.total_effect or 0.0):.0f} %"
            for name, of in zip(names, grounds.decided_by, strict=True)
        )
        yield "Total effects on the outcome (variance-based)", ", ".join(effects)
    elif grounds.explained is not None and names:
        share = f"{100 * grounds.explained:.0f} %"
        yield f"Variance of the outcome explained by {listed(names)}", share
    elif grounds.explained is not None:
        yield "Inputs that explain the outcome better than chance", "none, with this number of samples"
