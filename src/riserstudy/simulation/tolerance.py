"""Tolerances of a scene, and the check for runs whose estimated error exceeds their values."""

from __future__ import annotations

from typing import Any

from riserstudy.dataset.result import Result
from riserstudy.errors import PhysicallyUnstable, SimulationError
from riserstudy.records.facts import RunFacts
from riserstudy.records.numerals import newtons
from riserstudy.records.warning import UNKNOWN, UNKNOWN_OVER_TIME, RunWarning, sentence, warning
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.equilibrium import rounding
from riserstudy.simulation.error_estimate import controlled

DISPLACEMENT, MOMENT, DAMAGE = 0.002, 0.01, 0.05  # default tolerances
PATIENT = 6  # number of refinements in which the error of a string under compression must halve


def allowed(accuracy: float | None) -> dict[str, float]:
    """Relative tolerances by quantity; None: the default."""
    moment = accuracy or MOMENT
    return {"displacement": accuracy or DISPLACEMENT, "moment": moment, "tension": moment}


def allowed_of(scene: Resolved) -> dict[str, float]:
    """Relative tolerances of a scene, by quantity; with damage if it has fatigue details."""
    accuracy = scene.analysis.accuracy
    return allowed(accuracy) | ({"damage": accuracy or DAMAGE} if scene.fatigue else {})


def add_error_of_outputs(result: Result) -> None:
    """Add the damage that is missed between outputs to its estimated error."""
    error = result.facts.get("error_estimate", {})
    if "damage" in error:
        error["damage"] += max(row["error_of_outputs"] for row in result.facts["fatigue"])


def check_error(result: Result, scene: Resolved) -> None:
    """Check that no estimated error exceeds the largest value itself: such a result is unknown.

    With a prescribed mesh and time step, the result is kept with a warning, and no limit counts as met.
    Raises SimulationError with the quantity, its error and the remedy, if the engine chose mesh and step.
    """
    if doubt := doubt_of(result.facts):
        if scene.analysis.mesh is None:
            raise SimulationError(sentence(doubt))
        result.facts["warnings"].append(doubt)


def doubt_of(facts: RunFacts) -> RunWarning | None:
    """The warning of a run whose estimated error exceeds its largest value; None for other runs."""
    error = facts.get("error_estimate", {})
    if not any(value > 1.0 for value in controlled(error).values()):
        return None
    values: dict[str, Any] = {"errors": error, "elements": facts["elements"]}
    kind, steps = UNKNOWN, ""
    if "step" in facts:
        kind, steps = UNKNOWN_OVER_TIME, ", steps of {step:.3g} s"
        values["step"] = facts["step"]
    text = (
        f"the estimated error is larger than the result: {{errors:percent}}, on {{elements}} segments{steps};"
        " use a finer mesh and a shorter time step, or omit both: the engine then chooses them"
    )
    return warning(kind, text, values)


def raise_if_buckling(scene: Resolved, finer: Result, excess: list[float]) -> None:
    """Detect buckling of a string without bending stiffness, whose wavelength decreases with each mesh.

    ``excess``: largest ratio of error to tolerance (1), of every run so far. Raises PhysicallyUnstable when
    the error of a string under compression has not decreased within `PATIENT` runs.
    """
    earlier = excess[:-PATIENT]
    if not earlier or min(excess) <= 0.5 * min(earlier) or "bending_moment" in finer.arrays:
        return
    facts = finer.facts
    if facts["directions"] > 1 and facts["smallest_tension"] < -rounding(scene):
        raise PhysicallyUnstable(
            f"effective tension decreases to {newtons(facts['smallest_tension'])} at s = "
            f"{facts['smallest_tension_s']:.4g} m, where a riser without bending stiffness buckles at any "
            f"wavelength, so peaks did not converge in {len(excess)} runs on finer meshes; give bending "
            "stiffness to every section, or set analysis.mesh and step yourself"
        )
