"""What each level of error costs a method, off the lower edge of its settings; ratios to riserstudy."""

from __future__ import annotations

import itertools
import math
from typing import Any

OURS = "riserstudy"
LEVELS = (0.05, 0.01, 0.002, 0.0005)


def edge(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Of (time, error): those that no faster one beats, from fast to slow."""
    found: list[tuple[float, float]] = []
    for time, error in sorted(points):
        if not found or error < found[-1][1]:
            found.append((time, error))
    return found


def time_at(points: list[tuple[float, float]], level: float) -> float | None:
    """Time at an error, straight in logarithms between settings; None where none errs so little.

    Where even the fastest setting errs less, its time.
    """
    curve = edge(points)
    if not curve or curve[-1][1] > level:
        return None
    if curve[0][1] <= level:
        return curve[0][0]
    for (t0, e0), (t1, e1) in itertools.pairwise(curve):
        if e1 <= level:
            share = math.log(e0 / level) / math.log(e0 / e1)
            return t0 * (t1 / t0) ** share
    return None


def points(rows: list[Any], scene: str, method: str, what: str) -> list[tuple[float, float]]:
    """Shortest time and error of a method's settings."""
    return [
        (row.least, row.errors[what])
        for row in rows
        if (row.scene, row.method) == (scene, method) and row.least and row.errors.get(what)
    ]


def tables(rows: list[Any]) -> str:
    """For each scene and quantity a table in Markdown: time of each method at each level, and its ratio."""
    out = []
    for scene in dict.fromkeys(row.scene for row in rows):
        here = [row for row in rows if row.scene == scene]
        kinds = dict.fromkeys(what for row in here for what in row.errors)
        for what in kinds:
            out.append(_table(here, scene, what))
    return "\n".join(out)


def _table(rows: list[Any], scene: str, what: str) -> str:
    lines = [
        f"| {scene}, {what} | " + " | ".join(f"{100 * level:g} %" for level in LEVELS) + " |",
        "|---" * (len(LEVELS) + 1) + "|",
    ]
    mine = points(rows, scene, OURS, what)
    for method in dict.fromkeys(row.method for row in rows):
        found = points(rows, scene, method, what)
        if not found:
            why = next((row.failed for row in rows if row.method == method and row.failed), "")
            lines.append(f"| {method} | {why} |" + " |" * (len(LEVELS) - 1))
            continue
        cells = []
        for level in LEVELS:
            time, own = time_at(found, level), time_at(mine, level)
            if time is None:
                cells.append(f"not below {100 * min(e for _, e in found):.2g} %")
                continue
            ratio = f" ({time / own:.2g})" if own and method != OURS else ""
            cells.append(f"{1e3 * time:.3g} ms{ratio}")
        lines.append(f"| {method} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"
