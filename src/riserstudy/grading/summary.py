"""Verdicts in words: their legend, and sentences that count them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from scipy.stats import binomtest

from riserstudy.records.graded import Grounds, Verdict
from riserstudy.records.numerals import spaced
from riserstudy.records.words import counted, listed

#: verdicts that accept a value or claim as true
ACCEPTED = ("reproduced", "calibrated", "holds")

#: legend, in the order of verdicts
VERDICTS = {
    "reproduced": "within the printed rounding or 1 %, with nothing fitted",
    "holds": "true with the assumed inputs, in at least 95 % of the samples, and with every interpretation",
    "depends": "true or false, depending on an omitted input or on an interpretation; or too few samples",
    "fails": "false with the assumed inputs, and in at least 95 % of the samples (published values: in all)",
    "calibrated": "the published value is met, but an input was fitted to a published value",
    "not comparable": "the paper defines the quantity differently",
    "not reproducible": "the paper gives too little information",
}
#: verdict of a claim that is true in all samples, of which there are too few
TOO_FEW = "too few samples"
#: words for one and for several verdicts
PLURALS = {
    "reproduced": ("is reproduced", "are reproduced"),
    "holds": ("holds", "hold"),
    TOO_FEW: (
        "is true in all samples, but the samples are too few for the verdict “holds”",
        "are true in all samples, but the samples are too few for the verdict “holds”",
    ),
    "fails": ("fails", "fail"),
    "depends": (
        "can be neither confirmed nor refuted, because it depends on omitted inputs or on an interpretation",
        "can be neither confirmed nor refuted, because they depend on omitted inputs or on an interpretation",
    ),
    "calibrated": ("agrees only with a fitted input", "agree only with a fitted input"),
    "not comparable": ("has another definition in the paper", "have other definitions in the papers"),
    "not reproducible": ("cannot be checked", "cannot be checked"),
}
#: verdicts in the first sentence, and verdicts with a sentence of their own
FIRST = ("reproduced", "holds", "fails", "depends")
APART = (TOO_FEW,)


def totals(verdicts: Sequence[tuple[Verdict, Grounds]]) -> str:
    """Sentences that count the verdicts on all numbers and claims; "" if none is graded.

    Claims that "depend" only because their samples are too few are named apart.
    """
    if not verdicts:
        return ""
    counts = Counter(TOO_FEW if _true_in_too_few(*one) else one[0] for one in verdicts)
    order = sorted(counts, key=[*PLURALS, *counts].index)
    parts = {v: f"{counts[v]} {PLURALS[v][counts[v] > 1] if v in PLURALS else v}" for v in order}
    first = [verdict for verdict in order if verdict in FIRST] or order[:1]
    apart = [verdict for verdict in order if verdict in APART and verdict not in first]
    rest = [verdict for verdict in order if verdict not in (*first, *apart)]
    sentences = [f"Of {len(verdicts)} published values and claims, {listed(parts[v] for v in first)}."]
    sentences += [f"{parts[verdict]}." for verdict in apart]
    if rest:
        left = sum(counts[verdict] for verdict in rest)
        sentences.append(f"Of the remaining {left}, {listed(parts[v] for v in rest)}.")
    if counts[TOO_FEW]:
        sentences.append("The tier standard (make study) has more samples.")
    return " ".join(sentences)


def _true_in_too_few(verdict: Verdict, grounds: Grounds) -> bool:
    """Whether all samples agree with a claim, but are too few for its verdict."""
    few, share = verdict == "depends" and grounds.because == "too few samples", grounds.share
    return few and share is not None and share.met == share.samples > 0


def totals_of_false(verdicts: Sequence[str], originals: Sequence[str], subtle: int) -> str:
    """Sentences that count the verdicts on false claims, with the 95 % confidence interval of the rate.

    Parameters
    ----------
    verdicts : verdicts on the false claims, at least one.
    originals : verdicts on the claims that they were made from.
    subtle : number of false claims that differ only slightly from a claim of a paper.

    References
    ----------
    Clopper and Pearson (1934): bounds of a share from the number of hits among independent draws.
    """
    count = len(verdicts)
    accepted, believed = (sum(verdict in ACCEPTED for verdict in some) for some in (verdicts, originals))
    failing, undecided = verdicts.count("fails"), verdicts.count("depends")
    rest = count - accepted - failing - undecided
    others = f" {rest} false claims cannot be graded." if rest else ""
    high = 100.0 * binomtest(accepted, count).proportion_ci(method="exact").high
    return (
        "The checks that judge the claims were tested with "
        f"{counted(count, 'deliberately false claim', spaced)}. {subtle} of the false claims differ only "
        f"slightly from a claim of a paper. The checks accept {accepted or 'none'} of the false claims. "
        f"{failing} false claims fail, and {undecided} depend on unspecified inputs.{others} "
        f"The false-positive rate is {100.0 * accepted / count:.0f} % (95 % confidence interval up to "
        f"{high:.0f} %). The checks also accept {believed or 'none'} of the "
        f"{counted(len(originals), 'original claim', spaced)}, from which "
        "the false claims were made."
    )
