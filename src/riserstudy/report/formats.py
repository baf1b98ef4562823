"""Format of numbers and names in the report."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import partial

from markupsafe import Markup, escape

from riserstudy.records import words
from riserstudy.records.numerals import duration, spaced
from riserstudy.records.units import RAISED, after_number
from riserstudy.records.words import listed, sentence

LEAST_SHARE = 1e-4  # %, least share that is written with its digits
_MINUS = re.compile(r"(?<![\w.)\]])-(?=\.?\d)")
_UNIT = "%|°|[kMG]?(?:N|Pa|J)|[cmk]?m|m?s|min|h|t|kg|kn|bar|Hz"
_MANY_DIGITS = re.compile(r"(?<![\w.,])\d{5,}(?!\w)")
_BEFORE_UNIT = re.compile(rf"(?<=\d) (?=(?:{_UNIT})(?![A-Za-z\d]))|(?<=\b[kM]N) (?=m\b)")
_REFERENCE = re.compile(r"\b((?:Fig|Eq)s?\.?|Table|section) (?=\d)")
_POWER = re.compile(r"(?<=[\d.\s/(]m)([234])\b|\^([2-9])\b")
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
    if 0.0 < abs(plain) < LEAST_SHARE:
        return f"< {LEAST_SHARE:.4f} %"
    return f"{plain:.0f} %" if abs(plain) >= 10.0 else f"{plain:.2g} %"


def counted(count: int, thing: str) -> str:
    """Return a count with its noun: ``1 figure``, ``9 figures``."""
    return words.counted(count, thing, spaced)


def typeset(text: str) -> str:
    """Return prose with signs as printed: minus signs, powers, and no line break before a unit."""
    text = _POWER.sub(lambda m: (m[1] or m[2]).translate(RAISED), _MINUS.sub("−", text))
    text = _MANY_DIGITS.sub(lambda m: spaced(int(m[0])), text)
    return _REFERENCE.sub("\\1\u00a0", _BEFORE_UNIT.sub("\u00a0", text))


def with_links(text: str) -> Markup:
    """Return a text whose DOIs are links."""
    return Markup(_DOI.sub(lambda m: f'<a href="https://doi.org/{m[0]}">{m[0]}</a>', str(escape(text))))


def parts(name: str) -> list[str]:
    """Return the parts of a dataset's name, between which a line may break: ``design/``, ``recoil_``, ..."""
    return re.findall(r"[^/_]*[/_]|[^/_]+", name)


WORDING: dict[str, Callable[..., object]] = {
    "number": number,
    "share": share,
    "duration": partial(duration, digits=3),
    "counted": counted,
    "listed": listed,
    "sentence": sentence,
    "typeset": typeset,
    "parts": parts,
    "unit": after_number,
    "with_links": with_links,
}
