"""Time our engine and its peers on the same scenes, side by side in one process.

Every setting runs once for its errors, which warms it up; then all of them run in turn, round after round, so
that a slow spell of the machine hits all alike. Times are processor times of one thread.
Tables and figure go to ``.cache/bench``, and readable to the screen.
"""

from __future__ import annotations

import argparse
import csv
import math
import os
import platform
import statistics
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import alone  # noqa: F401
import current
import heave
import levels
import ours
import ours_current
import ours_heave
import scene
from peers import (
    c_heave,
    c_loop,
    cabledyn_s1,
    cabledyn_s2c,
    cabledyn_s3,
    exudyn_s1,
    exudyn_s2c,
    exudyn_s3,
    moordyn_s1,
    moordyn_s2c,
    moordyn_s3,
    openseespy_s1,
    openseespy_s2c,
    openseespy_s3,
)
from picture import picture

PATIENCE = 10.0  # s: a setting is not repeated beyond this


@dataclass(frozen=True)
class Comparison:
    """A scene, who runs it (a module, or why nobody can), and what of it is compared."""

    about: str
    methods: dict[str, Any]
    errors: dict[str, Callable[[dict[str, Any]], float | None]]
    options: dict[str, Any] = field(default_factory=dict)  # of the run that is judged


def _moment_of_s2c(result: dict[str, Any]) -> float | None:
    return scene.moment_error(result["moment_s"], result["moment"]) if "moment" in result else None


SCENES = {
    "S1": Comparison(
        "equilibrium in a current, 533 m",
        {
            levels.OURS: ours_current,
            "C loop": "it steps; it has no equilibrium to solve for",
            "CableDyn": cabledyn_s1,
            "MoorDyn": moordyn_s1,
            "Exudyn": exudyn_s1,
            "OpenSeesPy": openseespy_s1,
        },
        {
            "displacement": lambda r: current.displacement_error(r["s"], r["x"]),
            "moment": lambda r: current.moment_error(r["moment_s"], r["moment"]),
        },
    ),
    "S2c": Comparison(
        "150 s of surge, 533 m",
        {
            levels.OURS: ours,
            "C loop": c_loop,
            "CableDyn": cabledyn_s2c,
            "MoorDyn": moordyn_s2c,
            "Exudyn": exudyn_s2c,
            "OpenSeesPy": openseespy_s2c,
        },
        {"displacement": lambda r: scene.displacement_error(r["x"]), "moment": _moment_of_s2c},
        {"moments": True},
    ),
    "S3": Comparison(
        "100 s of heave of a pipe hung off, 1800 m",
        {
            levels.OURS: ours_heave,
            "C loop": c_heave,
            "CableDyn": cabledyn_s3,
            "MoorDyn": moordyn_s3,
            "Exudyn": exudyn_s3,
            "OpenSeesPy": openseespy_s3,
        },
        {
            "displacement": lambda r: heave.bottom_error(r["bottom"]),
            "tension": lambda r: heave.tension_error(r["top_tension"]),
        },
    ),
}


@dataclass
class Row:
    """One method at one setting of a scene; errors are relative, times in s of the processor."""

    scene: str
    method: str
    version: str = ""
    scheme: str = ""
    elements: int | None = None
    step: float | None = None
    options: dict[str, Any] = field(default_factory=dict)
    errors: dict[str, float | None] = field(default_factory=dict)
    median: float | None = None
    least: float | None = None
    rounds: int = 0
    iterations: int | None = None
    failed: str = ""
    seconds: list[float] = field(default_factory=list)


