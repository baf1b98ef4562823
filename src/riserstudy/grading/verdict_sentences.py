"""Sentences about published values and claims, from records alone."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from riserstudy.grading.names import option_name
from riserstudy.grading.sentences_by_reading import HIT, JUDGED, all_of, by_reading, capital, share_of
from riserstudy.grading.verdict import ENOUGH
from riserstudy.records.graded import (
    Chosen,
    Grounds,
    Influence,
    Kind,
    Meaning,
    Missing,
    Outcome,
    Premise,
    Settled,
    Share,
    Together,
)
from riserstudy.records.words import listed

DECIDES = 1.0 / 3.0  # smallest share of the outcome's variance that deciding inputs must explain
ROUNDING = 1e-14  # smaller values are rounding errors
NOT_ONE = "no single input or pair"  # instead of deciding inputs, if none explains most of the outcome


def note(kind: Kind, unit: str, grounds: Grounds) -> str:
    """The note of a row: facts that are not in other columns, then the note of the paper's file.

    Parameters
    ----------
    kind : "number" or "claim".
    unit : unit of the simulated value.
    """
    share = [] if grounds.because else share_in_words(kind, grounds)
    by = [] if grounds.readings else grounds.decided_by
    options = [_by_option(kind, influence) for influence in by]
    parts = (*share, *_influence(grounds), *options, *_further(kind, unit, grounds))
    return " ".join(text for text in parts if text)


def remarks(grounds: Grounds) -> list[str]:
    """Sentences about the way of judging, with the file's note last; results are in a table of the report."""
    return [*filter(None, _way(grounds)), *filter(None, [grounds.note])]


def _further(kind: Kind, unit: str, grounds: Grounds) -> Iterator[str]:
    """All sentences except shares and deciding inputs."""
    yield from _way(grounds)
    if grounds.together is not None:
        yield f"Judged alone, the published value is met in {alone_in_words(grounds.together)}."
    yield from _settled(grounds.settled)
    for outcome in grounds.outcomes:
        yield _outcome(kind, unit, outcome, grounds.together)
    yield grounds.note


def _way(grounds: Grounds) -> Iterator[str]:
    """Sentences about the way of judging."""
    yield grounds.impossible
    yield grounds.not_comparable
    yield from _within(grounds.within)
    yield from _meanings(grounds.words)
    yield from _premise(grounds.premise)
    yield from _missing(grounds.missing)
    yield from _together(grounds.together)
    yield from _chosen(grounds.chosen)


def depends_on(kind: Kind, grounds: Grounds) -> str:
    """Deciding inputs and the number of samples that meet it; "" if the verdict does not depend."""
    if not grounds.because:
        return ""
    if grounds.readings:
        return f"{decided_by(grounds)}: {by_reading(kind, grounds.readings)}"
    share = f"; {share_of(grounds.share, HIT[kind][0])}" if grounds.share else ""
    return f"{decided_by(grounds)}{share}"


def decided_by(grounds: Grounds) -> str:
    """Deciding inputs; "" if the verdict does not depend."""
    if grounds.because == "too few samples":
        return f"too few samples ({_fewest(grounds)}; at least {ENOUGH} are needed)"
    if grounds.because == "base case":
        return "the base case"
    if grounds.because == "missing values" and grounds.missing:
        cases = grounds.missing.cases
        return f"{cases} {'case' if cases == 1 else 'cases'} without a result"
    if grounds.because == "inputs":
        names = deciding(grounds)
        return listed(names) if names else NOT_ONE
    return ""


def deciding(grounds: Grounds) -> list[str]:
    """Names of the inputs that decide; empty if none, and no pair, explains most of the outcome."""
    weak = grounds.explained is not None and grounds.explained < DECIDES
    return [] if weak else [influence.name for influence in grounds.decided_by]


