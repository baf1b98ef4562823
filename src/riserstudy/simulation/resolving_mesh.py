"""The error of a run on a mesh that may not resolve bending, from runs on meshes that do."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError
from riserstudy.model.mesh import Mesh
from riserstudy.scene.at_rest import static
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.run import march
from riserstudy.simulation.starting_mesh import coarsest_mesh
from riserstudy.simulation.thinning import thinned
from riserstudy.simulation.time_limit import Watch, size

RESOLVED = 2  # halvings of the coarsest mesh chosen by the program that resolve bending
HALF = 0.6  # largest ratio of the segments of two meshes of which one counts as twice as coarse


def error_from_resolved(
    scene: Resolved, own: Mesh, run: Result, step: float | None, halved: bool, watch: Watch
) -> dict[str, float] | None:
    """Relative difference of a run from runs on meshes that resolve the bending of the riser, by quantity.

    Results on meshes with too long segments differ little from each other, but much from the converged
    result. Such a mesh is recognised by the coarsest mesh that the program would choose. Empty if all
    segments are much shorter than those of the latter, and coarser meshes could be compared. None if the
    error is unknown, because coarser meshes could not be compared, and a run that resolves bending failed.

    Parameters
    ----------
    own, step : mesh and time step (s) of ``run``.
    halved : whether each of the coarser meshes has about half the segments of the next mesh.
    """
    rest = static(scene)
    if scene.analysis.method == "explicit":  # which would require a shorter step on shorter segments
        scene = scene.replaced(analysis=scene.analysis.replaced(method=None))
    found: dict[str, float] = {}
    try:
        chosen = coarsest_mesh(rest)
        if halved and not _is_coarser(own, _halved(chosen, RESOLVED)):
            return {}
        fine = _halved(chosen, RESOLVED, 2 * len(own.l0))
        watch.begin(f"the static state, to estimate the error: {size(len(fine.l0), None)}")
        found = difference(march(rest, own, None), march(rest, fine, None))
        if step and (not halved or _is_coarser(own, chosen)):
            fine = _halved(chosen, 1, len(own.l0))
            watch.begin(f"a run that resolves bending: {size(len(fine.l0), step)}")
            moving = march(thinned(scene, step)[0], fine, step, watch=watch, extremes=False)
            found = larger(found, difference(run, moving))
    except SimulationError:  # no equilibrium, or a failed step, on a mesh that resolves bending
        return found if halved else None
    return found


def _halved(mesh: Mesh, times: int, least: int = 0) -> Mesh:
    """The mesh with its segments halved a number of times, or more often, to have a number of segments."""
    more = math.ceil(math.log2(max(least / mesh.ring, 1.0)))
    for _ in range(max(times, more)):
        mesh = mesh.halved()
    return mesh


def are_halved(meshes: list[Mesh]) -> bool:
    """Whether there are coarser meshes, each with about half the segments of the previous mesh.

    A section has at least one segment, so meshes of a riser with many sections may differ little.
    """
    counts = [mesh.ring for mesh in meshes]
    return len(counts) > 1 and all(coarse <= HALF * fine for fine, coarse in pairwise(counts))


def _is_coarser(own: Mesh, other: Mesh) -> bool:
    """Whether a mesh has a segment that is longer than the segment of another mesh at the same place."""
    middle = 0.5 * (own.s[1:] + own.s[:-1])[: own.ring]
    there = np.clip(np.searchsorted(other.s, middle) - 1, 0, other.ring - 1)
    return bool((own.l0[: own.ring] > (1.0 + 1e-9) * other.l0[there]).any())


def larger(one: dict[str, float], other: dict[str, float]) -> dict[str, float]:
    """The larger of two relative errors (1), by quantity."""
    return {name: max(one.get(name, 0.0), other.get(name, 0.0)) for name in one | other}
