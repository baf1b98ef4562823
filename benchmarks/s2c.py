"""Time our engine and its peers on scene S2c, side by side in one process.

Every setting runs once for its errors; then all of them run in turn, round after round, so that a slow
spell of the machine hits all alike, and the first round is dropped. The table goes to
``.cache/bench/s2c.csv`` and, readable, to the screen.
"""

from __future__ import annotations

import argparse
import csv
import os
import platform
import statistics
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import alone  # noqa: F401
import ours
import scene
from peers import c_loop, cabledyn_s2c, exudyn_s2c, moordyn_s2c, openseespy_s2c
from picture import picture

OURS = "ours"
METHODS: dict[str, tuple[Any, Callable[..., dict[str, Any]]]] = {
    OURS: (ours, ours.ours),
    "C loop": (c_loop, c_loop.run),
    "CableDyn": (cabledyn_s2c, cabledyn_s2c.run),
    "MoorDyn": (moordyn_s2c, moordyn_s2c.run),
    "Exudyn": (exudyn_s2c, exudyn_s2c.run),
    "OpenSeesPy": (openseespy_s2c, openseespy_s2c.run),
}
LEVELS = (0.05, 0.01, 0.002, 0.0005)
PATIENCE = 20.0  # s: a setting is not repeated beyond this, but runs twice at least


@dataclass
class Row:
    """One method at one setting; errors are relative, times in s."""

    method: str
    version: str = ""
    scheme: str = ""
    elements: int | None = None
    step: float | None = None
    options: dict[str, Any] = field(default_factory=dict)
    displacement_error: float | None = None
    moment_error: float | None = None
    wall_median: float | None = None
    wall_min: float | None = None
    repeats: int = 0
    ns_per_node_step: float | None = None
    ns_per_node_iteration: float | None = None
    times_ours: float | None = None
    failed: str = ""
    walls: list[float] = field(default_factory=list)
    iterations: int | None = None


def main() -> None:
    """Measure, print and store."""
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("--repeats", type=int, default=5, help="timed rounds (default 5)")
    words.add_argument("--methods", nargs="+", choices=METHODS, default=list(METHODS))
    given = words.parse_args()
    rows = [row for name in given.methods for row in judged(name)]
    for repeat in range(given.repeats + 1):
        for row in rows:
            time_once(row, repeat)
    for row in rows:
        finish(row)
    compare(rows)
    path = store(rows)
    picture(rows, path.with_suffix(".png"), f"{given.repeats} rounds, {processor()}")
    print(table(rows))
    print(by_level(rows))
    print(
        f"One thread, {given.repeats} rounds, {processor()}; stored as {path.name} in {path.parent}"
    )


def judged(name: str) -> list[Row]:
    """A row for each setting of a method, with its errors; or one that says why there is none."""
    module, run = METHODS[name]
    if reason := module.available():
        return [Row(name, failed=f"not available: {reason}")]
    rows = []
    for elements, step, options in module.LADDER:
        row = Row(name, elements=elements, step=step, options=options)
        rows.append(row)
        try:
            result = run(elements, step, moments=True, **options)
        except Exception as error:
            row.failed = f"{type(error).__name__}: {error}".splitlines()[0]
            continue
        meta = result["meta"]
        row.version, row.scheme = meta.get("version", ""), meta["scheme"]
        row.step, row.iterations = meta["step"], meta.get("iterations")
        if meta["failed"]:
            row.failed = "diverged" if meta["failed"] is True else str(meta["failed"])
            continue
        row.displacement_error = scene.displacement_error(result["x"])
        if "moment" in result:
            row.moment_error = scene.moment_error(result["moment_s"], result["moment"])
    return rows


def time_once(row: Row, repeat: int) -> None:
    """Run a setting again; round 0 only warms up."""
    if row.failed or (len(row.walls) >= 2 and sum(row.walls) > PATIENCE):
        return
    try:
        wall = METHODS[row.method][1](row.elements, row.step, **row.options)["wall_seconds"]
    except Exception as error:
        row.failed = f"{type(error).__name__}: {error}".splitlines()[0]
        return
    if repeat:
        row.walls.append(wall)


