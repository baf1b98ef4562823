"""Words of a sentence that are not known before it is written."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable


def listed(words: Iterable[str]) -> str:
    """Return words as a list in a sentence: ``a, b and c``; ``none`` without words."""
    *most, last = list(words) or ["none"]
    return f"{', '.join(most)} and {last}" if most else last


def counted(count: int, thing: str, written: Callable[[int], str] = str) -> str:
    """Return a count with its noun: ``1 seed``, ``26280 rows``; ``written`` gives the digits."""
    return f"{written(count)} {thing}" if count == 1 else f"{written(count)} {thing}s"


def sentence(text: str) -> str:
    """Return a text with a capital at its start and a full stop at its end; a symbol at its start stays."""
    symbol = re.match(r"(?!a\b)([a-z]|nu|phi|pi|rho)\b|[A-Za-z]\w*_", text)
    return (text if symbol else text[:1].upper() + text[1:]).rstrip(".") + "."
