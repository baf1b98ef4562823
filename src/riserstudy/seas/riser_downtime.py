"""Downtime of a riser: sea states of a record are simulated, and hours told by the responses between them."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.digests import engine_digest
from riserstudy.scene.load import SceneFile
from riserstudy.seas.cover import Cover, cover
from riserstudy.seas.directions import FROM, Directions
from riserstudy.seas.hours import SeaLimit, met_by_rows
from riserstudy.seas.record import with_peak_period
from riserstudy.seas.riser_hours import RiserHours, by_rows, met, riser_hours
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.sea_states import SeaStates, sea_states
from riserstudy.study.demand_in_sea import check_seeds
from riserstudy.study.in_sea import sea_of

if TYPE_CHECKING:
    import xarray as xr

FloatArray = NDArray[np.float64]


class Downtime(NamedTuple):
    """What a record leaves a riser, and what that rests on."""

    hours: RiserHours
    responses: xr.Dataset  # over sea_state and limit, of all headings
    lines: list[str]  # what was simulated, in words


class Part(NamedTuple):
    """Rows of a record in waves of one heading, and the riser's responses to them."""

    heading: float  # deg; not a number: that of the scene
    riser: RiserResponse
    of: SeaStates
    cover: Cover
    deviation: FloatArray  # (n, limits) at the cover's sea states


def riser_downtime(
    file: SceneFile,
    record: xr.Dataset,
    limits: Sequence[SeaLimit] = (),
    *,
    directions: Directions | None = None,
    seeds: int = 5,
    error: float = 0.05,
    most: int = 400,
    cores: int = 1,
    notify: Callable[[str], None] = lambda _: None,
) -> Downtime:
    """Hours of a record that the limits of a riser leave.

    Parameters
    ----------
    file : a scene with limits, an irregular sea and a duration.
    record : of `riserstudy.seas.record.read_record`.
    limits : on the sea itself, that must be met, too.
    directions : of the record as headings of the scene; absent: all seas come from the scene's heading.
    seeds : runs of each sea state: 1, or 5 and more.
    error : of the response between sea states, over what is allowed, or the response if that is more.
    most : sea states to simulate at most, of a heading.
    notify : is given what comes next.

    Raises
    ------
    InputError
        When the scene or the record lacks what this needs.
    SimulationError
        When so many sea states do not suffice.
    """
    check_seeds(seeds)
    interval = float(record.attrs["interval_hours"]) * 3600.0
    RiserResponse(file, seeds, interval, cores)  # refuses a scene that lacks what this needs
    peaked = with_peak_period(record, sea_of(file).peak_enhancement)
    of = sea_states(peaked)
    parts = []
    for heading, scene, sector in _headings(file, peaked, directions):
        own = of.among(sector)
        if not own.rows.any():
            continue
        if directions:
            notify(f"heading {heading:g} deg: {own.rows.sum()} rows")
        parts.append(_part(heading, scene, own, seeds, interval, error, most, cores, notify))
    known, rows = by_rows([(p.of, met(p.of, p.cover, p.deviation, p.riser.limits)) for p in parts])
    worst = np.max([part.cover.error for part in parts], axis=0)
    sea = met_by_rows(record, limits)
    hours = riser_hours(peaked, known, rows, parts[0].riser.limits, worst, sea)
    return Downtime(hours, _dataset(file, parts), _lines(parts, hours, record, directions))


def _headings(
    file: SceneFile, record: xr.Dataset, directions: Directions | None
) -> Iterator[tuple[float, SceneFile, NDArray[np.bool_]]]:
    """Heading (deg), scene and rows of each sector that has any."""
    if directions is None:
        yield math.nan, file, np.ones(record.sizes["time"], bool)
        return
    sector = directions.sector_of(record)
    every = zip(directions.headings, directions.scenes(file), strict=True)
    for k, (heading, scene) in enumerate(every):
        yield math.degrees(heading), scene, sector == k