def finish(row: Row) -> None:
    """Sum up the rounds."""
    if not row.walls:
        return
    row.wall_median, row.wall_min = statistics.median(row.walls), min(row.walls)
    row.repeats = len(row.walls)
    row.ns_per_node_step = 1e9 * row.wall_min * row.step / scene.DURATION / row.elements
    if row.iterations:
        row.ns_per_node_iteration = 1e9 * row.wall_min / row.iterations / row.elements


def compare(rows: list[Row]) -> None:
    """How many times as long a row takes as our cheapest that is at least as accurate.

    By smallest times: on a machine with other work the median says more about that work.
    """
    mine = [r for r in rows if r.method == OURS and r.wall_min]
    for row in rows:
        if row.wall_min is None or row.displacement_error is None:
            continue
        enough = [r.wall_min for r in mine if r.displacement_error <= row.displacement_error]
        if enough:
            row.times_ours = row.wall_min / min(enough)


def cheapest(rows: list[Row], method: str, error: str, level: float) -> Row | None:
    """The method's fastest row whose error is within the level."""
    within = [
        r for r in rows if r.method == method and r.wall_min and (getattr(r, error) or 1.0) <= level
    ]
    return min(within, key=lambda r: r.wall_min, default=None)


def table(rows: list[Row]) -> str:
    """All rows as text."""
    head = (
        f"{'method':<11}{'elements':>9}{'step/s':>10}{'x error':>9}{'M error':>9}"
        f"{'median/ms':>11}{'min/ms':>9}{'ns/node-step':>13}{'ns/node-it.':>12}{'x ours':>8}  note"
    )
    lines = [head, "-" * len(head)]
    for r in rows:
        if r.elements is None:
            lines.append(f"{r.method:<11}{r.failed}")
            continue
        lines.append(
            f"{r.method:<11}{r.elements:>9}{r.step:>10.4g}{_percent(r.displacement_error):>9}"
            f"{_percent(r.moment_error):>9}{_number(r.wall_median, 1e3):>11}"
            f"{_number(r.wall_min, 1e3):>9}{_number(r.ns_per_node_step):>13}"
            f"{_number(r.ns_per_node_iteration):>12}{_number(r.times_ours):>8}  "
            + (r.failed or r.scheme)
        )
    return "\n".join(lines)


def by_level(rows: list[Row]) -> str:
    """The cheapest time of each method at each level of error, and its ratio to ours."""
    out = []
    for error, word in (("displacement_error", "displacement"), ("moment_error", "moment")):
        out.append(
            f"\nCheapest at most this {word} error: smallest time in ms (times ours)\n{'':<11}"
            + "".join(f"{_percent(level):>18}" for level in LEVELS)
        )
        for method in dict.fromkeys(r.method for r in rows):
            line = f"{method:<11}"
            for level in LEVELS:
                best = cheapest(rows, method, error, level)
                mine = cheapest(rows, OURS, error, level)
                if best is None:
                    line += f"{'-':>18}"
                    continue
                ratio = f" ({best.wall_min / mine.wall_min:.1f})" if mine else ""
                line += f"{1e3 * best.wall_min:.1f}{ratio}".rjust(18)
            out.append(line)
    return "\n".join(out) + "\n"


def _percent(value: float | None) -> str:
    return "-" if value is None else f"{100 * value:.3g} %"


def _number(value: float | None, factor: float = 1.0) -> str:
    return "-" if value is None else f"{factor * value:.1f}"


def store(rows: list[Row]) -> Path:
    """Write the table; each line carries the processor and Python, lists as text."""
    path = scene.CACHE / "bench" / "s2c.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = [
        asdict(r) | {"processor": processor(), "python": platform.python_version()} for r in rows
    ]
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(lines[0]))
        writer.writeheader()
        writer.writerows(lines)
    return path


def processor() -> str:
    """Name of the processor and what else keeps it busy."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        name = next(
            line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")
        )
    except (OSError, StopIteration):
        name = platform.processor() or platform.machine()
    return f"{name}, load {os.getloadavg()[0]:.1f}"


if __name__ == "__main__":
    main()
