"""Any text of a scene can be a cell of a workbook, and stays a text on one line."""

import random

import pytest

from riserstudy.dataset.table import Table
from riserstudy.dataset.workbook import write_workbook

openpyxl = pytest.importorskip("openpyxl")
WILD = ["\x00", "\x07", "\x0b", "\x1f", "\n", "\r", "\u2028", "\ufeff", "=1+1", "Überlast", " ", "a"]


@pytest.mark.parametrize("seed", range(20))
def test_any_name_is_written_and_read_again_as_text(seed, tmp_path):
    draw = random.Random(seed)
    names = ["".join(draw.choices(WILD, k=6)) for _ in range(5)]
    table = Table(["section", names[0] or "x"], ["", "m"], [[name, 1.0] for name in names])
    write_workbook({"stack-up": table}, tmp_path / "a.xlsx")
    sheet = openpyxl.load_workbook(tmp_path / "a.xlsx")["stack-up"]
    found = [row[0] for row in sheet.iter_rows(min_row=2, values_only=True)]
    for cell, name in zip(found, names, strict=True):
        assert cell.isprintable()
        # the name itself, but for characters that no line of text can have
        assert cell.encode("latin-1").decode("unicode_escape") == name