def too_few(grounds: Grounds) -> str:
    """The sentence for a claim that is true in all samples, which are too few."""
    are = "sample is" if _fewest(grounds) == 1 else "samples are"
    return f"{_fewest(grounds)} {are} too few for the verdict “holds”, which requires at least {ENOUGH}."


def _fewest(grounds: Grounds) -> int:
    """Smallest number of samples of any interpretation."""
    shares = [reading.share for reading in grounds.readings] or [grounds.share or Share(0, 1)]
    return min(share.draws or 0 for share in shares)


def margin_rows(margin: float, low: float | None, high: float | None) -> list[tuple[str, str]]:
    """Rows of a table: the margin of the base case, and the margins of 90 % of all cases."""
    percent = f"{_signed(margin)} %" if round(100.0 * margin) else "less than 1 %"
    rows = [("Margin of the base case", percent)]
    if low is not None and high is not None:
        ends = dict.fromkeys(_signed(end) for end in (low, high))
        rows.append(("Margins of 90 % of all cases", f"{' to '.join(ends)} %"))
    return rows


def _signed(share: float) -> str:
    """A share in per cent with its sign; without a sign if it is rounded to zero."""
    percent = round(100.0 * share)
    return f"{percent:+d}".replace("-", "−") if percent else "0"


def share_in_words(kind: Kind, grounds: Grounds) -> list[str]:
    """Number of samples, or interpretations, that meet it; empty without samples."""
    if grounds.readings:
        return [f"{capital(by_reading(kind, grounds.readings))}."]
    return [f"{capital(share_of(grounds.share, HIT[kind][0]))}."] if grounds.share else []


def _influence(grounds: Grounds) -> list[str]:
    """Share of the variance that the deciding inputs explain."""
    by = grounds.decided_by
    if by and by[0].total_effect is not None:
        shares = ", ".join(f"{i.name} {100 * (i.total_effect or 0.0):.0f} %" for i in by)
        return [f"Total effects on the outcome (variance-based): {shares}."]
    if grounds.explained is None:
        return []
    if not by:
        return ["With this number of samples, no input explains the outcome better than chance."]
    word = "explains" if len(by) == 1 else "together explain"
    names = [influence.name for influence in by]
    which = capital(names[0]) if len(names) == 1 else f"The inputs {listed(f'“{name}”' for name in names)}"
    return [f"{which} {word} {100 * grounds.explained:.0f} % of the variance of the outcome."]


def _by_option(kind: Kind, influence: Influence) -> str:
    """Share of the samples that meet it, for each option of a deciding input."""
    options = influence.by_option.items()
    each = "; ".join(f"{option_name(option)} {100 * share:.0f} %" for option, share in options)
    return f"Share of samples {HIT[kind][0]}, by {influence.name}: {each}." if each else ""


def _within(share: float | None) -> Iterator[str]:
    if share is not None:
        yield f"The number must be met within {100 * share:g} %."


def _meanings(words: Iterable[Meaning]) -> Iterator[str]:
    """Meanings of words of size."""
    for word in words:
        bound, band = f"{100 * word.bound:g} %", f"{100 * word.band:g} %"
        noun, are = ("words", "are") if " " in word.word else ("word", "is")
        means = f'The {noun} "{word.word}" {are} interpreted as a difference of at'
        if word.most:
            yield f"{means} most {bound}."
        else:
            yield f"{means} least {bound}; values that differ by less than {band} count as equal."


def _premise(premise: Premise | None) -> Iterator[str]:
    """Number of samples that meet the premise of a claim."""
    if premise is None:
        return
    if premise.judged:
        meet = "meets" if premise.judged == 1 else "meet"
        yield (
            f"{premise.judged} of {premise.samples} samples {meet} the premise of the claim; only samples "
            "that meet the premise are judged."
        )
    else:
        yield f"None of {premise.samples} samples meets the premise of the claim, so no sample is judged."


