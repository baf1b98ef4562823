"""Run a scene with its prescribed mesh and time step, and estimate the error from coarser runs."""

from __future__ import annotations

from itertools import pairwise
from typing import cast

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError, TakesTooLong
from riserstudy.model.mesh import prescribed
from riserstudy.records.facts import RunFacts
from riserstudy.scene.at_rest import static
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.halved import Halved, enter, error_of
from riserstudy.simulation.run import march, single
from riserstudy.simulation.sampling_error import floor, of_two_runs
from riserstudy.simulation.starting_mesh import coarsest_mesh
from riserstudy.simulation.thinning import thinned
from riserstudy.simulation.time_limit import Watch, size
from riserstudy.simulation.tolerance import doubt_of

COARSER = ("step", "mesh", "step", "mesh")  # quantities that are doubled from run to run
RESOLVED = 2  # halvings of a mesh chosen by the engine that resolve the bending of a conductor
NOT_ESTIMATED = "the error is not estimated, because the coarser run for the estimate failed"


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
    watch.begin(f"the requested run: {size(elements, a.step)}")
    try:
        result = single(scene, prescribed(scene, elements), a.step, watch=watch)
    except TakesTooLong as late:
        raise TakesTooLong(
            f"analysis.mesh, analysis.step: the run exceeds the time limit of {watch.patience:g} s, {late}"
        ) from None
    if not estimated:
        return result
    seen: dict[str, Halved] = {}
    sampling = result.facts.get("sampling_error", {})
    runs = [result, *(run for _, run in coarser)]
    for (way, _), (fine, coarse) in reversed([*zip(coarser, pairwise(runs), strict=True)]):
        enter(seen, way, difference(coarse, fine), floor(sampling))
    result.facts["error_estimate"] = {}
    if all(way in seen for way in ways):
        found = error_of(seen.values(), of_two_runs(sampling))
        result.facts["error_estimate"] = _at_least(found, _in_soil(scene, elements, result, watch))
    else:
        result.facts["warnings"].append(NOT_ESTIMATED)
    return result


def without_estimate(facts: RunFacts) -> RunFacts:
    """Facts of a run with a prescribed mesh, without its error estimate and the warnings that follow from it.

    The facts of a run for which the engine chose the mesh are returned unchanged, because such a run always
    has an estimate.
    """
    if "error_estimate" not in facts or "refinements" in facts:
        return facts
    of_estimate = (NOT_ESTIMATED, doubt_of(facts))
    other = {name: value for name, value in facts.items() if name != "error_estimate"}
    other["warnings"] = [warning for warning in facts["warnings"] if warning not in of_estimate]
    return cast("RunFacts", other)


def refuse_unseen_periods(scene: Resolved) -> None:
    """Refuse a prescribed time step of at least half the period of a regular motion or wave.

    Steps, also those of coarser runs, can then fall on the zeros of the motion alone. Neither the result nor
    its estimated error contains the motion.

    Raises
    ------
    SimulationError
        With the step, the period and the remedy.
    """
    step, shortest = scene.analysis.step, scene.shortest_regular_period
    if scene.analysis.duration and step and shortest and 2.0 * step >= shortest:
        raise SimulationError(
            f"analysis.step: {step:g} s is at least half of {shortest:g} s, the shortest period of platform "
            "and waves: steps can fall on the zeros of the motion alone; give a shorter step, or omit mesh "
            "and step, and the program chooses them"
        )


def _in_soil(scene: Resolved, elements: int, result: Result, watch: Watch) -> dict[str, float]:
    """Relative difference of a run from runs on meshes that resolve the bending of the conductor in soil.

    Results on meshes with longer segments differ little from each other, but much from the converged result.
    Empty without soil, or if the scene has no equilibrium on a mesh that resolves the bending.
    """
    if scene.soil is None:
        return {}
    rest = static(scene)
    own = prescribed(scene, elements)
    try:
        chosen = coarsest_mesh(rest)
        fine = chosen
        for _ in range(RESOLVED):
            fine = fine.halved()
        watch.begin(f"the static state, to estimate the error: {size(len(fine.l0), None)}")
        found = difference(march(rest, own, None), march(rest, fine, None))
        if scene.analysis.step and own.l0[0] > chosen.l0[0]:
            watch.begin(f"a run that resolves the soil: {size(len(chosen.l0), scene.analysis.step)}")
            moving = march(scene, chosen, scene.analysis.step, watch=watch, extremes=False)
            found = _at_least(found, difference(result, moving))
    except SimulationError:
        return {}
    return found


def _at_least(error: dict[str, float], least: dict[str, float]) -> dict[str, float]:
    """Estimated errors (1), each at least the error that was found for the quantity."""
    return {name: max(value, least.get(name, 0.0)) for name, value in error.items()}


def _coarser(scene: Resolved, elements: int, ways: list[str], watch: Watch) -> list[tuple[str, Result]]:
    """Coarser runs, each with mesh or step doubled relative to the previous run, and which one it is."""
    step, runs = scene.analysis.step, []
    for way in (way for way in COARSER if way in ways):
        elements = max(1, elements // 2) if way == "mesh" else elements
        step = 2.0 * step if way == "step" and step else step
        mesh = prescribed(scene, elements)
        watch.begin(f"a coarser run, to estimate the error: {size(len(mesh.l0), step)}")
        try:
            coarse = march(thinned(scene, step)[0], mesh, step, watch=watch, extremes=False)
            runs.append((way, coarse))
        except SimulationError:  # a coarse mesh may buckle, and a long step may fail
            break
    return runs
