"""Allowances of irregular seas for each limit, added to the demand at rest, from runs with several seeds."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.limits import demand_of, error_of, rows_of, too_coarse
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

    value: float  # in the SI unit of the limit's output; NaN if it is not known
    missing: str = ""  # why it is not known


def allowances(
    file: SceneFile, sea: Sea, seeds: int, notify: Callable[[str], None] = lambda _: None
) -> list[Allowance]:
    """The addition of a sea to the demand of each limit, which nine seas in ten do not exceed.

    Runs have the current and the offset of the scene. Extremes of the seeds follow a Gumbel distribution.
    Limits on means have no allowance. On a prescribed mesh and step that are too coarse for an output, its
    allowance is not known. ``notify``: function that receives a description of the next run.
    Raises InputError when the scene has no irregular sea, or the riser leaves its offset. Raises
    SimulationError when a run cannot be completed.
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
    value = allowance(np.array([_added(scene, limit, rest["extremes"], one["extremes"]) for one in runs]))
    if math.isnan(value):
        return Allowance(value, f"{limit.output} in the runs of the sea")
    if limit.side == "mean" or scene.analysis.mesh is None:
        return Allowance(value)
    errors = [error_of(limit.output, one, own_mesh=True) for one in runs]
    why = too_coarse(limit, max(errors, key=lambda one: one.size))
    if why:
        return Allowance(math.nan, f"in the runs of the sea, {why}")
    return Allowance(value)


def allowance(added: FloatArray) -> float:
    """Addition that nine seas in ten do not exceed, from those of the seeds, (seeds,), same unit; >= 0."""
    return max(demand(added, "largest", 1.0).value, 0.0)


def _added(scene: Resolved, limit: Limit, rest: list[dict[str, Any]], rows: list[dict[str, Any]]) -> float:
    """The demand of a run minus the demand at rest; NaN if one of them is missing.

    For outputs with a sign it is the largest motion to either side of the value at rest. The motion against
    the sign at rest adds to the demand at offsets where the value at rest has the other sign.
    """
    still, moving = demand_of(scene, limit, rest), demand_of(scene, limit, rows)
    if limit.side == "mean":
        return 0.0
    if still is None or moving is None:
        return float("nan")
    if limit.output in SIGNED:
        of = {row["where"]: row for row in rows_of(scene, limit, rest)}
        pairs = [(of[row["where"]], row) for row in rows_of(scene, limit, rows) if row["where"] in of]
        above = (run["largest"] - at_rest["largest"] for at_rest, run in pairs)
        below = (at_rest["smallest"] - run["smallest"] for at_rest, run in pairs)
        return float(max([*above, *below]))
    return still[0] - moving[0] if limit.side == "smallest" else moving[0] - still[0]
