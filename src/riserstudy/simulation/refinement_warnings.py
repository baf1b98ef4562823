"""Warnings of a refinement: missed tolerance, missing outputs, slow convergence."""

from __future__ import annotations

from typing import Any

from riserstudy.dataset.result import Result
from riserstudy.records.facts import RunFacts
from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sudden import sudden_starts
from riserstudy.simulation.halved import Halved

FIRST_ORDER = 2.0  # factor by which each halving reduces an error of first order


def missed_accuracy(facts: RunFacts, runs: int, patience: float) -> RunWarning:
    """The warning that the tolerance was not met within a number of runs.

    ``facts``: facts of the finest run, with ``ended_by`` if the time limit ``patience`` (s) ended the
    refinement.
    """
    kind = "accuracy_not_reached"
    values: dict[str, Any] = {"runs": runs, "elements": facts["elements"]}
    within, remedy = "", "give a larger analysis.accuracy"
    errors = "errors are not estimated, which requires more runs"
    if facts["error_estimate"]:
        errors = "estimated errors are {errors:percent}"
        values["errors"] = facts["error_estimate"]
    else:
        kind += "_nor_estimated"
    if "ended_by" in facts:
        kind += "_in_time"
        within, remedy = " within the time limit of {patience:g} s", f"{remedy} or more time (--patience)"
        values["patience"] = patience
    last = "the last on {elements} segments"
    text = f"accuracy not reached{within} after {{runs:run}}, {last}: {errors}; {remedy}"
    return warning(kind, text, values)


def sparse_outputs(scene: Resolved, finest: Result) -> list[RunWarning]:
    """A warning about missing outputs, if the time limit ended before the run with all of them."""
    output, time = scene.analysis.output, finest.arrays.get("time")
    if output is None or time is None or len(time) < 2:
        return []
    interval = float(time[1] - time[0])
    if interval <= 1.5 * output.interval:
        return []
    text = (
        "outputs are {interval:g} s apart, not {requested:g} s as requested: the time limit (patience) "
        "ended the refinement before the run that would write all outputs"
    )
    return [warning("sparse_outputs", text, {"interval": interval, "requested": output.interval})]


def slow_convergence(scene: Resolved, by_step: Halved | None) -> list[RunWarning]:
    """A warning about causes of a convergence with the time step that is slower than first order."""
    lines = sudden_starts(scene)
    if by_step is None or by_step.fall >= FIRST_ORDER or not lines:
        return []
    start = f"{' and '.join(lines)} {'starts' if len(lines) == 1 else 'start'}"
    text = (
        "halving the time step reduced the error by a factor of only {fall:.2g}, because {start} without a "
        "ramp. Give a ramp"
    )
    return [warning("slow_convergence", text, {"fall": by_step.fall, "start": start})]
