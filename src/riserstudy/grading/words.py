"""Sentences about published values and claims; only this module makes them, from records alone."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from riserstudy.grading.names import option_name
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
    Reading,
    ReadingAnswer,
    Settled,
    Share,
    Together,
)
from riserstudy.records.words import listed

DECIDES = 1.0 / 3.0  # smallest share of the outcome's variance that deciding inputs must explain
ROUNDING = 1e-14  # smaller values are rounding errors
MANY, NAMED = 12, 6  # of more than MANY interpretations, only NAMED are named
NOT_ONE = "no single input or pair"  # instead of deciding inputs, if none explains most of the outcome
_HIT = {"number": ("met", "missed"), "claim": ("true", "false")}
_JUDGED = {"number": "the published value is", "claim": "the claim is"}


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


def remarks(kind: Kind, unit: str, grounds: Grounds) -> list[str]:
    """Sentences in addition to the share and the results by option, with the file's note last."""
    return [*_influence(grounds), *filter(None, _further(kind, unit, grounds))]


def _further(kind: Kind, unit: str, grounds: Grounds) -> Iterator[str]:
    """All sentences except shares and deciding inputs."""
    yield grounds.impossible
    yield grounds.not_comparable
    yield from _within(grounds.within)
    yield from _meanings(grounds.words)
    yield from _premise(grounds.premise)
    yield from _missing(grounds.missing)
    yield from _together(grounds.together)
    yield from _chosen(grounds.chosen)
    yield from _settled(grounds.settled)
    for outcome in grounds.outcomes:
        yield _outcome(kind, unit, outcome, grounds.together)
    yield grounds.note


def depends_on(kind: Kind, grounds: Grounds) -> str:
    """Deciding inputs and the number of samples that meet it; "" if the verdict does not depend."""
    if not grounds.because:
        return ""
    if grounds.readings:
        return f"{decided_by(grounds)}: {by_reading(kind, grounds.readings)}"
    return f"{decided_by(grounds)}; {_share(grounds.share, _HIT[kind][0])}" if grounds.share else ""


def by_reading(kind: Kind, readings: Sequence[Reading]) -> str:
    """Results by interpretation: first certain answers, then shares within interpretations."""
    return "; ".join(_by_reading(kind, readings))


def sentences_by_reading(kind: Kind, readings: Sequence[Reading]) -> str:
    """As ``by_reading``, with a sentence for each result."""
    return " ".join(f"{_capital(part)}." for part in _by_reading(kind, readings, f"{_JUDGED[kind]} "))


def _by_reading(kind: Kind, readings: Sequence[Reading], judged: str = "") -> list[str]:
    """Parts of results by interpretation; ``judged``: subject and verb of each."""
    true, false = _HIT[kind]
    words: dict[ReadingAnswer, str] = {"true": true, "no difference": "no difference", "false": false}
    parts, many = [], len(readings) > MANY
    for answer, plain in words.items():
        there = "there is " if judged else ""
        word = f"{there}{plain}" if answer == "no difference" else f"{judged}{plain}"
        names = [reading_name(r) for r in readings if r.answer == answer]
        if many and len(names) == len(readings):
            parts.append(f"{word} with all {len(names)} interpretations")
        elif names and many and len(names) > NAMED:
            parts.append(f"{word} with {len(names)} of {len(readings)} interpretations")
        elif len(names) == len(readings) > 1:
            each = "any" if answer == "no difference" else "every"
            parts.append(f"{word} with {each} interpretation ({'; '.join(names)})")
        elif names:
            parts.append(f"{word} with {listed(names)}")
    for reading in readings:
        if reading.answer == "depends":
            by = f", decided by {listed(reading.decided_by)}" if reading.decided_by else ""
            parts.append(f"with {reading_name(reading)}, {judged}{_share(reading.share, true)}{by}")
    return parts


