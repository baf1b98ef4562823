"""Warnings of a refinement: missed tolerance, missing outputs, slow convergence."""

from __future__ import annotations

from riserstudy.dataset.result import Result
from riserstudy.records.facts import RunFacts
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sudden import sudden_starts
from riserstudy.simulation.halved import Halved
from riserstudy.simulation.tolerance import in_words

FIRST_ORDER = 2.0  # factor by which each halving reduces an error of first order


def missed_accuracy(facts: RunFacts, runs: int, patience: float) -> str:
    """The warning that the tolerance was not met within a number of runs.

    ``facts``: facts of the finest run, with ``ended_by`` if the time limit ``patience`` (s) ended the
    refinement.
    """
    why = f" within the time limit of {patience:g} s" if "ended_by" in facts else ""
    errors = f"estimated errors are {in_words(facts['error_estimate'])}"
    if not facts["error_estimate"]:
        errors = "errors are not estimated, which requires more runs"
    count = f"{runs} run{'s' if runs > 1 else ''}"
    remedy = "give a larger analysis.accuracy" + (" or more time (--patience)" if why else "")
    last = f"the last on {facts['elements']} segments"
    return f"accuracy not reached{why} after {count}, {last}: {errors}; {remedy}"


def sparse_outputs(scene: Resolved, finest: Result) -> list[str]:
    """A warning about missing outputs, if the time limit ended before the run with all of them."""
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
    """A warning about causes of a convergence with the time step that is slower than first order."""
    lines = sudden_starts(scene)
    if by_step is None or by_step.fall >= FIRST_ORDER or not lines:
        return []
    return [
        f"halving the time step reduced the error by a factor of only {by_step.fall:.2g}, because "
        f"{' and '.join(lines)} {'starts' if len(lines) == 1 else 'start'} without a ramp. Give a ramp"
    ]
