"""The number in a cell of a table."""

from __future__ import annotations

import re

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)


def number_in(cell: str) -> float | None:
    """The number in a cell (in the unit of its column), None for anything else.

    Python also reads ``1_5`` as 15, digits of other scripts, ``inf`` and ``nan``: none of these is a number
    here.
    """
    text = cell.strip()
    return float(text) if _NUMBER.fullmatch(text) else None
