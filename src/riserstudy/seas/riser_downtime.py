"""Downtime of a riser: sea states of a record are simulated, and hours told by the responses between them."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from riserstudy.digests import engine_digest
from riserstudy.scene.load import SceneFile
from riserstudy.seas.cover import Cover, cover
from riserstudy.seas.extremes import check_seeds
from riserstudy.seas.hours import SeaLimit, met_by_rows
from riserstudy.seas.record import with_peak_period
from riserstudy.seas.riser_hours import RiserHours, met, riser_hours
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.sea_states import SeaStates, sea_states

if TYPE_CHECKING:
    import xarray as xr


class Downtime(NamedTuple):
    """What a record leaves a riser, and what that rests on."""

    hours: RiserHours
    responses: xr.Dataset  # over sea_state and limit
    sea_states: SeaStates
    lines: list[str]  # what was simulated, in words


def riser_downtime(
    file: SceneFile,
    record: xr.Dataset,
    limits: Sequence[SeaLimit] = (),
    *,
    seeds: int = 5,
    error: float = 0.05,
    most: int = 400,
    cores: int = 1,
    say: Callable[[str], None] = lambda _: None,
) -> Downtime:
    """Hours of a record that the limits of a riser leave.

    Parameters
    ----------
    file : a scene with limits, an irregular sea and a duration; all seas come from its heading.
    record : of `riserstudy.seas.record.read_record`.
    limits : on the sea itself, that must be met, too.
    seeds : runs of each sea state: 1, or 5 and more.
    error : of the response between sea states, over what is allowed, or the response if that is more.
    most : sea states to simulate at most.
    say : is given what comes next.

    Raises
    ------
    InputError
        When the scene or the record lacks what this needs.
    SimulationError
        When so many sea states do not suffice.
    """
    check_seeds(seeds)
    interval = float(record.attrs["interval_hours"]) * 3600.0
    riser = RiserResponse(file, seeds, interval, cores, say)
    peaked = with_peak_period(record, riser.sea.peak_enhancement)
    of = sea_states(peaked)
    riser.prepare(of.states)
    found = cover(of, riser, riser.allowed, error, most, say=say)
    deviation = np.array(
        [
            riser.deviation.get(tuple(s), np.full(len(riser.limits), np.nan))
            for s in found.states.tolist()
        ]
    )
    which = met(of, found, deviation, riser.limits)
    hours = riser_hours(peaked, of, found, which, riser.limits, met_by_rows(record, limits))
    return Downtime(
        hours, _dataset(riser, found, deviation), of, _lines(riser, found, hours, record)
    )


def _lines(riser: RiserResponse, found: Cover, hours: RiserHours, record: xr.Dataset) -> list[str]:
    """What was simulated, in words."""
    compared = int(found.held_out.sum())
    lines = [
        f"{len(found.states)} sea states of {riser.told:g} s, {riser.seeds} seeds each; "
        f"at {compared} that were compared the response is off by up to {found.error.max():.1%}"
    ]
    if "wave_from_direction" in record:
        lines.append(
            "directions of the record are not used: all seas come from the scene's heading"
        )
    for (height, period), why in list(riser.failures.items())[:3]:
        lines.append(f"no result in {height:g} m, {period:g} s: {why}")
    if hours.unknown:
        lines.append(
            f"{hours.unknown:.2%} of the rows lie beside such seas, and count as not workable"
        )
    return lines


def _dataset(riser: RiserResponse, found: Cover, deviation: np.ndarray) -> xr.Dataset:
    """Responses over sea states and limits."""
    import xarray as xr

    labels = riser.labels
    sides = np.array([one.side for one in riser.limits], object)
    both = ("sea_state", "limit")
    return xr.Dataset(
        {
            "demand_of_limit": (
                both,
                found.responses,
                {"long_name": "demand, in the unit of its limit"},
            ),
            "standard_error": (both, deviation, {"long_name": "standard error for want of seeds"}),
            "held_out": (
                "sea_state",
                found.held_out.astype(np.int8),
                {"long_name": "compared alone"},
            ),
            "allowed": (
                "limit",
                riser.allowed,
                {"long_name": "what is allowed, in the unit of its limit"},
            ),
            "surface_error": (
                "limit",
                found.error,
                {"units": "1", "long_name": "largest difference"},
            ),
            "unit": ("limit", np.array(riser.units, object), {"long_name": "unit of the limit"}),
            "side": ("limit", sides, {"long_name": "which side is limited"}),
        },
        {
            "limit": ("limit", np.array(labels, object), {"long_name": "limit"}),
            "significant_wave_height": (
                "sea_state",
                found.states[:, 0],
                {"units": "m", "long_name": "significant wave height"},
            ),
            "peak_period": (
                "sea_state",
                found.states[:, 1],
                {"units": "s", "long_name": "peak period"},
            ),
        },
        {
            "Conventions": "CF-1.11",
            "title": f"{riser.file.tree.get('title') or 'a riser'}: limits over sea states",
            "scene": json.dumps(riser.file.tree),
            "engine": engine_digest(),
            "seeds": riser.seeds,
            "interval_hours": riser.interval / 3600.0,
        },
    )
