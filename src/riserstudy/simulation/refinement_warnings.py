"""Warnings of a refinement: accuracy that it missed, outputs that it lacks, errors that fall slowly."""

from __future__ import annotations

from riserstudy.dataset.result import Result
from riserstudy.records.facts import RunFacts
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sudden import sudden_starts
from riserstudy.simulation.halved import Halved
from riserstudy.simulation.tolerance import in_words

FIRST_ORDER = 2.0  # by which each halving reduces an error


def missed_accuracy(facts: RunFacts, runs: int) -> str:
    """Warn that accuracy was not reached in so many runs.

    Parameters
    ----------
    facts : of the finest run, with ``ended_by`` where something else than their number ended the refinement.
    """
    why = f" within {facts['ended_by']}" if "ended_by" in facts else ""
    errors = f"estimated errors are {in_words(facts['error_estimate'])}"
    if not facts["error_estimate"]:
        errors = "errors are not estimated, which requires more runs"
    count = f"{runs} run{'s' if runs > 1 else ''}"
    return f"accuracy not reached{why} after {count}, the last on {facts['elements']} segments: {errors}"


def sparse_outputs(scene: Resolved, finest: Result) -> list[str]:
    """Warn of outputs further apart than requested: patience ended before the run with all of them."""
    output, time = scene.analysis.output, finest.arrays.get("time")
    if output is None or time is None or len(time) < 2:
        return []
    interval = float(time[1] - time[0])
    if interval <= 1.5 * output.interval:
        return []
    return [
        f"outputs are {interval:g} s apart, not {output.interval:g} s as requested: the time limit "
        "(patience) ended the refinement before the run that would write all outputs"
    ]


def slow_convergence(scene: Resolved, by_step: Halved | None) -> list[str]:
    """Warn of what makes errors of the step fall slower than those of a first-order method."""
    lines = sudden_starts(scene)
    if by_step is None or by_step.fall >= FIRST_ORDER or not lines:
        return []
    return [
        f"halving the time step reduced the error by a factor of only {by_step.fall:.2g}, because "
        f"{' and '.join(lines)} {'starts' if len(lines) == 1 else 'start'} without a ramp. Give a ramp"
    ]