def reading_name(reading: Reading) -> str:
    """Name of an interpretation by its place on the axes, in quotation marks."""
    name = " / ".join(
        option_name(value) if isinstance(value, str) else f"{value:g}" for value in reading.place.values()
    )
    return f"“{name}”"


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
        names = [influence.name for influence in grounds.decided_by]
        weak = grounds.explained is not None and grounds.explained < DECIDES
        return listed(names) if names and not weak else NOT_ONE
    return ""


def too_few(grounds: Grounds) -> str:
    """The sentence for a claim that is true in all samples, which are too few."""
    are = "sample is" if _fewest(grounds) == 1 else "samples are"
    return f"{_fewest(grounds)} {are} too few: the verdict “holds” requires at least {ENOUGH}."


def _fewest(grounds: Grounds) -> int:
    """Smallest number of samples of any interpretation."""
    shares = [reading.share for reading in grounds.readings] or [grounds.share or Share(0, 1)]
    return min(share.draws or 0 for share in shares)


def margin_in_words(margin: float, low: float | None, high: float | None) -> str:
    """The margin of a verdict in words, as a difference divided by the larger of the compared values."""
    if round(100.0 * margin) == 0:
        text = "The margin of the base case to a change of the outcome is less than 1 %."
    else:
        verb, other = ("agrees", "disagreement") if margin > 0.0 else ("disagrees", "agreement")
        percent = f"{abs(100.0 * margin):.0f} %"
        text = f"The base case {verb} with the paper; its margin to {other} is {percent}."
    if low is None or high is None:
        return text
    ends = list(dict.fromkeys(_signed(end) for end in (low, high)))
    negative = "" if round(100.0 * low) >= 0 else "; a negative margin means disagreement"
    return f"{text} In 90 % of all cases the margin is {' to '.join(ends)} %{negative}."


def _signed(share: float) -> str:
    """A share in per cent with its sign; without a sign if it is rounded to zero."""
    percent = round(100.0 * share)
    return f"{percent:+d}".replace("-", "−") if percent else "0"


def share_in_words(kind: Kind, grounds: Grounds) -> list[str]:
    """Number of samples, or interpretations, that meet it; empty without samples."""
    if grounds.readings:
        return [f"{_capital(by_reading(kind, grounds.readings))}."]
    return [f"{_capital(_share(grounds.share, _HIT[kind][0]))}."] if grounds.share else []


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
    which = _capital(names[0]) if len(names) == 1 else f"The inputs {listed(f'“{name}”' for name in names)}"
    return [f"{which} {word} {100 * grounds.explained:.0f} % of the variance of the outcome."]


def _by_option(kind: Kind, influence: Influence) -> str:
    """Share of the samples that meet it, for each option of a deciding input."""
    options = influence.by_option.items()
    each = "; ".join(f"{option_name(option)} {100 * share:.0f} %" for option, share in options)
    return f"Share of samples {_HIT[kind][0]}, by {influence.name}: {each}." if each else ""


def _within(share: float | None) -> Iterator[str]:
    if share is not None:
        yield f"The number must be met within {100 * share:g} %."


def _meanings(words: Iterable[Meaning]) -> Iterator[str]:
    """Meanings of words of size."""
    for word in words:
        bound, band = f"{100 * word.bound:g} %", f"{100 * word.band:g} %"
        if word.most:
            yield f'"{_capital(word.word)}" means a difference of at most {bound}.'
        elif word.bound == word.band:
            yield (
                f'"{_capital(word.word)}" means a difference of at least {bound}; '
                "a smaller difference counts as no difference."
            )
        else:
            yield (
                f'"{_capital(word.word)}" means a difference of at least {bound}; '
                f"a difference of less than {band} counts as no difference."
            )


def _premise(premise: Premise | None) -> Iterator[str]:
    """Number of samples that meet the premise of a claim."""
    if premise is None:
        return
    if premise.judged:
        yield f"Only the {premise.judged} of {premise.samples} samples that meet the premise are judged."
    else:
        yield f"None of {premise.samples} samples meets the premise, so the base case is judged."


