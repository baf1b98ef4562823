"""The first line of a ``.4`` file: a row is read or refused, and only a heading without a row is skipped."""

import numpy as np
import pytest

from riserstudy.errors import InputError
from riserstudy.importers.wamit import from_wamit

HEADINGS = (
    "",
    "  PER  BETA  I  MOD  PHA  RE  IM",
    "WAMIT 7.2, hull of 12 May",
    "RAOs",
    "# semi, draught 20 m",
)


def rows_of(draw):
    """Words of rows of one mode and heading."""
    periods = np.sort(draw.uniform(5.0, 25.0, int(draw.integers(2, 6))))
    return [[f"{p:.6E}", "0.0", "3", *(f"{x:.6E}" for x in (m, 0.0, m, 0.0))]
            for p, m in zip(periods, np.sort(draw.uniform(0.1, 1.0, len(periods))), strict=True)]  # fmt: skip


def written(path, rows, heading="", mark=""):
    lines = [*([heading] if heading else []), *(" ".join(row) for row in rows)]
    path.write_text(mark + "\n".join(lines), "utf-8")
    return path


@pytest.mark.parametrize("seed", range(12))
def test_a_byte_order_mark_and_a_heading_change_nothing(tmp_path, seed):
    draw = np.random.default_rng(seed)
    rows = rows_of(draw)
    plain = from_wamit(written(tmp_path / "plain.4", rows), 1.0)
    assert len(plain.rows) == len(rows)
    heading = HEADINGS[seed % len(HEADINGS)]
    for mark in ("", "\ufeff"):
        assert from_wamit(written(tmp_path / "same.4", rows, heading, mark), 1.0) == plain


@pytest.mark.parametrize("seed", range(24))
def test_a_row_that_cannot_be_read_is_refused_in_the_first_line_too(tmp_path, seed):
    draw = np.random.default_rng(seed)
    rows = rows_of(draw)
    heading = HEADINGS[int(draw.integers(len(HEADINGS)))]
    column = int(draw.integers(7))
    if seed % 4 == 3:  # a number fills its column, and no space is left
        column = min(column, 5)
        rows[0][column : column + 2] = [f"{rows[0][column]}-1.0"]
    else:
        rows[0][column] = ("2.0-100", "*****", "nan")[seed % 4]
    line = 1 + bool(heading)
    with pytest.raises(InputError, match=rf"line {line}\b.*write numbers"):
        from_wamit(written(tmp_path / "semi.4", rows, heading), 1.0)
