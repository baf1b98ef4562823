"""Run a scene with its prescribed mesh and time step, and estimate the error from coarser runs."""

from __future__ import annotations

import math
from itertools import pairwise

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError, TakesTooLong
from riserstudy.model.mesh import Mesh, prescribed
from riserstudy.records.numerals import at_most
from riserstudy.records.warning import NOT_ESTIMATED, warning
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.halved import Halved, enter, error_of
from riserstudy.simulation.remaining_error import LEAST_FALL, MOST_FALL
from riserstudy.simulation.resolving_mesh import are_halved, error_from_resolved, larger
from riserstudy.simulation.run import march, single
from riserstudy.simulation.sampling_error import floor, of_two_runs
from riserstudy.simulation.starting_mesh import massless
from riserstudy.simulation.thinning import thinned
from riserstudy.simulation.time_limit import Watch, size

COARSER = ("step", "mesh", "step", "mesh")  # quantities that are doubled from run to run
#: largest decrease of differences that is used, by smallest number of steps in the shortest period: with
#: fewer steps, coarser runs do not show the order of the method
TRUSTED = {8.0: LEAST_FALL, 24.0: 2.0}
# the same for outputs of waves along the riser's axis, whose periods are shorter than those of the motions
MANY_STEPS = 96.0
TRUSTED_ALONG = {"tension": 2.0, "stroke": 2.0, "tensioner_force": 2.0}
ROUNDING = 1e-9  # relative rounding error of a step
FEWEST_STEPS = 4.0  # in the period of a regular motion; with fewer, a doubled step can see its zeros alone


def run_prescribed(scene: Resolved, estimated: bool, watch: Watch) -> Result:
    """A run with the scene's prescribed mesh and time step, with an estimated error from coarser runs.

    The coarser runs come first, so the time of the run itself does not include the loading of kernels. Mesh
    and step are doubled one at a time. If both were doubled together, the larger error of one, which
    decreases, would hide the remaining error of the other. Raises SimulationError as `run` does. Raises
    TakesTooLong when the run takes longer than the time limit.
    """
    a = scene.analysis
    elements = a.mesh.elements if a.mesh else 1
    ways = ["mesh"] if elements > 1 else []
    ways += ["step"] if a.step and a.method != "explicit" else []
    coarser = _coarser(scene, elements, ways, watch) if estimated else []
    own = prescribed(scene, elements)
    watch.begin(f"the requested run: {size(elements, a.step)}")
    try:
        result = single(scene, own, a.step, watch=watch)
    except TakesTooLong as late:
        raise TakesTooLong(
            f"analysis.mesh, analysis.step: the run exceeds the time limit of {watch.patience:g} s, {late}; "
            "give fewer segments, a longer step, or a longer time limit"
        ) from None
    if not estimated:
        return result
    found = _error(scene, [("", own, result), *coarser], ways, watch)
    result.facts["error_estimate"] = found or {}
    if found is None:
        text = "the error is not estimated, because a run for the estimate failed"
        result.facts["warnings"].append(warning(NOT_ESTIMATED, text))
    return result


def _error(
    scene: Resolved, runs: list[tuple[str, Mesh, Result]], ways: list[str], watch: Watch
) -> dict[str, float] | None:
    """Estimated relative error of the first of some runs, by quantity; None if a run that it requires failed.

    ``runs``: as from `_coarser`.
    """
    _, own, result = runs[0]
    seen: dict[str, Halved] = {}
    sampling = result.facts.get("sampling_error", {})
    for (_, _, fine), (way, _, coarse) in reversed([*pairwise(runs)]):
        most, sure = _trusted(scene) if way == "step" else (MOST_FALL, None)
        enter(seen, way, difference(coarse, fine), floor(sampling), most, sure)
    if any(way not in seen for way in ways):
        return None
    found = error_of(seen.values(), of_two_runs(sampling))
    if massless(scene):
        return found
    halved = are_halved([own, *(mesh for way, mesh, _ in runs if way == "mesh")])
    run, step = result, scene.analysis.step
    if step and "step" in ways:  # with the doubled time step, which takes half as long
        run, step = runs[1][2], 2.0 * step
    least = error_from_resolved(scene, own, run, step, halved, watch)
    return None if least is None else larger(found, least)


def _trusted(scene: Resolved) -> tuple[float, dict[str, float]]:
    """Largest decreases of differences by halving the scene's step that are used: of all, of some."""
    steps = (scene.shortest_period or math.inf) / (scene.analysis.step or 1.0) * (1.0 + ROUNDING)
    most = next((most for fewest, most in TRUSTED.items() if steps < fewest), MOST_FALL)
    return most, TRUSTED_ALONG if steps < MANY_STEPS else {}


def refuse_unseen_periods(scene: Resolved) -> None:
    """Refuse a prescribed time step of more than a quarter of the period of a regular motion or wave.

    Steps of half a period can fall on the zeros of the motion alone, and do not show it. A run with doubled
    steps, which is necessary for the error estimate, then shows nothing of the motion or another motion, and
    the estimate is too small.

    Raises
    ------
    SimulationError
        With the step, the period and the remedy.
    """
    step, shortest = scene.analysis.step, scene.shortest_regular_period
    if not (scene.analysis.duration and step and shortest):
        return
    longest = shortest / FEWEST_STEPS
    if step > longest * (1.0 + ROUNDING):
        raise SimulationError(
            f"analysis.step: {step:g} s is more than a quarter of {shortest:g} s, the shortest period of "
            f"platform and waves, so the run can miss the motion; give a step of at most {at_most(longest)} "
            "s, or remove mesh and step, which the engine then chooses"
        )


def _coarser(scene: Resolved, elements: int, ways: list[str], watch: Watch) -> list[tuple[str, Mesh, Result]]:
    """Coarser runs, each with its mesh, and which of mesh or step is doubled relative to the previous run."""
    step, runs = scene.analysis.step, []
    for way in (way for way in COARSER if way in ways):
        elements = max(1, elements // 2) if way == "mesh" else elements
        step = 2.0 * step if way == "step" and step else step
        mesh = prescribed(scene, elements)
        watch.begin(f"a coarser run, to estimate the error: {size(len(mesh.l0), step)}")
        try:
            coarse = march(thinned(scene, step)[0], mesh, step, watch=watch, extremes=False)
            runs.append((way, mesh, coarse))
        except SimulationError:  # a coarse mesh may buckle, and a long step may fail
            break
    return runs