def _missing(missing: Missing | None) -> Iterator[str]:
    """Number of cases without a result."""
    if missing is not None:
        are, they = ("is", "it has") if missing.cases == 1 else ("are", "they have")
        yield f"{missing.cases} of {missing.of} cases {are} left out, because {they} no result."


def _together(together: Together | None) -> Iterator[str]:
    """Values that are judged together with it, and the number of samples that meet it alone."""
    if together is None:
        return
    others, alone = listed(together.others), together.alone
    of = "samples" if alone.draws is not None else "interpretations"
    values = "value" if len(together.others) == 1 else "values"
    yield f"This value counts as met only in cases that also meet the published {values} {others}."
    yield f"Judged alone, this value is met in {alone.met} of {alone.samples} {of}."


def _chosen(chosen: Chosen | None) -> Iterator[str]:
    """Inputs of the base case that were chosen to meet it."""
    if chosen is None:
        return
    then = "Samples vary this choice."
    if not chosen.varied:
        then = "No sample varies this choice, so the agreement proves nothing."
    yield f"To make the base case agree, the following was chosen: {chosen.what}. {then}"


def _settled(settled: Settled | None) -> Iterator[str]:
    """Number of samples after which the verdict was certain."""
    if settled is None:
        return
    percent = f"{100 * settled.confidence:.0f} %"
    if settled.after is None:
        yield (
            f"The share is so close to a bound that {settled.samples} samples do not settle the "
            f"verdict at {percent} confidence."
        )
    else:
        yield (
            f"The first {settled.after} of {settled.samples} samples settle the verdict at "
            f"{percent} confidence."
        )


def _outcome(kind: Kind, unit: str, outcome: Outcome, together: Together | None) -> str:
    """The base case or a further case, with one or many cells; ``together``: judged with other values."""
    true, false = _HIT[kind]
    judged = _JUDGED[kind]
    ends = dict.fromkeys((_plain(outcome.low), _plain(outcome.high)))
    cells = f"the {'value is' if len(ends) == 1 else 'values are'} {' to '.join(ends)}{_unit(unit)}"
    if outcome.readings:
        return f"{outcome.name}: {cells}; {judged} {by_reading(kind, outcome.readings)}."
    share = outcome.share
    if share is not None and share.samples > 1:
        by = f", decided by {listed(outcome.decided_by)}" if outcome.decided_by else ""
        return f"{outcome.name}: {cells}; {judged} {_share(share, true)}{by}."
    same, met = (outcome.same, outcome.met) if share is None else (share.same, share.met)
    if same and not met:
        return f"{outcome.name}: {cells}, which counts as no difference."
    if together is not None:
        others = f"together with {listed(together.others)}"
        return (
            f"{outcome.name}: {cells}; this case {'meets' if met else 'does not meet'} this value {others}."
        )
    return f"{outcome.name}: {cells}, and {judged} {true if met else false}."


def _unit(unit: str) -> str:
    """A unit after a number; degrees have a symbol without a space, a pure number has none."""
    return {"": "", "1": "", "deg": "°"}.get(unit, f" {unit}")


def _share(share: Share, word: str) -> str:
    """Number of hits among samples, with the interval of their share."""
    percent = f"{100 * share.met / share.samples:.0f} %"
    if share.low is not None and share.high is not None:
        percent += f", 95 % interval {100 * share.low:.0f} to {100 * share.high:.0f} %"
    same = f", no difference in {share.same}" if share.same else ""
    of = "samples" if share.draws is not None else "interpretations"
    return f"{word} in {share.met} of {share.samples} {of} ({percent}){same}"


def _plain(value: float) -> str:
    """A number with three digits, without an exponent for usual sizes."""
    return f"{float(f'{value:.3g}'):g}" if abs(value) > ROUNDING else "0"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
