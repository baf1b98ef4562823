"""Convert response amplitude operators (RAOs) from WAMIT's ``.4`` file to the table of a scene.

Its columns are period or frequency, heading, mode, modulus, phase, real and imaginary part. Headings are
directions towards which waves travel. Phases lead the crest at the origin.

References
----------
WAMIT, Inc., WAMIT User Manual, chapters 3 and 4: motions are made dimensionless by the length ULEN.
"""

from __future__ import annotations

import cmath
import math
from pathlib import Path
from typing import Literal, NamedTuple

from riserstudy.errors import InputError
from riserstudy.importers.operators import HEADING, ROUNDED, Operators, columns_of, once_a_turn
from riserstudy.inputs.number_cell import number_in
from riserstudy.scene.rao import MOTIONS

HEAVE = 3  # its mode
COLUMNS = 7  # of a ``.4`` file
SHORTEST = 4.0  # s: a file whose periods are all shorter probably has frequencies instead
#: m per m of wave: what any platform surges, sways or heaves at some period; the motions of HAMS are divided
#: by density times gravity, 1e4 N/m3
LEAST = 1e-3


class Row(NamedTuple):
    """One number of a ``.4`` file."""

    period: float  # s
    heading: float  # deg
    mode: int  # 1 to 6: surge ... yaw
    value: complex  # a positive angle is a lead


def from_wamit(path: Path, length: float, first: Literal["period", "frequency"] | None = None) -> Operators:
    """Read the RAOs of a ``.4`` file; ``length`` is the length ULEN of its body (m).

    ``first``: whether the first column is the period (s) or the circular frequency (rad/s), WAMIT's input
    IPEROUT; None: the period, unless the numbers contradict it. Raises InputError when it is not such a file,
    contradicts itself, is incomplete, has motions of another program, or when its first column is probably
    not the period.
    """
    rows = [*_rows_of_wamit(path)]
    if first == "frequency":
        rows = [row._replace(period=2.0 * math.pi / row.period if row.period else math.inf) for row in rows]
    waves = [row for row in rows if math.isfinite(row.period) and row.period > 0.0]
    left_out = [
        f"period {p:g}: no wave" for p in sorted({r.period for r in rows} - {r.period for r in waves})
    ]
    left_out += [f"mode {m}: no motion of a platform" for m in sorted({r.mode for r in waves if r.mode > 6})]
    values = {(r.heading, r.period, r.mode): r.value for r in waves if r.mode <= 6}
    if not values:
        allowed = "give a file with modes from 1 to 6 at periods above 0"
        raise InputError(path, "", "the file has no RAOs of platform motions", allowed)
    if len(values) < sum(row.mode <= 6 for row in waves):
        found = "two lines have the same period, heading and mode"
        raise InputError(path, "", found, "delete one of them")
    _refuse_others(path, values, first)
    headings = sorted({heading for heading, _, _ in values})
    periods = sorted({period for _, period, _ in values})
    modes = sorted({mode for *_, mode in values})
    table = []
    for heading in headings:
        for period in periods:
            cells = [period, heading]
            for mode in modes:
                if (heading, period, mode) not in values:
                    found = f"mode {mode} has no line at {heading:g} deg and {period:g} s"
                    allowed = "give each mode a line for every heading and period"
                    raise InputError(path, "", found, allowed)
                value = values[heading, period, mode] / (length if mode > 3 else 1.0)
                cells += [abs(value), math.degrees(cmath.phase(value))]
            table.append(cells)
    names = [MOTIONS[mode - 1] for mode in modes]
    columns = ["period (s)", HEADING, *columns_of(names)]
    return once_a_turn(path, Operators(columns, table, "lead", left_out))


def _refuse_others(path: Path, values: dict[tuple[float, float, int], complex], first: str | None) -> None:
    """Refuse numbers that are probably not WAMIT's motions by period; by heading, period (s) and mode."""
    shifts = [abs(value) for (*_, mode), value in values.items() if mode <= HEAVE]
    if shifts and max(shifts) < LEAST:
        found = f"surge, sway and heave are at most {max(shifts):.2g} m per m of wave"
        allowed = (
            "give motions of a floating platform; in its Wamit_format, HAMS writes motions divided by "
            "density times gravity, with other phases than WAMIT's"
        )
        raise InputError(path, "the moduli", found, allowed)
    if first is None and (why := _no_periods(values)):
        allowed = "add --first-column period or --first-column frequency"
        raise InputError(path, "the first column", why, allowed)


def _no_periods(values: dict[tuple[float, float, int], complex]) -> str:
    """Why numbers by heading, period (s) and mode are probably not by period; empty if they can be.

    A floating body follows long waves, and short waves hardly move it.
    """
    periods = sorted({period for _, period, _ in values})
    if periods[-1] < SHORTEST:
        return f"as periods, all are shorter than {SHORTEST:g} s: they may be frequencies"
    heave = dict.fromkeys(periods, 0.0)
    for (_, period, mode), value in values.items():
        if mode == HEAVE:
            heave[period] = max(heave[period], abs(value))
    shortest, longest = heave[periods[0]], heave[periods[-1]]
    if shortest > 2.0 * longest:
        return (
            f"as periods, heave is {shortest:.3g} m/m at {periods[0]:g} s but {longest:.3g} m/m at "
            f"{periods[-1]:g} s: they may be frequencies"
        )
    return ""


def _rows_of_wamit(path: Path) -> list[Row]:
    rows: list[Row] = []
    for number, line in enumerate(path.read_text("utf-8-sig", "replace").splitlines(), 1):
        words = line.split()
        numbers = [number_in(word.replace("D", "E").replace("d", "e")) for word in words]
        cells = [value for value in numbers if value is not None]
        if len(cells) < len(words):
            if rows or not _is_heading(words, len(cells)):
                found = f"{line.strip()[:40]!r} is not a line of numbers"
                raise InputError(path, f"line {number}", found, "write numbers only")
            continue
        if not cells:
            continue
        if len(cells) != COLUMNS or cells[2] != int(cells[2]):
            whole = f"the mode {cells[2]:g} is not a whole number" if len(cells) == COLUMNS else ""
            found = whole or f"the line has {len(cells)} numbers instead of {COLUMNS}"
            allowed = "write period, heading, mode, modulus, phase, real and imaginary part"
            raise InputError(path, f"line {number}", found, allowed)
        value, polar = complex(*cells[5:]), cmath.rect(cells[3], math.radians(cells[4]))
        if not abs(value - polar) <= ROUNDED * abs(value) + 1e-6:
            found = f"modulus and phase give {polar:.4g}, but real and imaginary part give {value:.4g}"
            raise InputError(path, f"line {number}", found, "check the order of the columns")
        rows.append(Row(cells[0], cells[1], int(cells[2]), value))
    return rows


def _is_heading(words: list[str], numbers: int) -> bool:
    """Return whether a line above the rows, of which so many words are numbers, is not an unreadable row.

    Codes print numbers too long for their column as asterisks, or without the space before the next number.
    """
    return numbers == 0 or (len(words) != COLUMNS and 2 * numbers < len(words))