def _missing(missing: Missing | None) -> Iterator[str]:
    """Number of cases without a result."""
    if missing is not None:
        are, they = ("is", "it has") if missing.cases == 1 else ("are", "they have")
        yield f"{missing.cases} of {missing.of} cases {are} left out, because {they} no result."


def _together(together: Together | None) -> Iterator[str]:
    """Values that are judged together with it."""
    if together is None:
        return
    others = listed(together.others)
    values = "value" if len(together.others) == 1 else "values"
    published = f"the other published {values}, {others}"
    yield f"The published value counts as met only if the same inputs also give {published}."


def alone_in_words(together: Together) -> str:
    """Number of samples, interpretations or cases that meet a value judged alone."""
    return f"{together.alone.met} of {all_of(together.alone)}"


def _chosen(chosen: Chosen | None) -> Iterator[str]:
    """Inputs of the base case that were chosen to meet it."""
    if chosen is None:
        return
    then = "The samples also include other values of the chosen input."
    if not chosen.varied:
        then = "No sample varies the chosen assumption, so the agreement of the base case is no evidence "
        then += "for the model."
    yield f"An assumption was chosen so that the base case agrees with the paper: {chosen.what}. {then}"


def _settled(settled: Settled | None) -> Iterator[str]:
    """Number of samples after which the verdict was certain."""
    if settled is None:
        return
    percent = f"{100 * settled.confidence:.0f} %"
    if settled.after is None:
        yield (
            f"{settled.samples} samples are too few for the verdict at {percent} confidence, because the "
            "share of samples that agree is close to a bound of the verdict."
        )
    else:
        yield (
            f"The first {settled.after} of {settled.samples} samples are enough for the verdict at "
            f"{percent} confidence."
        )


def _outcome(kind: Kind, unit: str, outcome: Outcome, together: Together | None) -> str:
    """The base case or a further case, with one or many cells; ``together``: judged with other values."""
    values, finding = values_of(unit, outcome), finding_of(kind, outcome, together)
    return f"{outcome.name}: the {'values are' if values.several else 'value is'} {values.text}; {finding}."


class Values(NamedTuple):
    """The value or the range of values of a case, with its unit, and whether it is a range."""

    text: str
    several: bool


def values_of(unit: str, outcome: Outcome) -> Values:
    """The value or the range of values of a case; ends that have the same first digits are one value."""
    ends = dict.fromkeys((_plain(outcome.low), _plain(outcome.high)))
    return Values(f"{' to '.join(ends)}{_unit(unit)}", len(ends) > 1)


def finding_of(kind: Kind, outcome: Outcome, together: Together | None) -> str:
    """The finding about a case; ``together`` as in ``Grounds``."""
    true, false = HIT[kind]
    judged = JUDGED[kind]
    if outcome.readings:
        found = by_reading(kind, outcome.readings)
        if all(reading.answer == "depends" for reading in outcome.readings):
            return found  # has a subject for each interpretation
        return f"{judged} {found}"
    share = outcome.share
    if share is not None and share.samples > 1:
        by = f", depending most on {listed(outcome.decided_by)}" if outcome.decided_by else ""
        return f"{judged} {share_of(share, true)}{by}"
    same, met = (outcome.same, outcome.met) if share is None else (share.same, share.met)
    if same and not met:
        return "the compared values are nearly equal"
    if together is not None:
        others = f"{'value' if len(together.others) == 1 else 'values'} {listed(together.others)}"
        met_all = "are all met" if met else "are not all met"
        return f"with the same inputs, this published value and the {others} {met_all}"
    return f"{judged} {true if met else false}"


def _unit(unit: str) -> str:
    """A unit after a number; degrees have a symbol without a space, a pure number has none."""
    return {"": "", "1": "", "deg": "°"}.get(unit, f" {unit}")


def _plain(value: float) -> str:
    """A number with three digits, without an exponent for usual sizes."""
    return f"{float(f'{value:.3g}'):g}" if abs(value) > ROUNDING else "0"
