"""Watch circles of one run, limit by limit: when each is reached, and where alarms must be given."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr

from riserstudy.dataset.limits import EXCEEDED, label
from riserstudy.dataset.table import Cell, Table
from riserstudy.design.watch_circles import NEVER, TOO_LATE, watch_circle
from riserstudy.errors import InputError
from riserstudy.scene.resolve import Resolved

COLUMNS = ["limit", "reached", "offset", "red circle", "yellow circle", "note"]
UNITS = ["", "s", "m", "m", "m", ""]


class Times(NamedTuple):
    """What must be over before a limit is reached (s)."""

    disconnect: float  # from the red alarm on
    prepare: float  # from the yellow alarm to the red one


class Circles(NamedTuple):
    """Rows by mode, and what could not be evaluated."""

    table: Table
    missing: bool


def moves_off(scene: Resolved) -> None:
    """Refuse a scene that does not leave the well.

    Raises
    ------
    InputError
        When there is neither a vessel nor a cruising platform, or no time, or outputs begin late.
    """
    cruise = scene.platform and scene.platform.cruise
    if scene.vessel is None and not cruise:
        allowed = "Give `vessel` (drift-off) or `platform.cruise` (drive-off)"
        raise InputError("vessel", "", "absent: nothing leaves the well", allowed)
    if scene.analysis.duration is None:
        raise InputError("analysis.duration", "", "absent", "Give, for example, `300 s`")
    if scene.analysis.output and scene.analysis.output.start:
        found = f"{scene.analysis.output.start:g} s"
        why = "a limit that is reached before it would be missed"
        raise InputError("analysis.output.start", found, why, "Leave it out")
    if not scene.limits:
        allowed = "allowed is a list such as {output: lfj_angle, largest: 9 deg, mode: disconnect}"
        raise InputError("limits", "", "missing", allowed)


def offset_of(scene: Resolved, dataset: xr.Dataset) -> xr.DataArray:
    """Distance of the platform from the well over ``time`` (m), first-order motions left out."""
    time = dataset["time"]
    if scene.vessel:
        kind = "low_frequency" if scene.platform else "platform"
        x = (scene.top.offset or 0.0) + dataset[f"{kind}_surge"]
        y = dataset[f"{kind}_sway"] if f"{kind}_sway" in dataset else 0.0 * x
        return _distance(x, y)
    platform = scene.platform
    if platform is None or platform.cruise is None:
        raise TypeError("nothing leaves the well")  # asked before
    cruise, at = platform.cruise, platform.position
    ramp = cruise.ramp or 0.0
    late = (time - ramp).clip(min=0.0)
    early = time - late
    way = cruise.speed * (late + (0.5 * early**2 / ramp if ramp else 0.0))
    heading = cruise.heading or 0.0
    x = (scene.top.offset or 0.0) + ((at and at.surge) or 0.0) + way * math.cos(heading)
    y = ((at and at.sway) or 0.0) + way * math.sin(heading)
    return _distance(x, y)


def _distance(x: xr.DataArray, y: xr.DataArray) -> xr.DataArray:
    """From the well (m)."""
    return (x**2 + y**2) ** 0.5


def circles(scene: Resolved, dataset: xr.Dataset, times: Times, modes: Sequence[str]) -> Circles:
    """Red and yellow circle of each limit of some modes, and of each mode as a whole.

    Parameters
    ----------
    dataset : run of the scene.
    """
    offset = offset_of(scene, dataset)
    reached = json.loads(dataset.attrs["limits_reached"])
    verdicts = json.loads(dataset.attrs["limits"])
    rows: list[list[Cell]] = []
    missing = False
    for mode in modes:
        first, lost = math.inf, False
        for limit, time, row in zip(scene.limits or [], reached, verdicts, strict=True):
            if limit.mode != mode:
                continue
            why = _unknown(limit.side, time, row)
            lost = lost or bool(why)
            at = math.inf if isinstance(time, str) else float(time)
            first = min(first, at)
            rows.append(
                [label(limit), None, None, None, None, f"not evaluated: {why}"]
                if why
                else _row(label(limit), at, offset, times)
            )
        missing = missing or lost
        named = f"{mode}: first of all" + (" that are evaluated" if lost else "")
        rows.append(_row(named, first, offset, times))
    return Circles(Table(COLUMNS, UNITS, rows), missing)


def _unknown(side: str, time: float | str, row: dict[str, object]) -> str:
    """Why it is not known when a limit is first reached; empty where it is."""
    if side == "mean":
        return "a mean has no time at which it is reached. Give `largest`"
    if time == "unknown" or row["demand"] is None:
        return str(row["missing"] or f"no history of {row['output']}")
    if time == "never" and row["verdict"] == EXCEEDED:
        return "exceeded between two outputs. Give a shorter analysis.output.interval"
    return ""


def _row(name: str, first: float, offset: xr.DataArray, times: Times) -> list[Cell]:
    """Time, offset and both circles of one first time (s)."""
    if math.isinf(first):
        return [name, None, None, None, None, "not reached within the run"]
    there = float(np.interp(first, offset["time"], offset))
    cells: list[Cell] = [name, first, there]
    note = []
    for colour, before in (
        ("red", times.disconnect),
        ("yellow", times.disconnect + times.prepare),
    ):
        circle = watch_circle(xr.DataArray(first), offset, before)
        outcome = int(circle["circle_outcome"])
        late = outcome in (NEVER, TOO_LATE)
        cells.append(None if late else float(circle["circle_radius"]))
        note += [f"{colour}: an alarm at the start is too late"] if late else []
    return [*cells, "; ".join(note)]
