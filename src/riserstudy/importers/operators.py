"""A table of response amplitude operators (RAOs) in the form that a scene reads, from any file.

The axes are those of scenes: x, y to port of it, z up.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from riserstudy.errors import InputError
from riserstudy.files.csv_files import write_csv
from riserstudy.scene.rao import MOTIONS

# share by which numbers that are equal may differ as printed
ROUNDED = 2e-3
SAME = 1e-4  # largest difference of headings that count as equal (deg)
HEADING = "heading (deg)"
STILL = 1e-9  # largest motion that is rounding (m/m, rad/m)


class Operators(NamedTuple):
    """A table of RAOs in the form that a scene reads."""

    columns: list[str]  # with their units
    rows: list[list[float]]
    phases: str  # lead or lag
    left_out: list[str]


def once_a_turn(path: Path, found: Operators) -> Operators:
    """Return the RAOs without a heading that repeats another after a full turn, as in files to 360 deg.

    Motions that are zero in all waves are left out, too. Raises InputError when the responses at these two
    headings differ, or a wave occurs twice.
    """
    found = _without_still_motions(found)
    if HEADING not in found.columns:
        return found
    tables: dict[float, list[list[float]]] = {}
    for row in found.rows:
        tables.setdefault(row[1], []).append(row)
    for heading, rows in tables.items():
        waves = [row[0] for row in rows]
        if twice := next((wave for k, wave in enumerate(waves) if wave in waves[:k]), None):
            at = f"the wave with a {found.columns[0]} of {twice:g} occurs twice"
            raise InputError(path, f"heading {heading:g} deg", at, "remove one of the two")
    kept: dict[float, list[list[float]]] = {}
    for heading, rows in tables.items():
        twin = next((k for k in kept if abs(math.remainder(k - heading, 360.0)) < SAME), None)
        if twin is None:
            kept[heading] = rows
        elif _same(found.columns, kept[twin], rows):
            found.left_out.append(f"heading {heading:g} deg: that of {twin:g} deg")
        else:
            at = f"the response differs from the response at {twin:g} deg, which is the same heading"
            raise InputError(path, f"heading {heading:g} deg", at, "remove one of the two")
    return found._replace(rows=[row for rows in kept.values() for row in rows])


def _without_still_motions(found: Operators) -> Operators:
    """Return the RAOs without motions of no size, which would make a riser in a plane one in space.

    A symmetric hull in head seas does not sway, roll or yaw, but files have these columns.
    """
    sizes = np.array(found.rows)[:, 2::2]
    still = (sizes < STILL).all(axis=0)
    if not still.any() or still.all():
        return found
    kept = [0, 1, *(at for k in np.flatnonzero(~still) for at in (2 + 2 * int(k), 3 + 2 * int(k)))]
    names = [found.columns[2 + 2 * int(k)].partition(" ")[0] for k in np.flatnonzero(still)]
    left_out = [*found.left_out, *(f"{name}: zero in all waves" for name in names)]
    rows = [[row[at] for at in kept] for row in found.rows]
    return found._replace(columns=[found.columns[at] for at in kept], rows=rows, left_out=left_out)


def _same(columns: list[str], one: list[list[float]], other: list[list[float]]) -> bool:
    """Return whether printed responses at two headings agree; rows of period, heading, sizes and phases.

    ``columns``: headings of the table. Displacements and rotations have different units, so each are compared
    with the largest of their kind.
    """
    if len(one) != len(other) or [row[0] for row in one] != [row[0] for row in other]:
        return False
    values = []
    for rows in (one, other):
        table = np.array(rows)
        values.append(table[:, 2::2] * np.exp(1j * np.radians(table[:, 3::2])))
    off, size = np.abs(values[0] - values[1]), np.abs(values[0])
    turns = np.array(["rad/m" in name for name in columns[2::2]])
    kinds = [kind for kind in (turns, ~turns) if kind.any()]
    return all(off[:, kind].max() <= ROUNDED * size[:, kind].max() for kind in kinds)


def columns_of(motions: list[str]) -> list[str]:
    """Return the headings of size and phase of each motion, with their units."""
    units = {name: "m/m" if name in MOTIONS[:3] else "rad/m" for name in motions}
    return [x for name in motions for x in (f"{name} ({units[name]})", f"{name}_phase (deg)")]


def write_table(found: Operators, target: Path) -> None:
    """Write RAOs as the CSV table that ``platform.response.operators`` reads."""
    write_csv(target, found.columns, ([f"{cell:.10g}" for cell in row] for row in found.rows))


def lines_of_scene(found: Operators, target: Path) -> str:
    """Return the lines that the scene needs in addition to the table."""
    headed = ", headings: towards" if HEADING in found.columns else ""
    return f"platform.response: {{operators: {{file: {target.name}}}, phases: {found.phases}{headed}}}"
