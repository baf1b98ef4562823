"""Allowances of irregular seas for each limit, added to the demand at rest, from runs with several seeds."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.limits import demand_of
from riserstudy.errors import InputError
from riserstudy.scene.at_rest import static
from riserstudy.scene.limits import Limit
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.refine import run
from riserstudy.study.demand_in_sea import demand
from riserstudy.study.in_sea import Sea, in_sea

FloatArray = NDArray[np.float64]


def allowances(
    file: SceneFile, sea: Sea, seeds: int, notify: Callable[[str], None] = lambda _: None
) -> list[float]:
    """The addition of a sea to the demand of each limit, which nine seas in ten do not exceed.

    Runs have the current and the offset of the scene. Extremes of the seeds follow a Gumbel distribution.
    Limits on means have no allowance. ``notify``: function that receives a description of the next run.
    Raises InputError when the scene has no irregular sea, or the riser leaves its offset. Raises
    SimulationError when a run cannot be completed.
    """
    scene = file.resolved()
    _refuse_departures(file.source, scene)
    limits = scene.limits or []
    rest = _extremes(static(scene))
    added = np.zeros((seeds, len(limits)))
    for seed in range(seeds):
        notify(f"sea of {sea.height:g} m, {sea.period:g} s: seed {seed + 1} of {seeds}")
        rows = _extremes(in_sea(file, sea, seed + 1).resolved())
        added[seed] = [_added(scene, limit, rest, rows) for limit in limits]
    return [allowance(column) for column in added.T]


def _refuse_departures(source: str, scene: Resolved) -> None:
    """Refuse a scene with a tow or a release, whose effect cannot be separated from that of the sea.

    Raises InputError when the scene has one of them.
    """
    if scene.platform and scene.platform.cruise:
        found = "moves the platform away during the runs in a sea"
        raise InputError(source, "platform.cruise", found, "Remove it")
    if scene.disconnect:
        found = "releases the riser during the runs in a sea"
        raise InputError(source, "disconnect", found, "Remove it")


def allowance(added: FloatArray) -> float:
    """Addition that nine seas in ten do not exceed, from those of the seeds, (seeds,), same unit; >= 0."""
    return max(demand(added, "largest", 1.0).value, 0.0)


def _extremes(scene: Resolved) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = run(scene).facts["extremes"]
    return rows


def _added(scene: Resolved, limit: Limit, rest: list[dict[str, Any]], rows: list[dict[str, Any]]) -> float:
    """The demand of a run minus the demand at rest; NaN if one of them is missing."""
    still, moving = demand_of(scene, limit, rest), demand_of(scene, limit, rows)
    if limit.side == "mean":
        return 0.0
    if still is None or moving is None:
        return float("nan")
    return still[0] - moving[0] if limit.side == "smallest" else moving[0] - still[0]
