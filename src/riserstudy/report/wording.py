"""Format of numbers and names in the report."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable
from functools import partial

from markupsafe import Markup, escape

from riserstudy.records import words
from riserstudy.records.numerals import duration
from riserstudy.records.words import listed

DEGREES = ("deg", "degree")
RAISED = str.maketrans("23456789", "²³⁴⁵⁶⁷⁸⁹")
_DOI = re.compile(r"\b10\.\d{4,9}/[^\s,;<>&]*[^\s,;.<>&]")
_NUMBER = re.compile(r"(?<![\w.])[-+]?\d+\.?\d*(?:e[-+]?\d+)?(?![\w.])", re.IGNORECASE)


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


def sentence(text: str) -> str:
    """Return a text with a capital at its start and a full stop at its end; a symbol at its start stays."""
    symbol = re.match(r"(?!a\b)([a-z]|nu|phi|pi|rho)\b|[A-Za-z]\w*_", text)
    return (text if symbol else text[:1].upper() + text[1:]).rstrip(".") + "."


def with_links(text: str) -> Markup:
    """Return a text whose DOIs are links."""
    return Markup(_DOI.sub(lambda m: f'<a href="https://doi.org/{m[0]}">{m[0]}</a>', str(escape(text))))


def unit(name: str) -> str:
    """Return a unit as written after a number, as in `` m/s`` for ``m s-1``; empty for a pure number.

    No library writes it so: pint sorts the factors by letters, and a moment in ``m·N`` reads as millinewton;
    it also refuses names such as ``bar absolute``. The notation has three parts, hence these few lines.
    """
    if name in ("", "1"):
        return ""
    if name in DEGREES:
        return "°"
    above: list[str] = []
    below: list[str] = []
    for part in name.split():
        factor = re.fullmatch(r"([A-Za-z]+)(-?)(|[1-9])", part)
        if factor is None or (factor[2] and not factor[3]):
            return f" {name}"
        power = factor[3].replace("1", "").translate(RAISED)
        (below if factor[2] else above).append(factor[1] + power)
    under = f"({' '.join(below)})" if len(below) > 1 else "".join(below)
    return f" {' '.join(above) or '1'}" + (f"/{under}" if below else "")


def grouped(warnings: Iterable[str]) -> list[tuple[str, list[str], int]]:
    """Combine warnings that differ only in numbers into one, with the range of each number.

    Returns
    -------
    Text, the different warnings that it replaces, and how often they were given.
    """
    kinds: dict[str, list[str]] = {}
    for warning in warnings:
        kinds.setdefault(_NUMBER.sub("\0", warning), []).append(warning)
    return [
        (_filled(kind, [_NUMBER.findall(w) for w in numbers]), list(dict.fromkeys(numbers)), len(numbers))
        for kind, numbers in kinds.items()
    ]


def _filled(kind: str, numbers: list[list[str]]) -> str:
    to = " … " if " to \0" in kind else " to "
    text, *rest = kind.split("\0")
    for place, after in enumerate(rest):
        distinct = sorted({row[place] for row in numbers}, key=float)
        text += (distinct[0] if len(distinct) == 1 else f"{distinct[0]}{to}{distinct[-1]}") + after
    return text


WORDING: dict[str, Callable[..., object]] = {
    "number": number,
    "share": share,
    "duration": partial(duration, digits=3),
    "counted": counted,
    "listed": listed,
    "sentence": sentence,
    "unit": unit,
    "with_links": with_links,
}
