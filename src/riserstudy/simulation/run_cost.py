"""Cost of runs."""

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
