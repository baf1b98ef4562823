"""Tables of grading, with one row per item, case or erratum; the fields of a row are its columns."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields
from typing import Any

from riserstudy.files.csv_files import csv_text
from riserstudy.grading.verdict_sentences import depends_on, note
from riserstudy.records.graded import Graded, ItemResult


@dataclass(frozen=True)
class Row(ItemResult):
    """One line of reproduction.csv: ``depends_on`` and ``note`` describe ``grounds``, which is JSON."""

    depends_on: str
    margin: float | None
    margin_low: float | None
    margin_high: float | None
    note: str
    grounds: str


@dataclass(frozen=True)
class ErratumRow:
    """One line of errata.csv."""

    paper: str
    id: str
    where: str
    printed: str
    reading: str
    simulation: str


def row_of(graded: Graded) -> Row:
    """The line of a published value or claim."""
    same = {f.name: getattr(graded, f.name) for f in fields(Row) if f.name in _SAME}
    return Row(
        **same,
        depends_on=depends_on(graded.kind, graded.grounds),
        note=note(graded.kind, graded.unit, graded.grounds),
        grounds=graded.grounds.to_json(),
    )


_SAME = {field.name for field in fields(Graded)} - {"grounds"}


def table(rows: Iterable[Any], kind: type) -> str:
    """Rows as CSV text with a header; numbers to six digits."""
    header = [field.name for field in fields(kind)]
    return csv_text(header, ([_cell(value) for value in asdict(row).values()] for row in rows))


def _cell(value: Any) -> Any:
    if value is None:
        return ""
    if isinstance(value, dict):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, bool):
        return int(value)
    return f"{value:.6g}" if isinstance(value, float) else value
