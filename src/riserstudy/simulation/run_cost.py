"""Cost of runs, and times in words."""

from __future__ import annotations

from typing import Any

from riserstudy.dataset.result import Result

COSTS = ("elements", "step", "newton_iterations", "solve_seconds")  # facts of a run


def cost(run: Result) -> dict[str, Any]:
    """Cost of a run, by the names in `COSTS`; None for a fact that the run does not have."""
    return {name: run.facts.get(name) for name in COSTS}


def total_seconds(runs: list[dict[str, Any]]) -> float:
    """Elapsed time (s) of runs together, from their costs."""
    return float(sum(one["solve_seconds"] for one in runs))


def duration(seconds: float, digits: int = 2) -> str:
    """A time (s) in words: seconds with this many digits, minutes from 100 s on, hours from two hours on."""
    if seconds < 99.5:
        return f"{seconds:.{digits}g} s"
    number, unit = (seconds / 60.0, "min") if seconds < 7170.0 else (seconds / 3600.0, "h")
    return f"{number:.1f} {unit}" if number < 9.95 else f"{number:.0f} {unit}"
