"""One attempt to run a scene, bounded in work or time: its outcome, in place of an exception."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from chapters.numerics.outcome import Outcome
from riserstudy.dataset.result import Result
from riserstudy.errors import PhysicallyUnstable, RiserStudyError, TakesTooLong
from riserstudy.model.mesh import Mesh
from riserstudy.records.warning import sentence
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.error_estimate import controlled, deciding, difference, statistics_of
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import single
from riserstudy.simulation.vortex_vibration_statistics import apart

ACCURATE_TO = 0.01
BEYOND_REASON = 10.0  # factor on the largest displacement, tension or moment of the reference


@dataclass(frozen=True)
class Attempt:
    """Outcome of one run; ``result`` is None if the run was refused."""

    result: Result | None
    refused: Outcome | None
    message: str
    seconds: float


def attempt(do: Callable[[], Result]) -> Attempt:
    """Run; of a refusal, keep the kind and the message."""
    started = clock.perf_counter()
    result, refused, message = None, None, ""
    try:
        result = do()
    except PhysicallyUnstable as error:
        refused, message = Outcome.UNSTABLE, str(error)
    except TakesTooLong as error:
        refused, message = Outcome.TOO_LONG, str(error)
    except RiserStudyError as error:
        refused, message = Outcome.REFUSED, str(error)
    return Attempt(result, refused, message, clock.perf_counter() - started)


def in_time(scene: Resolved, patience: float) -> Result:
    """Run a scene to its requested accuracy.

    Raises
    ------
    TakesTooLong
        When the run takes longer than ``patience`` (s).
    """
    result = run(scene, patience)
    if "ended_by" in result.facts:
        raise TakesTooLong(f"takes longer than {patience:g} s; {sentence(result.facts['warnings'][-1])}")
    return result


def attempt_on(scene: Resolved, mesh: Mesh, step: float | None, budget: float) -> Attempt:
    """Run on a mesh with a time step, unless the run takes more node-steps than the budget."""
    return too_long(scene, mesh, step, budget) or attempt(lambda: single(scene, mesh, step, True))


def too_long(scene: Resolved, mesh: Mesh, step: float | None, budget: float) -> Attempt | None:
    """Return the refusal of a run that takes more node-steps than the budget, or None."""
    work = len(mesh.s) * (scene.analysis.duration or 0.0) / step if step else 0.0
    if work <= budget:
        return None
    message = f"{work:.2g} node-steps, more than the {budget:.2g} that this study allows a run"
    return Attempt(None, Outcome.TOO_LONG, message, 0.0)


def errors(result: Result, reference: Result) -> dict[str, float]:
    """Error of each quantity that an accuracy bounds, relative to the largest value.

    For vortex-induced vibration these are errors of its statistics; a run too short for them has none.
    The run on the finer mesh is the second argument of ``difference``.
    """
    best = statistics_of(reference)
    if best is not None:
        found = statistics_of(result)
        return apart(found, best.at(found.s)) if found is not None else {}
    if len(result.arrays["s_node"]) > len(reference.arrays["s_node"]):
        return controlled(difference(reference, result))
    return controlled(difference(result, reference))


def judged(tried: Attempt, reference: Result | None) -> tuple[Outcome, float]:
    """Outcome and deciding error of an attempt compared with a reference."""
    if tried.result is None:
        return tried.refused or Outcome.REFUSED, math.nan
    if reference is None:
        return Outcome.UNJUDGED, math.nan
    error = deciding(errors(tried.result, reference))
    if any(
        largest(tried.result, name) > BEYOND_REASON * max(largest(reference, name), 1.0)
        for name in ("x", "z", "effective_tension", "bending_moment")
    ):
        return Outcome.DIVERGED, error
    return Outcome.ACCURATE if error <= ACCURATE_TO else Outcome.INACCURATE, error


def largest(result: Result, name: str) -> float:
    """Largest absolute value over nodes and time; for positions, of the displacement from the static one."""
    arrays = result.arrays
    sides = [arrays[name + end] for end in ("_max", "_min") if name + end in arrays]
    rest: NDArray[np.float64] | float = 0.0
    if name in ("x", "y", "z"):
        rest = arrays.get(name + "_static", 0.0)
    return max((float(np.abs(values - rest).max()) for values in sides), default=0.0)


def mesh_of(scene: Resolved, result: Result) -> Mesh:
    """Return the mesh of a run."""
    l0 = result.arrays["l0"]
    middle = np.cumsum(l0) - 0.5 * l0
    joint = scene.top.telescopic_joint is not None
    return Mesh(l0, np.searchsorted(scene.borders[1:], middle).astype(np.int64), joint)