def _part(
    heading: float,
    file: SceneFile,
    of: SeaStates,
    seeds: int,
    interval: float,
    error: float,
    most: int,
    cores: int,
    notify: Callable[[str], None],
) -> Part:
    """Simulate the sea states of one heading."""
    riser = RiserResponse(file, seeds, interval, cores)
    found = cover(of, riser, riser.allowed, error, most, notify=notify)
    none = np.full(len(riser.limits), math.nan)
    deviation = [riser.deviation.get((h, t), none) for h, t in found.states.tolist()]
    return Part(heading, riser, of, found, np.array(deviation))


def _lines(
    parts: Sequence[Part], hours: RiserHours, record: xr.Dataset, directions: Directions | None
) -> list[str]:
    """What was simulated, in words."""
    riser = parts[0].riser
    count = sum(len(part.cover.states) for part in parts)
    compared = sum(int(part.cover.held_out.sum()) for part in parts)
    off = max(float(part.cover.error.max()) for part in parts)
    many = f" in {len(parts)} headings" if directions else ""
    lines = [
        f"{count} sea states{many} of {riser.exposure:g} s, {riser.seeds} seeds each; "
        f"at {compared} that were compared the response is off by up to {off:.1%}"
    ]
    if riser.seeds == 1:
        lines.append("what other seeds would bring is not known, and in no band")
    if FROM in record and not directions:
        lines.append(
            "directions of the record are not used: all seas come from the scene's heading"
        )
    failures = [one for part in parts for one in part.riser.failures.items()]
    for (height, period), why in failures[:3]:
        lines.append(f"no result in {height:g} m, {period:g} s: {why}")
    if hours.unknown:
        lines.append(
            f"{hours.unknown:.2%} of the rows lie beside such seas, and count as not workable"
        )
    return lines


def _dataset(file: SceneFile, parts: Sequence[Part]) -> xr.Dataset:
    """Responses over sea states and limits."""
    import xarray as xr

    riser = parts[0].riser
    states = np.concatenate([part.cover.states for part in parts])
    demand = np.concatenate([part.cover.responses for part in parts])
    deviation = np.concatenate([part.deviation for part in parts])
    held = np.concatenate([part.cover.held_out for part in parts]).astype(np.int8)
    headings = np.repeat([p.heading for p in parts], [len(p.cover.states) for p in parts])
    worst = np.max([part.cover.error for part in parts], axis=0)
    sides, units, labels = (
        np.array(values, object)
        for values in ([one.side for one in riser.limits], riser.units, riser.labels)
    )
    both, state, limit = ("sea_state", "limit"), "sea_state", "limit"
    own = "in the unit of the limit"
    return xr.Dataset(
        {
            "demand_of_limit": (both, demand, {"long_name": f"demand, {own}"}),
            "standard_error": (both, deviation, {"long_name": f"of the demand by seeds, {own}"}),
            "held_out": (state, held, {"long_name": "1: simulated to compare"}),
            "allowed": (limit, riser.allowed, {"long_name": f"what is allowed, {own}"}),
            "response_error": (
                limit, worst, {"units": "1", "long_name": "largest difference where compared"}
            ),
            "unit": (limit, units, {"long_name": "unit of the limit"}),
            "side": (limit, sides, {"long_name": "which side is limited"}),
        },
        {
            "limit": (limit, labels, {"long_name": "limit"}),
            "significant_wave_height": (
                state, states[:, 0], {"units": "m", "long_name": "significant wave height"}
            ),
            "peak_period": (state, states[:, 1], {"units": "s", "long_name": "peak period"}),
            "heading": (
                state, headings, {"units": "degree", "long_name": "heading, none: the scene's"}
            ),
        },
        {
            "Conventions": "CF-1.11",
            "title": f"{file.tree.get('title') or 'a riser'}: limits over sea states",
            "scene": json.dumps(file.tree),
            "engine": engine_digest(),
            "seeds": riser.seeds,
            "interval_hours": riser.interval / 3600.0,
        },
    )  # fmt: skip
