"""Limits of a run as a table in plain text, the limit that governs first."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from riserstudy.dataset.limits import EXCEEDED, limit_in_words
from riserstudy.dataset.table import aligned
from riserstudy.dataset.unit_systems import UnitSystem, read_in
from riserstudy.scene.limits import UNITS

HEADS = ("limit", "value", "allowable", "use", "place and time", "verdict")
BEYOND = 1e3  # utilisation from which on no number is printed
ROUNDING = 1e-6  # utilisation that counts as zero


class Line(NamedTuple):
    """A line of the table, and the utilisation of its limit: NaN if it has none."""

    text: str
    use: float


def lines(rows: list[dict[str, Any]], system: UnitSystem = UnitSystem.FIELD) -> list[Line]:
    """A heading, a line per limit in order of decreasing utilisation, and notes on the limits.

    Parameters
    ----------
    rows : limits of a run, as in its dataset.
    system : units of the values.
    """
    if not rows:
        return []
    ordered = sorted(rows, key=_rank)
    cells = [HEADS, *(_cells(row, system) for row in ordered)]
    uses = [math.nan if row["demand"] is None else float(row["utilisation"]) for row in ordered]
    table = [Line(text, use) for text, use in zip(aligned(cells), [math.nan, *uses], strict=True)]
    return table + [Line(note, math.nan) for row in ordered for note in _notes(row)]


def _name(row: dict[str, Any]) -> str:
    return limit_in_words(row["mode"], row["side"], row["output"], row["at"])


def _rank(row: dict[str, Any]) -> tuple[bool, bool, float]:
    """Sort key: exceeded limits first, then by utilisation; limits that could not be evaluated last."""
    return row["demand"] is None, row["verdict"] != EXCEEDED, -float(row["utilisation"] or 0.0)


def _cells(row: dict[str, Any], system: UnitSystem) -> tuple[str, ...]:
    factor, unit = read_in(UNITS[row["output"]], system)
    origin = "" if row["origin"] == "given" else f" ({row['origin']})"
    allowed = f"{factor * row['allowable']:.4g} {unit}{origin}"
    if row["demand"] is None:
        return _name(row), "", allowed, "", "", row["verdict"]
    along = read_in("m", system)
    where = "" if row["s"] is None else f"s = {along.factor * row['s']:.4g} {along.unit}"
    when = "" if row["time"] is None else f"t = {row['time']:.4g} s"
    value = f"{factor * row['demand']:.4g} {unit}"
    place = ", ".join(part for part in (where, when) if part)
    return _name(row), value, allowed, _use(row, value), place, row["verdict"]


def _use(row: dict[str, Any], value: str) -> str:
    """Utilisation of a limit; for a smallest allowable of zero, which has no utilisation, the margin."""
    if row["side"] == "smallest" and row["allowable"] == 0.0:
        return f"margin {value}"
    if not row["utilisation"] < BEYOND:
        return "beyond all"
    share = row["utilisation"]
    return f"{100.0 * share if share > ROUNDING else 0.0:.4g} %"


def _notes(row: dict[str, Any]) -> list[str]:
    """Notes on what a limit includes, and on missing inputs."""
    notes = [row["takes"]] if row.get("takes") else []
    if row["missing"]:
        found = "not evaluated" if row["demand"] is None else "not known everywhere"
        notes.append(f"{found}: {row['missing']}")
    return [f"{_name(row)}: {note}" for note in notes]
