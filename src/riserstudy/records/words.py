"""Words of a sentence that are not known before it is written."""

from __future__ import annotations

from collections.abc import Iterable


def listed(words: Iterable[str]) -> str:
    """Return words as a list in a sentence: ``a, b and c``; ``none`` without words."""
    *most, last = list(words) or ["none"]
    return f"{', '.join(most)} and {last}" if most else last


def counted(count: int, thing: str) -> str:
    """Return a count with its noun: ``1 figure``, ``9 figures``."""
    return f"{count} {thing}" if count == 1 else f"{spaced(count)} {thing}s"


def spaced(count: int) -> str:
    """Return a count as text, as in ``9999`` and ``11 793``: from five digits on, thousands are separated."""
    return f"{count:,}".replace(",", "\u00a0") if abs(count) >= 10_000 else str(count)
