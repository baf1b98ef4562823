"""Tables as one workbook with a sheet for each; requires the extra ``workbook``."""

from __future__ import annotations

import math
from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path

from riserstudy.dataset.table import Cell, Table, heads
from riserstudy.errors import InputError, on_one_line
from riserstudy.files.whole import whole_file

ENDING = ".xlsx"
WIDEST = 28.0  # largest width of a column, in characters
LONGEST = 1_000_000  # largest number of rows of a sheet


def lacks_library(target: Path) -> InputError | None:
    """The error if no workbook can be written here; None if it can."""
    if find_spec("openpyxl") is not None:
        return None
    allowed = "install it with `pip install 'riserstudy[workbook]'`, or write .csv"
    return InputError(
        "--output", str(target), "writing workbooks requires openpyxl, which is not installed", allowed
    )


def _cell(value: Cell) -> Cell:
    """A cell that a workbook can hold: NaN and infinity become words, control characters escapes."""
    if isinstance(value, str):
        return on_one_line(value)
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def write_workbook(tables: Mapping[str, Table], target: Path) -> None:
    """Write tables as sheets of a workbook, by name.

    Raises InputError when the library that writes workbooks is not installed, or a table is longer than a
    sheet. Raises SimulationError when it cannot be written, as on a full disk.
    """
    if fault := lacks_library(target):
        raise fault
    from openpyxl import Workbook
    from openpyxl.styles import Alignment, Font
    from openpyxl.utils import get_column_letter

    book = Workbook()
    book.remove(book.active)
    for name, table in tables.items():
        if len(table.rows) > LONGEST:
            found = f"the table {name} has {len(table.rows)} rows, and a workbook at most {LONGEST}"
            raise InputError("--output", str(target), found, "write this table as .csv")
        sheet = book.create_sheet(name)
        sheet.append([_cell(head) for head in heads(table)])
        for row in table.rows:
            sheet.append([_cell(cell) for cell in row])
            for cell in sheet[sheet.max_row]:
                if isinstance(cell.value, str):
                    cell.data_type = "s"  # a name that begins like a formula is text
        for k, cell in enumerate(sheet[1], start=1):
            cell.font, cell.alignment = Font(bold=True), Alignment(wrap_text=True, vertical="top")
            words = [len(str(row[k - 1])) for row in table.rows[:200] if isinstance(row[k - 1], str)]
            sheet.column_dimensions[get_column_letter(k)].width = min(WIDEST, max([12, *words]) + 1.0)
        sheet.freeze_panes = "B2"
    with whole_file(target) as partial:
        book.save(partial)
