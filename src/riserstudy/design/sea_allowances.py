"""Allowances of irregular seas for each limit, added to the demand at rest, from runs with several seeds."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.limits import error_of, rows_of, too_coarse
from riserstudy.records.facts import RunFacts
from riserstudy.scene.at_rest import static
from riserstudy.scene.limits import SIGNED, Limit
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.refine import run
from riserstudy.study.demand_in_sea import demand
from riserstudy.study.departures import departure, refuse_departures
from riserstudy.study.in_sea import Sea, in_sea

FloatArray = NDArray[np.float64]
NO_VESSEL = "Replace it by `platform`, with `top.x: platform`"


class Allowance(NamedTuple):
    """The addition of a sea to the demand of a limit."""

    value: float  # in the SI unit of the limit's output, the largest of all places; NaN if it is not known
    missing: str = ""  # why it is not known
    # by place, named as in extremes; absent: the value everywhere
    by_place: Mapping[str, float] | None = None


def allowances(
    file: SceneFile, sea: Sea, seeds: int, notify: Callable[[str], None] = lambda _: None
) -> list[Allowance]:
    """The addition of a sea to the demand of each limit, which nine seas in ten do not exceed.

    Each section has an addition of its own, since other sections govern at other offsets. Runs have the
    current and the offset of the scene. Extremes of the seeds follow a Gumbel distribution. Limits on means
    have no allowance. On a prescribed mesh and step that are too coarse for an output, its allowance is not
    known. ``notify``: function that receives a description of the next run. Raises InputError when the scene
    has no irregular sea, or the riser leaves its offset. Raises SimulationError when a run cannot be
    completed.
    """
    scene = file.resolved()
    refuse_departures(file.source, scene)
    if scene.vessel:
        raise departure(file.source, "vessel", "moves away from its offset", NO_VESSEL)
    rest = run(static(scene)).facts
    runs = []
    for seed in range(seeds):
        notify(f"sea of {sea.height:g} m, {sea.period:g} s: seed {seed + 1} of {seeds}")
        runs.append(run(in_sea(file, sea, seed + 1).resolved()).facts)
    return [_of_limit(scene, limit, rest, runs) for limit in scene.limits or []]


def _of_limit(scene: Resolved, limit: Limit, rest: RunFacts, runs: Sequence[RunFacts]) -> Allowance:
    """The allowance of a limit, from the facts of the scene at rest and of the runs in the sea."""
    if limit.side == "mean":
        return Allowance(0.0)
    each = [_added(scene, limit, rest["extremes"], one["extremes"]) for one in runs]
    places = {where: allowance(np.array([one[where] for one in each])) for where in each[0]}
    value = max(places.values(), default=math.nan)
    if math.isnan(value):
        return Allowance(value, f"{limit.output} in the runs of the sea")
    if scene.analysis.mesh is None:
        return Allowance(value, "", places)
    errors = [error_of(limit.output, one, own_mesh=True) for one in runs]
    why = too_coarse(limit, max(errors, key=lambda one: one.size))
    if why:
        return Allowance(math.nan, f"in the runs of the sea, {why}")
    return Allowance(value, "", places)


def allowance(added: FloatArray) -> float:
    """Addition that nine seas in ten do not exceed, from those of the seeds, (seeds,), same unit; >= 0."""
    return max(demand(added, "largest", 1.0).value, 0.0)


def _added(
    scene: Resolved, limit: Limit, rest: list[dict[str, Any]], rows: list[dict[str, Any]]
) -> dict[str, float]:
    """By place, the demand of a run minus the demand at rest; empty if it is not known.

    For outputs with a sign it is the largest motion to either side of the value at rest. The motion against
    the sign at rest adds to the demand at offsets where the value at rest has the other sign.
    """
    at_rest = {row["where"]: row for row in rows_of(scene, limit, rest)}
    added = {}
    for row in rows_of(scene, limit, rows):
        if (still := at_rest.get(row["where"])) is None:
            return {}
        above, below = row["largest"] - still["largest"], still["smallest"] - row["smallest"]
        sided = below if limit.side == "smallest" else above
        added[row["where"]] = float(max(above, below) if limit.output in SIGNED else sided)
    return added
