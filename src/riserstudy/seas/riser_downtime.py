"""Downtime of a riser: sea states of a record are simulated, and responses between them are interpolated."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.seas.between_headings import Middle, compared, widened
from riserstudy.seas.cover import check_most
from riserstudy.seas.directions import FROM, Directions, directions_that_count
from riserstudy.seas.downtime_dataset import dataset_of, largest_errors, summarise
from riserstudy.seas.heading_parts import Effort, Part, headings, interval_of, riser_half_way, simulate
from riserstudy.seas.hours import SeaLimit, resuming_in, rows_with_values
from riserstudy.seas.riser_hours import RiserHours, by_rows, met, response_of, riser_hours
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.riser_returns import Demands
from riserstudy.study.demand_in_sea import check_seeds
from riserstudy.study.processes import check_cores

if TYPE_CHECKING:
    import xarray as xr

Notify = Callable[[str], None]


class Downtime(NamedTuple):
    """Workable hours of a riser, and the responses behind them."""

    hours: RiserHours
    responses: xr.Dataset  # over sea_state and limit, for all headings
    lines: list[str]  # summary of the simulations, in words
    demands: Demands  # demands in each known row


def riser_downtime(
    file: SceneFile,
    record: xr.Dataset,
    limits: Sequence[SeaLimit] = (),
    *,
    resumes: Sequence[SeaLimit] = (),
    directions: Directions | None = None,
    seeds: int = 5,
    error: float = 0.05,
    most: int = 400,
    cores: int = 1,
    notify: Notify = lambda _: None,
) -> Downtime:
    """Workable hours of a record by the limits of a riser.

    Raises InputError when the scene or the record lacks inputs, or ``most`` is too small from the start.
    Raises SimulationError when ``most`` sea states do not suffice.

    Parameters
    ----------
    file : a scene with limits, an irregular sea and a duration.
    record : record from `riserstudy.seas.record.read_record`.
    limits : additional limits on the sea.
    resumes : limits on the sea that operations also need in order to resume after a stop.
    directions : conversion of the record's directions to headings; absent: all seas have the scene's heading.
    seeds : number of runs for each sea state: 1, or 5 and more.
    error : tolerance of the response between sea states, relative to the allowable, or the response if
        larger.
    most : largest number of simulated sea states for each heading.
    notify : function that receives a description of the next step.
    """
    effort = Effort(seeds, error, most, cores)
    check_seeds(seeds)
    check_cores("riser_downtime", cores)
    # refuses a scene that lacks inputs
    RiserResponse(file, seeds, interval_of(record), cores)
    directions = directions_that_count(directions, file, record)
    found = {k: one for k, one in enumerate(headings(file, record, directions)) if one.of.rows.any()}
    if not found:
        why = "no row of the record has a direction"
        raise InputError("RECORD", FROM, why, "omit --sectors and --x-towards")
    check_most([heading.of for heading in found.values()], most)
    parts = {k: simulate(heading, record, effort, notify) for k, heading in found.items()}
    middles = []
    for part in parts.values():
        if half := part.heading.half:
            adjacent = [part.cover, parts[half.following].cover]
            middles.append(compared(half, riser_half_way(half, part), adjacent))
    return _counted(file, record, limits, resumes, [*parts.values()], middles)


def _counted(
    file: SceneFile,
    record: xr.Dataset,
    limits: Sequence[SeaLimit],
    resumes: Sequence[SeaLimit],
    parts: Sequence[Part],
    middles: Sequence[Middle],
) -> Downtime:
    """Workable hours from simulated headings, and from comparisons half-way between them, by index."""
    riser = parts[0].riser
    responses = [
        response_of(p.heading.of, p.cover, p.deviation, p.scale, riser.limits, riser.ends, p.mesh_error)
        for p in parts
    ]
    of_parts = [(p.heading.of, p.heading.weight, one) for p, one in zip(parts, responses, strict=True)]
    known, rows = by_rows(of_parts)
    for middle in middles:
        rows = widened(rows, middle.rows[known], middle)
    found = met(rows, riser.limits)
    of_sea = [*limits, *resumes]
    there = rows_with_values(record, of_sea)
    sea = {str(one): one.met(record) for one in limits}
    error = largest_errors(parts, middles)
    # a row without a quantity of a sea limit is neither workable nor not workable
    judged = found.among(there[known])
    hours = riser_hours(record, known & there, judged, riser.limits, error, sea, resuming_in(record, resumes))
    lines = summarise(parts, middles, hours, record, {limit.quantity.name for limit in of_sea})
    history = Demands(
        record["time"].values[known], riser.interval / 3600.0, riser.runs, riser.seeds, riser.limits, found
    )
    return Downtime(hours, dataset_of(file, parts, middles), lines, history)
