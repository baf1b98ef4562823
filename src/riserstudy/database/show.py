"""Answers as text for a screen, as CSV or as JSON; numbers are rounded only on a screen."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

from riserstudy.database.ask import Answer
from riserstudy.dataset.table import aligned
from riserstudy.errors import InputError, printable

WIDEST = 60  # most characters of a text on a screen


def headings(answer: Answer, units: Mapping[str, str]) -> list[str]:
    """Return the headings of the columns, with their units as in ``x_max (m)``."""
    return [f"{name} ({units[name]})" if name in units else name or "" for name in answer.columns]


def as_table(answer: Answer, units: Mapping[str, str] | None = None) -> list[str]:
    """Return the lines of a table with aligned columns; numbers have six digits."""
    right = [
        all(value is None or isinstance(value, int | float) for value in values)
        for values in zip(*answer.rows, strict=True)
    ]
    return aligned([headings(answer, units or {}), *([*map(_cell, row)] for row in answer.rows)], right)


def _cell(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, float):
        return f"{value:.6g}"
    text = printable(value)
    return text if len(text) <= WIDEST else f"{text[: WIDEST - 4]} ..."


def as_json(answer: Answer) -> str:
    """Return a JSON list of objects; a value that JSON has no number for becomes null or text.

    Raises InputError when two columns have one name, of which an object has only the second.
    """
    if twice := next((name for name in answer.columns if answer.columns.count(name) > 1), None):
        raise InputError("--json", twice, "two columns have this name", "rename one of them with 'as'")
    rows = [dict(zip(answer.columns, map(_plain, row), strict=True)) for row in answer.rows]
    return json.dumps(rows, indent=1, ensure_ascii=False, allow_nan=False)


def _plain(value: Any) -> Any:
    if isinstance(value, bytes):
        return value.hex()
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value