def main() -> None:
    """Measure, print and store."""
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("--rounds", type=int, default=5, help="timed rounds (default 5)")
    words.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES))
    words.add_argument("--methods", nargs="+", help="some of them only")
    given = words.parse_args()
    rows = []
    folder = scene.CACHE / "bench"
    for name in given.scenes:
        rows += measured(name, given.methods or list(SCENES[name].methods), given.rounds)
        store(rows, folder / "peers.csv")
    told = f"one thread, {given.rounds} rounds in turns, {processor()}"
    tables = levels.tables(rows)
    (folder / "levels.md").write_text(f"{tables}\n{told}\n")
    picture(rows, folder / "peers.png", told)
    print(f"{table(rows)}\n\n{tables}\n{told}; peers.csv, levels.md and peers.png in {folder}")


def measured(name: str, methods: list[str], rounds: int) -> list[Row]:
    """All settings of a scene, judged and timed."""
    rows = [row for method in methods for row in judged(name, method)]
    for _ in range(rounds):
        for row in rows:
            time_once(row)
    for row in rows:
        if row.seconds:
            row.median, row.least = statistics.median(row.seconds), min(row.seconds)
            row.rounds = len(row.seconds)
    return rows


def judged(name: str, method: str) -> list[Row]:
    """A row for each setting of a method, with its errors; or one that says why there is none."""
    about = SCENES[name]
    module = about.methods[method]
    reason = module if isinstance(module, str) else module.available()
    if reason:
        return [Row(name, method, failed=f"not available: {reason}")]
    rows = []
    for elements, step, options in module.LADDER:
        row = Row(name, method, elements=elements, step=step, options=options)
        rows.append(row)
        try:
            result = module.run(elements, step, **about.options, **options)
        except Exception as error:
            row.failed = f"{type(error).__name__}: {error}".splitlines()[0]
            continue
        meta = result["meta"]
        row.version, row.scheme = meta.get("version", ""), meta["scheme"]
        row.step, row.iterations = meta["step"], meta.get("iterations")
        if meta["failed"]:
            row.failed = "diverged" if meta["failed"] is True else str(meta["failed"])
            continue
        row.errors = {what: error(result) for what, error in about.errors.items()}
    return rows


def time_once(row: Row) -> None:
    """Run a setting again."""
    if row.failed or sum(row.seconds) > PATIENCE:
        return
    try:
        module = SCENES[row.scene].methods[row.method]
        seconds = module.run(row.elements, row.step, **row.options)["seconds"]
    except Exception as error:
        row.failed = f"{type(error).__name__}: {error}".splitlines()[0]
        return
    row.seconds.append(seconds)


def table(rows: list[Row]) -> str:
    """All rows as text."""
    head = (
        f"{'scene':<6}{'method':<11}{'elements':>9}{'step/s':>10}{'x error':>10}{'M, T error':>11}"
        f"{'median/ms':>11}{'min/ms':>9}  note"
    )
    lines = [head, "-" * len(head)]
    for r in rows:
        if r.elements is None:
            lines.append(f"{r.scene:<6}{r.method:<11}{r.failed}")
            continue
        first, second = [*r.errors.values(), None, None][:2]
        lines.append(
            f"{r.scene:<6}{r.method:<11}{r.elements:>9}{_step(r.step):>10}{_percent(first):>10}"
            f"{_percent(second):>11}{_milli(r.median):>11}{_milli(r.least):>9}  " + (r.failed or r.scheme)
        )
    return "\n".join(lines)


def _step(value: float | None) -> str:
    return "-" if value is None or math.isinf(value) else f"{value:.4g}"


def _percent(value: float | None) -> str:
    return "-" if value is None else f"{100 * value:.3g} %"


def _milli(value: float | None) -> str:
    return "-" if value is None else f"{1e3 * value:.3g}"


def store(rows: list[Row], path: Path) -> None:
    """Write the table; each line carries the processor and Python, lists as text."""
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = [asdict(r) | {"processor": processor(), "python": platform.python_version()} for r in rows]
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(lines[0]))
        writer.writeheader()
        writer.writerows(lines)


def processor() -> str:
    """Name of the processor and what else keeps it busy."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        name = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        name = platform.processor() or platform.machine()
    return f"{name}, load {os.getloadavg()[0]:.1f}"


if __name__ == "__main__":
    main()
