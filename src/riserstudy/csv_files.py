"""CSV files: whole or not there, and texts in them stay texts in a spreadsheet.

A spreadsheet takes a cell that begins with one of ``=+-@``, or with a tab, for a formula, which may fetch a
page or start a program. Names and labels come from scenes of anybody. Such a text gets an apostrophe in
front, by which spreadsheets know a text; numbers stay as they are.

References
----------
OWASP Foundation, CSV Injection: which cells are formulas, and the apostrophe against it.
"""

from __future__ import annotations

import csv
import io
import re
import unicodedata
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from riserstudy.folders import whole_file

#: what spreadsheets may leave out before a formula: space, control and invisible characters
_FORMULA = re.compile(r"[\s\x00-\x1f\x7f\xad\u200b-\u200f\u2060\ufeff]*[=+\-@\t\n]")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?inf|nan", re.ASCII)


def csv_text(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """A header and rows as CSV; what is no text is written as Python writes it, None as nothing."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([_written(cell) for cell in header])
    writer.writerows([_written(cell) for cell in row] for row in rows)
    return text.getvalue()


def write_csv(target: Path, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Write a CSV file, whole or not at all.

    Raises
    ------
    SimulationError
        When it cannot be written, as on a full disk.
    """
    with whole_file(target) as partial:
        partial.write_text(csv_text(header, rows), "utf-8", newline="")


def read_csv(path: Path) -> list[dict[str, str]]:
    """Rows of a CSV file that was written here, by the names of its header, texts as they were."""
    with path.open(newline="", encoding="utf-8") as file:
        return [
            {_as_it_was(name): _as_it_was(cell or "") for name, cell in row.items()}
            for row in csv.DictReader(file)
        ]


def _written(cell: Any) -> Any:
    if not isinstance(cell, str):
        return cell
    # a line that ends by "\r" alone is not quoted, and what follows it would be a cell
    cell = cell.replace("\r\n", "\n").replace("\r", "\n")
    return f"'{cell}" if _is_formula(cell) else cell


def _as_it_was(cell: str) -> str:
    return cell[1:] if cell.startswith("'") and _is_formula(cell[1:]) else cell


def _is_formula(text: str) -> bool:
    """Whether a spreadsheet could calculate a text; one that has an apostrophe already, without it."""
    bare = unicodedata.normalize("NFKC", text.lstrip("'"))
    return bool(_FORMULA.match(bare)) and not _NUMBER.fullmatch(bare)
