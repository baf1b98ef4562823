"""Sentences about results by interpretation, and the words that all sentences on verdicts share."""

from __future__ import annotations

from collections.abc import Sequence

from riserstudy.grading.names import option_name
from riserstudy.records.graded import Kind, Reading, ReadingAnswer, Share
from riserstudy.records.words import listed

MANY, NAMED = 12, 6  # of more than MANY interpretations, only NAMED are named
HIT = {"number": ("met", "not met"), "claim": ("true", "false")}
JUDGED = {"number": "the published value is", "claim": "the claim is"}


def by_reading(kind: Kind, readings: Sequence[Reading]) -> str:
    """Results by interpretation: first certain answers, then shares within interpretations."""
    return "; ".join(_by_reading(kind, readings))


def _answers(kind: Kind) -> dict[ReadingAnswer, str]:
    """Words for the results of interpretations, in the order in which they are listed."""
    true, false = HIT[kind]
    return {"true": true, "no difference": "no difference", "false": false}


def summary_by_reading(kind: Kind, readings: Sequence[Reading]) -> str:
    """Sentences with the interpretations for each result, or with their number if they are many."""
    words = _answers(kind)
    subject = capital(JUDGED[kind])
    names: dict[ReadingAnswer, list[str]] = {}
    for reading in readings:
        names.setdefault(reading.answer, []).append(reading_name(reading))
    count = len(readings)
    all_of_them = {1: "the only interpretation", 2: "both interpretations"}
    every = f"{all_of_them.get(count, f'all {count} interpretations')} of the paper"
    if len(names) == 1:
        only = readings[0].answer
        if only == "depends":
            return f"With {every}, the outcome depends on further inputs."
        if only == "no difference":
            return _equal(every)
        if kind == "number" and only == "false" and count > 1:
            none = "neither interpretation" if count == 2 else f"none of the {count} interpretations"
            return f"{subject} met with {none} of the paper."
        return f"{subject} {words[only]} with {every}."
    others, equal = len(names.pop("depends", [])), names.pop("no difference", [])
    order: list[ReadingAnswer] = ["true", "false"]
    found = [(words[answer], names[answer]) for answer in order if answer in names]
    if count <= NAMED // 2 and not others:
        values = not any(isinstance(value, str) for reading in readings for value in reading.place.values())
        noun = "value" if values else "interpretation"

        def named(those: list[str]) -> str:
            return f"the {noun}{'s' if len(those) > 1 else ''} {listed(those)}"

        texts = [f"{subject} {word} with {named(those)}." for word, those in found]
        return " ".join([*texts, *([_equal(named(equal))] if equal else [])])
    texts = []
    if found:
        (word, first), *rest = ((word, len(those)) for word, those in found)
        most = f"{word} with {first} of {count} interpretations of the paper"
        texts.append(f"{subject} {listed([most, *(f'{word} with {n}' for word, n in rest)])}.")
    if equal:
        one, of = len(equal) == 1, "" if found else f" of {count}"
        texts.append(_equal(f"{len(equal)}{of} interpretation{'s'[one:]} of the paper"))
    if others:
        remaining = "one interpretation" if others == 1 else f"{others} interpretations"
        texts.append(f"In {remaining} of the paper, the outcome depends on further inputs.")
    return " ".join(texts)


def _equal(interpretations: str) -> str:
    """The sentence on interpretations with which the compared values do not differ."""
    return f"With {interpretations}, the compared values are nearly equal, so the claim is not true."


def rows_by_reading(kind: Kind, readings: Sequence[Reading]) -> list[tuple[str, str]]:
    """Rows of a table: interpretations, and the result with them; of many, the ones with a rare result."""
    true = HIT[kind][0]
    rows, many = [], len(readings) > MANY
    for answer, plain in _answers(kind).items():
        names = [reading_name(reading) for reading in readings if reading.answer == answer]
        if many and len(names) > NAMED:
            rows.append((f"{len(names)} of {len(readings)} interpretations", plain))
        else:
            rows += [(name, plain) for name in names]
    for reading in readings:
        if reading.answer == "depends":
            inputs = listed([f"“{name}”" for name in reading.decided_by])
            by = f" The outcome depends most on {inputs}." if reading.decided_by else ""
            found = f"{capital(JUDGED[kind])} {share_of(reading.share, true)}."
            rows.append((reading_name(reading), f"{found}{by}"))
    return rows


def _by_reading(kind: Kind, readings: Sequence[Reading]) -> list[str]:
    """Parts of results by interpretation."""
    true = HIT[kind][0]
    parts, many = [], len(readings) > MANY
    for answer, word in _answers(kind).items():
        names = [reading_name(r) for r in readings if r.answer == answer]
        if kind == "number" and answer == "false" and len(names) == len(readings) > 1:
            each = (
                f"none of {len(names)} interpretations" if many else f"no interpretation ({'; '.join(names)})"
            )
            parts.append(f"{true} with {each}")
        elif many and len(names) == len(readings):
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
            by = f", depending most on {listed(reading.decided_by)}" if reading.decided_by else ""
            parts.append(f"with {reading_name(reading)}, {share_of(reading.share, true)}{by}")
    return parts


def reading_name(reading: Reading) -> str:
    """Name of an interpretation by its place on the axes, in quotation marks."""
    name = " / ".join(
        option_name(value) if isinstance(value, str) else f"{axis.replace('_', ' ')} {value:g}"
        for axis, value in reading.place.items()
    )
    return f"“{name}”"


def share_of(share: Share, word: str) -> str:
    """Number of hits among samples, with the interval of their share."""
    percent = f"{100 * share.met / share.samples:.0f} %"
    if share.low is not None and share.high is not None:
        percent += f", 95 % confidence interval {100 * share.low:.0f} to {100 * share.high:.0f} %"
    same = f"; in {share.same}, the compared values are nearly equal" if share.same else ""
    return f"{word} in {share.met} of {all_of(share)} ({percent}{same})"


def all_of(share: Share) -> str:
    """Number of samples, of interpretations, or of cases, which combine both."""
    of = {None: "interpretations", share.samples: "samples"}.get(share.draws, "cases")
    return f"{share.samples} {of}"


def capital(text: str) -> str:
    """Return a text with a capital at its start."""
    return text[:1].upper() + text[1:]
