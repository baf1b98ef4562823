"""Words of a sentence that are not known before it is written."""

from __future__ import annotations

from collections.abc import Iterable


def listed(words: Iterable[str]) -> str:
    """Return words as a list in a sentence: ``a, b and c``; ``none`` without words."""
    *most, last = list(words) or ["none"]
    return f"{', '.join(most)} and {last}" if most else last


def counted(count: int, thing: str) -> str:
    """Return a count with its noun, for messages: ``1 seed``, ``26280 rows``."""
    return f"{count} {thing}" if count == 1 else f"{count} {thing}s"
