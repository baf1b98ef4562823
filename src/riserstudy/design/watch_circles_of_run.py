"""Watch circles of one run: for each limit, the time at which it is reached, and offsets of the alarms."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from riserstudy.dataset.limits import EXCEEDED, UNKNOWN, error_of, labels, too_coarse
from riserstudy.dataset.table import Cell, Table
from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.records.numerals import at_most
from riserstudy.scene.limits import Limit
from riserstudy.scene.resolve import Resolved

ROUNDING = 1e-9
COLUMNS = ["limit", "reached", "offset", "red circle", "yellow circle", "note"]
UNITS = ["", "s", "m", "m", "m", ""]
FOR_A_CUBIC = 4  # smallest number of outputs for a cubic spline
COARSE = 0.01  # error by coarse outputs, as a share of the radius, from which on it is reported
LEAST = 0.01  # m, error below which it is not reported
DENSE = 16  # outputs in the shortest period from which on no peak between outputs exceeds them by 2 %


class Times(NamedTuple):
    """Durations that must end before a limit is reached (s)."""

    disconnect: float  # from the red alarm on
    prepare: float  # from the yellow alarm to the red alarm


class Circles(NamedTuple):
    """Rows by mode, and the limits that could not be evaluated."""

    table: Table
    missing: bool


def moves_off(scene: Resolved, source: str) -> None:
    """Refuse a scene, of the file ``source``, that does not leave the well.

    Raises InputError when there is neither a vessel nor a cruising platform, the riser hangs free or
    disconnects during the run, the scene is static, or outputs begin late.
    """
    cruise = scene.platform and scene.platform.cruise
    if scene.vessel is None and not cruise:
        allowed = "give `vessel` (drift-off) or `platform.cruise` (drive-off)"
        raise InputError(source, "vessel", "missing, so the platform does not leave the well", allowed)
    if scene.bottom.hold == "free":
        found = "'free' means a hung-off riser, which cannot disconnect"
        allowed = "write `wellhead`, or check the limits of the hung-off riser with `riserstudy check`"
        raise InputError(source, "bottom.hold", found, allowed)
    if scene.analysis.duration is None:
        found = "missing, but watch circles require a dynamic run"
        raise InputError(source, "analysis.duration", found, "give, for example, `300 s`")
    if scene.disconnect:
        at = scene.disconnect.at
        found = f"after the disconnect at {at:g} s, limits apply to a hung-off riser, or not at all"
        raise InputError(source, "disconnect", found, "remove it with `--set disconnect=null`")
    if scene.analysis.output and scene.analysis.output.start:
        found = f"limits that are reached before {scene.analysis.output.start:g} s would be missed"
        raise InputError(source, "analysis.output.start", found, "remove it")
    if not scene.limits:
        allowed = "add a list with items such as {output: lfj_angle, largest: 9 deg, mode: disconnect}"
        raise InputError(source, "limits", "missing, but watch circles are computed from limits", allowed)


class Way(NamedTuple):
    """Distance of the platform from the well at a time (m), and its estimated error between outputs (m)."""

    at: Callable[[float], float]
    error: Callable[[float], float]


def way_of(scene: Resolved, dataset: xr.Dataset) -> Way:
    """Distance of the platform from the well over time, without first-order motions.

    The distance of a cruise is known at any time. The distance of a vessel is a cubic spline through the
    outputs. Its error is at most the error of linear interpolation; the deviation of the two is the estimated
    error.
    """
    time = dataset["time"].values
    if scene.vessel is None:
        return Way(lambda t: float(_cruised(scene, min(t, float(time[-1])))), lambda _: 0.0)
    kind = "low_frequency" if scene.platform else "platform"
    x = (scene.top.offset or 0.0) + dataset[f"{kind}_surge"].values
    place = np.array([x, dataset[f"{kind}_sway"].values if f"{kind}_sway" in dataset else 0.0 * x])

    def straight(t: float) -> float:
        return math.hypot(*(float(np.interp(t, time, part)) for part in place))

    if len(time) < FOR_A_CUBIC:
        longest = float(np.hypot(*np.diff(place)).max(initial=0.0))
        return Way(straight, lambda _: longest)
    from scipy.interpolate import CubicSpline  # slow to load

    cubic = CubicSpline(time, place, axis=1)

    def curved(t: float) -> float:
        return math.hypot(*cubic(min(t, float(time[-1]))))

    return Way(curved, lambda t: abs(curved(t) - straight(t)))


def _cruised(scene: Resolved, time: float) -> float:
    """Distance of a cruising platform from the well (m) at a time (s)."""
    platform = scene.platform
    if platform is None or platform.cruise is None:
        raise TypeError("nothing leaves the well")  # excluded by the caller
    cruise, at = platform.cruise, platform.position
    ramp = cruise.ramp or 0.0
    late = max(time - ramp, 0.0)
    early = time - late
    way = cruise.speed * (late + (0.5 * early**2 / ramp if ramp else 0.0))
    heading = cruise.heading or 0.0
    x = (scene.top.offset or 0.0) + ((at and at.surge) or 0.0) + way * math.cos(heading)
    y = ((at and at.sway) or 0.0) + way * math.sin(heading)
    return math.hypot(x, y)


def circles(scene: Resolved, dataset: xr.Dataset, times: Times, modes: Sequence[str]) -> Circles:
    """Red and yellow circle of each limit of some modes, and of each mode as a whole.

    ``dataset``: run of the scene.
    """
    way = way_of(scene, dataset)
    reached = json.loads(dataset.attrs["limits_reached"])
    errors = json.loads(dataset.attrs["limits_reached_error"])
    verdicts = json.loads(dataset.attrs["limits"])
    facts = {name: json.loads(dataset.attrs.get(name, "{}")) for name in ("extremes", "error_estimate")}
    sparse = _sparse(scene, dataset["time"].values)
    rows: list[list[Cell]] = []
    missing = False
    for mode in modes:
        first, earliest, lost, unsure = math.inf, math.inf, False, list[str]()
        evaluated = 0
        limits = scene.limits or []
        for limit, name, time, error, row in zip(
            limits, labels(limits), reached, errors, verdicts, strict=True
        ):
            if limit.mode != mode:
                continue
            why = _unknown(limit.side, time, row)
            lost = lost or bool(why)
            evaluated += not why
            at = math.inf if isinstance(time, str) else float(time)
            first, earliest = min(first, at), min(earliest, at - error)
            remark = "" if why else _unsure(scene, limit, time, facts, sparse if error else "")
            unsure += [name] if remark else []
            rows.append(
                [name, None, None, None, None, f"not evaluated: {why}"]
                if why
                else _row(name, at, error, way, times, remark)
            )
        missing = missing or lost
        named = f"{mode}: first of all" + (" that are evaluated" if lost else "")
        remark = f"circles may be too large: see the notes of {', '.join(unsure)}" if unsure else ""
        if evaluated:
            rows.append(_row(named, first, first - earliest, way, times, remark))
        else:
            rows.append([named, None, None, None, None, "not evaluated: no limit of this mode is"])
    return Circles(Table(COLUMNS, UNITS, rows), missing)


def _unknown(side: str, time: float | str, row: dict[str, object]) -> str:
    """Why the time at which a limit is first reached is not known; empty if it is known."""
    if side == "mean":
        return "a mean has no time at which it is reached. Give `largest`"
    if time == "unknown" or row["demand"] is None:
        return str(row["missing"] or f"no history of {row['output']}")
    if time == "never" and row["verdict"] == EXCEEDED:
        return "exceeded between two outputs. Give a shorter analysis.output.interval"
    if time == "never" and row["verdict"] == UNKNOWN:  # within its error, the limit may be reached
        return str(row["missing"])
    return ""


def _unsure(scene: Resolved, limit: Limit, time: float | str, facts: dict[str, Any], sparse: str) -> str:
    """Note on the error of a time at which a limit is reached; empty if it is small.

    ``sparse``: why peaks between outputs are not known; empty if they are known.
    """
    if isinstance(time, str):
        return ""
    whys = []
    if scene.analysis.mesh and (why := too_coarse(limit, error_of(limit.output, facts, own_mesh=True))):
        whys.append(why)
    whys += [sparse] if sparse else []
    return f"circles may be too large: {'; '.join(whys)}" if whys else ""


def _sparse(scene: Resolved, time: FloatArray) -> str:
    """Why a peak between outputs, at these times (s), may reach a limit earlier; empty if it cannot."""
    period = scene.shortest_period
    if period is None or float(np.diff(time).max(initial=0.0)) <= period / DENSE * (1.0 + ROUNDING):
        return ""
    most = at_most(period / DENSE)
    return f"an earlier peak may be between outputs; give an analysis.output.interval of at most {most} s"


def _row(name: str, first: float, error: float, way: Way, times: Times, remark: str = "") -> list[Cell]:
    """Time, offset and both circles for a first time (s) with an error (s).

    ``remark``: a further note on the error of the limited output.
    """
    if math.isinf(first):
        return [name, None, None, None, None, "not reached within the run"]
    cells: list[Cell] = [name, first, way.at(first)]
    note, doubt = [remark] if remark else [], 0.0
    for colour, before in (("red", times.disconnect), ("yellow", times.disconnect + times.prepare)):
        latest = first - before
        cells.append(way.at(latest) if latest > 0.0 else None)
        if latest <= 0.0:
            note.append(f"{colour}: an alarm at the start is too late")
            continue
        if (begun := way.at(0.0)) > way.at(latest) + LEAST:
            note.append(f"{colour}: the run begins {begun:.4g} m from the well, beyond this circle")
        shifted = abs(way.at(latest) - way.at(max(latest - error, 0.0)))
        unsure = way.error(latest) + shifted
        if unsure > max(COARSE * way.at(latest), LEAST):
            doubt = max(doubt, unsure)
    if doubt:
        note.append(
            f"outputs are too coarse: circles may be {doubt:.2g} m too large. "
            "Give a shorter analysis.output.interval"
        )
    return [*cells, "; ".join(note)]
