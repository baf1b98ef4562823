"""Format of numbers and names in the report."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import partial

from markupsafe import Markup, escape

from riserstudy.records import words
from riserstudy.records.numerals import duration
from riserstudy.records.units import after_number
from riserstudy.records.words import listed, sentence

_DOI = re.compile(r"\b10\.\d{4,9}/[^\s,;<>&]*[^\s,;.<>&]")


def number(value: object) -> str:
    """Return a number from a table with four digits; text is returned unchanged."""
    try:
        plain = float(str(value))
    except ValueError:
        return str(value)
    return f"{plain:.4g}"


def share(value: object) -> str:
    """Return a share (1) as a percentage with two digits."""
    try:
        plain = 100.0 * float(str(value))
    except ValueError:
        return str(value)
    if math.isnan(plain):
        return ""
    return f"{plain:.0f} %" if abs(plain) >= 10.0 else f"{plain:.2g} %"


def counted(count: int, thing: str) -> str:
    """Return a count with its noun: ``1 figure``, ``9 figures``."""
    return words.counted(count, thing, spaced)


def spaced(count: int) -> str:
    """Return a count as text, as in ``9999`` and ``11 793``: from five digits on, thousands are separated."""
    return f"{count:,}".replace(",", "\u00a0") if abs(count) >= 10_000 else str(count)


def with_links(text: str) -> Markup:
    """Return a text whose DOIs are links."""
    return Markup(_DOI.sub(lambda m: f'<a href="https://doi.org/{m[0]}">{m[0]}</a>', str(escape(text))))


WORDING: dict[str, Callable[..., object]] = {
    "number": number,
    "share": share,
    "duration": partial(duration, digits=3),
    "counted": counted,
    "listed": listed,
    "sentence": sentence,
    "unit": after_number,
    "with_links": with_links,
}
