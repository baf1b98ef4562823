"""CSV files: they are written whole or not at all, and texts in them stay texts in a spreadsheet.

A spreadsheet interprets a cell that begins with one of ``=+-@``, or with a tab, as a formula, which may fetch
a page or start a program. Names and labels come from scenes of any origin. Such a text therefore gets an
apostrophe in front, which marks a text in spreadsheets; numbers are unchanged.

References
----------
OWASP Foundation, CSV Injection: cells that are formulas, and the apostrophe as protection.
"""

from __future__ import annotations

import csv
import io
import re
import string
import unicodedata
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from riserstudy.files.whole import whole_file

#: start of a formula, after characters that spreadsheets may ignore: space, control and invisible ones
_FORMULA = re.compile(r"[\s\x00-\x1f\x7f\xad\u200b-\u200f\u2060\ufeff]*[=+\-@\t\n]")
#: first characters of texts that are no formula
_PLAIN = frozenset(string.ascii_letters + string.digits)
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?inf|nan", re.ASCII)


def csv_text(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """Return a header and rows as CSV; a value other than text is written by ``str``, None as empty cell."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([_written(cell) for cell in header])
    writer.writerows([_written(cell) for cell in row] for row in rows)
    return text.getvalue()


def write_csv(target: Path, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Write a CSV file, whole or not at all.

    Raises SimulationError when the file cannot be written, for example on a full disk.
    """
    with whole_file(target) as partial:
        partial.write_text(csv_text(header, rows), "utf-8", newline="")


def read_csv(path: Path) -> list[dict[str, str]]:
    """Return the rows of a CSV file written by this module, by column name, with the original texts."""
    with path.open(newline="", encoding="utf-8") as file:
        return [
            {_as_it_was(name): _as_it_was(cell or "") for name, cell in row.items()}
            for row in csv.DictReader(file)
        ]


def _written(cell: Any) -> Any:
    if not isinstance(cell, str) or (cell[:1] in _PLAIN and "\r" not in cell):
        return cell
    # the writer does not quote a line that ends with "\r" alone; the text after it would be a cell
    cell = cell.replace("\r\n", "\n").replace("\r", "\n")
    return f"'{cell}" if _is_formula(cell) else cell


def _as_it_was(cell: str) -> str:
    return cell[1:] if cell.startswith("'") and _is_formula(cell[1:]) else cell


def _is_formula(text: str) -> bool:
    """Return whether a spreadsheet could read a text as a formula, without its leading apostrophe if any."""
    bare = unicodedata.normalize("NFKC", text.lstrip("'"))
    return bool(_FORMULA.match(bare)) and not _NUMBER.fullmatch(bare)
