"""Allowances of irregular seas for each limit, added to the demand at rest, from runs with several seeds."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from riserstudy.dataset.limits import error_of, rows_of, too_coarse
from riserstudy.dataset.result import Result
from riserstudy.dataset.statistics import gumbel
from riserstudy.errors import InputError
from riserstudy.model.layout import directions
from riserstudy.model.mesh import Mesh, mesh_of
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.at_rest import static
from riserstudy.scene.limits import ALONG, SIGNED, Limit
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.extremes import mean_of, places
from riserstudy.simulation.outputs import rotations_at_rest
from riserstudy.simulation.refine import run
from riserstudy.simulation.rest import Rest
from riserstudy.simulation.run import finish, march
from riserstudy.simulation.section_forces import shear
from riserstudy.study.departures import departure, refuse_departures
from riserstudy.study.in_sea import Sea, exposure, in_sea

OUTPUTS = 20  # smallest number of outputs in the shortest period of a sea
SHEAR = "shear_force"
NO_VESSEL = "replace it by `platform`, with `top.x: platform`"


class Allowance(NamedTuple):
    """The addition of a sea to the demand of a limit."""

    value: float  # in the SI unit of the limit's output, the largest of all places; NaN if it is not known
    missing: str = ""  # why it is not known
    # by place, named as in extremes; absent: the value everywhere
    by_place: Mapping[str, float] | None = None


def allowances(
    file: SceneFile,
    sea: Sea,
    seeds: int,
    notify: Callable[[str], None] = lambda _: None,
    change: Callable[[Resolved], Resolved] = lambda scene: scene,
    storm: float | None = None,
) -> list[Allowance]:
    """The addition of a sea to the demand of each limit, which nine seas in ten do not exceed.

    Each section has an addition of its own, the largest of its nodes, since other sections and nodes govern
    at other offsets. Runs have the offset of the scene. Extremes of the seeds follow a Gumbel
    distribution. The allowance of a limit on a mean is the change of the mean by the sea, on average over
    the seeds. On a prescribed mesh and step that are too coarse for an output, its allowance is not
    known. Raises InputError when the scene has no irregular sea, or the riser leaves its offset. Raises
    SimulationError when a run cannot be completed.

    Parameters
    ----------
    notify : function that receives a description of the next run.
    change : change of the scene before the runs, such as another current.
    storm : duration of the seas that the allowances are for (s); None: that of a run after its ramps.
    """
    scene = change(file.resolved())
    refuse_departures(file.source, scene)
    if scene.vessel:
        raise departure(file.source, "vessel", "moves away from its offset", NO_VESSEL)
    runs = []
    for seed in range(seeds):
        notify(f"sea of {sea.height:g} m, {sea.period:g} s: seed {seed + 1} of {seeds}")
        runs.append(_run(scene, change(in_sea(file, sea, seed + 1).resolved())))
    longer = 1.0 if storm is None else storm / _exposure(file)
    return [_of_limit(scene, limit, runs, longer) for limit in scene.limits or []]


def _exposure(file: SceneFile) -> float:
    """Duration of a run after its ramps (s). Raises InputError when ramps last until its end."""
    found = exposure(file.resolved())
    if not found > 0.0:
        why = "the run ends before its ramps, so its extremes do not belong to a duration of the sea"
        raise InputError(file.source, "analysis.duration", why, "give a longer duration")
    return found


class Run(NamedTuple):
    """A run in the sea, and the scene at rest on the same mesh."""

    mesh: Mesh
    moving: Result
    rest: Result
    # largest magnitudes of the changes of shear and, in space, of vectors from rest, by output: one value, or
    # (n + 1,)
    swings: Mapping[str, FloatArray]
    shifts: Mapping[str, float]  # in space, magnitudes of the changes of mean rotations from rest, by output


def _run(scene: Resolved, there: Resolved) -> Run:
    """Run a scene ``there``, in the sea; ``scene`` is itself."""
    sheared = any(limit.output == SHEAR for limit in there.limits or [])
    peaked = directions(there) == len("xyz") or there.top.tensioners or sheared
    moving = run(_often(there) if peaked else there)
    mesh, still = mesh_of(scene, moving.arrays["l0"]), static(scene)
    rest = Rest(still, mesh)
    found = finish(still, mesh, march(still, mesh, None, rest=rest))
    return Run(
        mesh, moving, found, _swings(still, mesh, moving, rest), _shifts(there, still, mesh, moving, rest)
    )


def _often(there: Resolved) -> Resolved:
    """The scene with outputs at all nodes, and so frequent that they miss few peaks.

    Extremes over all steps know neither vectors in space nor single cylinders, nor the sides of a node.
    """
    output = there.analysis.output
    if output is None or there.shortest_period is None:
        return there
    interval = min(output.interval, there.shortest_period / OUTPUTS)
    output = output.replaced(stations=None, interval=interval)
    return there.replaced(analysis=there.analysis.replaced(output=output))


def _swings(scene: Resolved, mesh: Mesh, moving: Result, rest: Rest) -> dict[str, FloatArray]:
    """Largest magnitude of the change of shear from rest; in space, also of angles and moments, as vectors.

    A magnitude alone hides motions through zero, and motions across the direction at rest, which add to the
    demand at other offsets. In a plane, angles and moments have signs. Shear is that of each side of a node:
    where shear jumps, the side with the larger value need not be the one that changes most.
    """
    still, found = rotations_at_rest(scene, rest.model, mesh), {}
    for name, turned in moving.seen.rotations.items():
        found[name] = np.linalg.norm(turned - still[name], axis=-1).max(axis=0)
    moment = moving.arrays.get("mesh_moment")
    if moment is not None:
        change = moment - rest.moment
        found["bending_moment"] = np.linalg.norm(change, axis=1).max(axis=0)
    elif "bending_moment" in moving.arrays and len(moving.arrays["s"]) == len(moving.arrays["s_node"]):
        change = moving.arrays["bending_moment"] - rest.arrays["bending_moment_static"]
    else:
        return found
    above = moving.arrays.get("mesh_above_ring")
    if above is not None:
        above = above - rest.arrays["mesh_above_ring_static"]
    found[SHEAR] = np.abs(shear(rest.arrays, change, moment is not None, above)).max(axis=0)
    return found


def _shifts(there: Resolved, scene: Resolved, mesh: Mesh, moving: Result, rest: Rest) -> dict[str, float]:
    """Magnitudes of the changes of mean rotations in space from rest (rad), by output; ``scene``: at rest."""
    still = rotations_at_rest(scene, rest.model, mesh)
    means = {name: mean_of(there, name, moving.arrays, moving.seen) for name in moving.seen.rotations}
    return {
        name: float(np.linalg.norm(mean - still[name])) for name, mean in means.items() if mean is not None
    }


def _of_limit(scene: Resolved, limit: Limit, runs: Sequence[Run], longer: float) -> Allowance:
    """The allowance of a limit, from the runs in the sea; ``longer``: duration of a sea, in runs."""
    if limit.side == "mean":
        places = of_seeds([_shifted(scene, limit, one) for one in runs], lambda added: float(np.mean(added)))
    else:
        places = of_seeds([_added(scene, limit, one) for one in runs], partial(allowance, longer=longer))
    value = float(np.max([*places.values()])) if places else math.nan  # not known if one of them is not
    if math.isnan(value):
        return Allowance(value, f"{limit.output} in the runs of the sea")
    if scene.analysis.mesh is None:
        return Allowance(value, "", places)
    errors = [error_of(limit.output, one.moving.facts, own_mesh=True) for one in runs]
    why = too_coarse(limit, max(errors, key=lambda one: one.size))
    if why:
        return Allowance(math.nan, f"in the runs of the sea, {why}")
    return Allowance(value, "", places)


def of_seeds(each: Sequence[Mapping[str, float]], combine: Callable[[FloatArray], float]) -> dict[str, float]:
    """The allowance at each place, in the unit of the output; NaN where a seed lacks the place.

    Parameters
    ----------
    each : additions of each seed, by place.
    combine : function that gives an allowance from the additions of the seeds, (seeds,).
    """
    names = dict.fromkeys(name for one in each for name in one)
    return {name: combine(np.array([one.get(name, math.nan) for one in each])) for name in names}


def allowance(added: FloatArray, longer: float = 1.0) -> float:
    """Addition that nine seas in ten do not exceed, from those of the seeds, (seeds,), same unit; >= 0.

    It is NaN if an addition is. ``longer``: duration of the seas divided by that of the runs of the seeds.
    """
    if np.isnan(added).any():
        return math.nan
    return max(gumbel(added, longer).fractile, 0.0)


def _shifted(scene: Resolved, limit: Limit, of: Run) -> dict[str, float]:
    """By place, the change of the mean of an output from its value at rest; empty if it is not known.

    Waves change mean drag, and with it means. The change counts to both sides, since the value at rest may
    have the other sign at other offsets.
    """
    at_rest = {row["where"]: row for row in rows_of(scene, limit, of.rest.facts["extremes"])}
    found = {}
    for row in rows_of(scene, limit, of.moving.facts["extremes"]):
        if "mean" in row and "mean" in at_rest.get(row["where"], {}):
            change = abs(row["mean"] - at_rest[row["where"]]["mean"])
            found[row["where"]] = of.shifts.get(limit.output, change)
    return found


def _added(scene: Resolved, limit: Limit, of: Run) -> dict[str, float]:
    """By place, the largest motion of an output from its value at rest; empty if it is not known.

    Along the riser it is the largest of the nodes of the place. For outputs with a sign it is the motion to
    either side. The motion against the sign at rest adds to the demand at offsets where the value at rest has
    the other sign. In space, it is also at least the magnitude of the change of the vector. For shear, whose
    extremes and value at rest may be of two sides of a node, it is the largest change of either side.
    """
    at_rest = {row["where"]: row for row in rows_of(scene, limit, of.rest.facts["extremes"])}
    nodes = dict(places(scene, of.mesh, limit.output)) if limit.output in ALONG else {}
    added = {}
    for row in rows_of(scene, limit, of.moving.facts["extremes"]):
        where = row["where"]
        if where not in at_rest:
            return {}
        above = _motion(of, limit.output, "largest", nodes.get(where), row, at_rest[where])
        below = -_motion(of, limit.output, "smallest", nodes.get(where), row, at_rest[where])
        sided = below if limit.side == "smallest" else above
        if limit.output == SHEAR and SHEAR in of.swings:
            above, below = _grown(of, nodes[where]), 0.0
        either = max(above, below, _swing(of, limit.output, nodes.get(where)))
        added[where] = either if limit.output in SIGNED else sided
    return added


def _swing(of: Run, output: str, nodes: slice | None) -> float:
    """Largest magnitude of the change of a vector in space, of any of the nodes; 0 for other outputs."""
    if output not in of.swings:
        return 0.0
    found = of.swings[output]
    return float(np.max(found if nodes is None else found[nodes]))


def _grown(of: Run, nodes: slice) -> float:
    """Largest growth of the magnitude of shear (N) from rest to any time step, of any of the nodes."""
    grown = of.moving.arrays[f"{SHEAR}_absmax"] - np.abs(of.rest.arrays[f"{SHEAR}_static"])
    return float(grown[nodes].max())


def _of_cylinders(of: Run, output: str) -> list[float]:
    """Largest and smallest change of any cylinder from rest at the outputs; empty for other outputs.

    The cylinder that is extreme at rest need not be the one that moves most.
    """
    histories = of.moving.arrays.get(output)
    if histories is None or histories.ndim < 2:
        return []
    change = histories - of.rest.arrays[f"{output}_static"]
    return [float(change.max()), float(change.min())]


def _motion(
    of: Run, output: str, side: str, nodes: slice | None, row: Mapping[str, Any], still: Mapping[str, Any]
) -> float:
    """Largest change of an output from rest to a side, of any node or cylinder, or of a single value."""
    if nodes is None:
        extreme = max if side == "largest" else min
        return extreme([float(row[side] - still[side]), *_of_cylinders(of, output)])
    envelope = of.moving.arrays[output + ("_max" if side == "largest" else "_min")][nodes]
    change = envelope - of.rest.arrays[f"{output}_static"][nodes]
    return float(change.max() if side == "largest" else change.min())
