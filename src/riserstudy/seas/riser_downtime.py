"""Downtime of a riser: sea states of a record are simulated, and hours told by the responses between them."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.digests import engine_digest
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.seas.cover import HELD_OUT, Cover, cover, first
from riserstudy.seas.directions import FROM, Directions
from riserstudy.seas.hours import SeaLimit, met_by_rows
from riserstudy.seas.record import with_peak_period
from riserstudy.seas.riser_hours import RiserHours, by_rows, met, riser_hours
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.riser_returns import Demands
from riserstudy.seas.sea_states import SeaStates, sea_states
from riserstudy.study.demand_in_sea import check_seeds
from riserstudy.study.in_sea import sea_of

if TYPE_CHECKING:
    import xarray as xr

FloatArray = NDArray[np.float64]
Notify = Callable[[str], None]
PRICED = 2  # runs by which the time of all is told


class Downtime(NamedTuple):
    """What a record leaves a riser, and what that rests on."""

    hours: RiserHours
    responses: xr.Dataset  # over sea_state and limit, of all headings
    lines: list[str]  # what was simulated, in words
    demands: Demands  # of each known row


class Effort(NamedTuple):
    """How much is simulated."""

    seeds: int = 5  # runs of each sea state: 1, or 5 and more
    error: float = 0.05  # of the response between sea states, as `cover` has it
    most: int = 400  # sea states of a heading at most
    cores: int = 1


class Heading(NamedTuple):
    """A scene in waves of one heading, and the rows of the record that have it."""

    angle: float  # deg; not a number: that of the scene
    file: SceneFile
    of: SeaStates


class Part(NamedTuple):
    """Rows of a record in waves of one heading, and the riser's responses to them."""

    heading: float  # deg; not a number: that of the scene
    riser: RiserResponse
    of: SeaStates
    cover: Cover
    deviation: FloatArray  # (n, limits) at the cover's sea states
    scale: FloatArray  # (n, limits) of extremes of an interval, at the cover's sea states


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
    notify: Notify = lambda _: None,
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
    effort = Effort(seeds, error, most, cores)
    check_seeds(seeds)
    RiserResponse(
        file, seeds, _interval(record), cores
    )  # refuses a scene that lacks what this needs
    parts = []
    for heading in headings(file, record, directions):
        if heading.of.rows.any():
            parts.append(simulate(heading, record, effort, notify))
    if not parts:
        raise InputError(
            "RECORD", FROM, "no row has a direction", "use the record without headings"
        )
    of_parts = [(p.of, met(p.of, p.cover, p.deviation, p.scale, p.riser.limits)) for p in parts]
    known, rows = by_rows(of_parts)
    worst = np.max([part.cover.error for part in parts], axis=0)
    sea = met_by_rows(record, limits)
    hours = riser_hours(record, known, rows, parts[0].riser.limits, worst, sea)
    lines = _lines(parts, hours, record, directions)
    time, interval = record["time"].values[known], float(record.attrs["interval_hours"])
    history = Demands(time, interval, seeds, parts[0].riser.limits, rows)
    return Downtime(hours, _dataset(file, parts), lines, history)


def headings(file: SceneFile, record: xr.Dataset, directions: Directions | None) -> list[Heading]:
    """The scene in each heading, with the rows of a record that have it; some may have none.

    Raises
    ------
    InputError
        When the scene or the record lacks what this needs.
    """
    of = sea_states(with_peak_period(record, sea_of(file).peak_enhancement))
    if directions is None:
        return [Heading(math.nan, file, of)]
    sector = directions.sector_of(record)
    every = zip(directions.headings, directions.scenes(file), strict=True)
    return [
        Heading(math.degrees(angle), scene, of.among(sector == k))
        for k, (angle, scene) in enumerate(every)
    ]


def simulate(heading: Heading, record: xr.Dataset, effort: Effort, notify: Notify) -> Part:
    """Simulate sea states of one heading, until the response between them is known.

    Raises
    ------
    InputError
        When the scene lacks what this needs, or the sea states lie on a line.
    SimulationError
        When so many sea states do not suffice.
    """
    if not math.isnan(heading.angle):
        notify(f"heading {heading.angle:g} deg: {heading.of.rows.sum()} rows")
    riser = RiserResponse(heading.file, effort.seeds, _interval(record), effort.cores)
    notify(_price(heading.of, riser, effort))
    found = cover(heading.of, riser, riser.allowed, effort.error, effort.most, notify=notify)
    none = np.full(len(riser.limits), math.nan)
    deviation, scale = (
        np.array([of.get((h, t), none) for h, t in found.states.tolist()])
        for of in (riser.deviation, riser.scale)
    )
    return Part(heading.angle, riser, heading.of, found, deviation, scale)


def _price(of: SeaStates, riser: RiserResponse, effort: Effort) -> str:
    """What a heading takes at least, in words, by one run."""
    chosen = first(of)
    least = len(chosen) + HELD_OUT
    runs = least * effort.seeds
    each = riser.seconds(of.states[chosen[-PRICED:]])
    seconds = runs * each / effort.cores
    time = "" if math.isnan(each) else f" of {each:.2g} s, {seconds:.2g} s on {effort.cores} cores"
    return f"at least {least} sea states, {runs} runs{time}, less what is stored; at most {effort.most}"


def _interval(record: xr.Dataset) -> float:
    """Time between rows of a record (s)."""
    return float(record.attrs["interval_hours"]) * 3600.0


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
