"""Workable hours of a record by the limits of a riser, for each mode, and hours lost by each limit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.limits import labels
from riserstudy.dataset.table import Cell, Table
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.limits import UNITS as OUTPUT_UNITS
from riserstudy.scene.limits import Limit
from riserstudy.seas.cover import Cover, scale_of
from riserstudy.seas.hours import Hours, hours_of, one_each
from riserstudy.seas.lost_hours import lost_by
from riserstudy.seas.sea_states import SeaStates
from riserstudy.seas.stops import in_operation
from riserstudy.seas.surface import Surface

if TYPE_CHECKING:
    import xarray as xr

Flags = NDArray[np.bool_]
#: modes, each with the modes whose limits must be met: a drilling riser is also connected
MODES = {
    "drilling": ("drilling", "connected", "disconnect"),
    "connected": ("connected", "disconnect"),
    "disconnect": ("disconnect",),
}
COLUMNS = ["limit", "exceeded", "alone", "allowed", "worst", "unit", "error"]
UNITS = ["", "%", "%", "*", "*", "", "%"]


class OfMode(NamedTuple):
    """Workable hours of a mode, and their range due to the uncertainty of the response."""

    mode: str
    hours: Hours
    low: float
    high: float


class RiserHours(NamedTuple):
    """Workable hours of a riser."""

    modes: list[OfMode]
    # for each limit: share of rows in which it is exceeded, and in which it is the only exceeded limit of its
    # mode and of the sea
    limits: Table
    # share of rows next to sea states whose runs failed, which count as not workable
    unknown: float


class Response(NamedTuple):
    """Demands of limits, (n, limits), in sea states or in rows, in the unit of each limit's output."""

    demand: FloatArray  # estimate of the value that nine in ten intervals do not exceed
    off: FloatArray  # its error by the surface, the mesh and headings in between
    # ends of its band because of few seeds, in addition: towards worse and better demands
    seeds_worse: FloatArray
    seeds_better: FloatArray
    scale: FloatArray  # scale of its Gumbel distribution from interval to interval


class Met(NamedTuple):
    """Whether limits are met in rows, (n, limits): nominally, at worst and at best; and the response."""

    found: Flags
    worst: Flags
    best: Flags
    demand: FloatArray
    off: FloatArray
    seeds_worse: FloatArray
    seeds_better: FloatArray
    scale: FloatArray

    def among(self, rows: Flags) -> Met:
        """The same for some rows, (n,)."""
        return Met(self.found[rows], self.worst[rows], self.best[rows], *(of[rows] for of in self[3:]))


def excess_of(demand: FloatArray, allowed: FloatArray, sides: Sequence[str]) -> FloatArray:
    """Amounts by which demands, (n, limits), exceed the allowables, (limits,); below zero: met."""
    excess: FloatArray = np.where(np.array(sides) == "smallest", -1.0, 1.0) * (demand - allowed)
    return excess


def response_of(
    of: SeaStates,
    cover: Cover,
    deviation: FloatArray,
    scale_of_extremes: FloatArray,
    limits: Sequence[Limit],
    ends: FloatArray,
    mesh_error: FloatArray | float = 0.0,
) -> Response:
    """The response to the sea states of a record.

    Parameters
    ----------
    deviation : (n, limits) standard errors at the cover's sea states, in the unit of each limit's output; NaN
        if not known.
    scale_of_extremes : (n, limits) scales of the Gumbel distribution of extremes there.
    ends : (2, limits) ends of the band by few seeds, worse and better, in standard errors.
    mesh_error : (limits,) change by mesh and step, relative to the allowable or the demand.
    """
    allowed = np.array([limit.allowable for limit in limits])
    demand = cover.surface.at(of.states)
    kept = ~cover.held_out
    # for one seed, the error is not known; for a failed run, nothing is known, as its demand shows
    both = np.nan_to_num(np.hstack([deviation[kept], scale_of_extremes[kept]]))
    seeds, extremes = np.hsplit(Surface(cover.states[kept], both).at(of.states), 2)
    scale = np.maximum(scale_of(allowed, cover.responses[kept]), np.abs(demand))
    worse, better = ends[:, None, :] * np.abs(seeds)
    return Response(demand, (cover.error + mesh_error) * scale, worse, better, np.maximum(extremes, 0.0))


def by_rows(parts: Sequence[tuple[SeaStates, FloatArray, Response]]) -> tuple[Flags, Response]:
    """Flags of known rows of the record, (rows,), and the response in these, (known, limits).

    ``parts``: for each heading, its sea states, its weights in the rows, (rows,), and its response; in each
    row, the weights sum to one.
    """
    rows = len(parts[0][1])
    known = np.any([weight > 0.0 for _, weight, _ in parts], axis=0)
    whole = Response(*(np.zeros((rows, values.shape[1])) for values in parts[0][2]))
    for of, weight, one in parts:
        at = weight > 0.0
        for target, values in zip(whole, one, strict=True):
            target[at] += weight[at, None] * values[of.state_of_row[at]]
    return np.asarray(known), Response(*(values[known] for values in whole))


def met(rows: Response, limits: Sequence[Limit]) -> Met:
    """Limits that are met in rows: nominally, and with the demand changed by its uncertainty."""
    allowed = np.array([limit.allowable for limit in limits])
    excess = excess_of(rows.demand, allowed, [limit.side for limit in limits])
    worst, best = excess + rows.off + rows.seeds_worse, excess - rows.off - rows.seeds_better
    # NaN counts as not met
    return Met(excess <= 0.0, worst <= 0.0, best <= 0.0, *rows)


def riser_hours(
    record: xr.Dataset,
    known: Flags,
    rows: Met,
    limits: Sequence[Limit],
    error: FloatArray,
    sea: Mapping[str, Flags],
    resuming: Flags,
) -> RiserHours:
    """Workable hours by mode.

    Parameters
    ----------
    known : (rows,) from `by_rows`.
    rows : from `met`.
    error : (limits,) largest error of the response, as a share of the allowable.
    sea : for each limit on the sea, whether the rows meet it, (rows,).
    resuming : (rows,) whether they meet the limits on the sea for resuming.
    """
    single = one_each(record, known)
    rows = rows.among(single[known])
    of_sea = {name: flags[single] for name, flags in sea.items()}
    also = np.all([np.ones(len(rows.found), bool), *of_sea.values()], axis=0)
    modes = []
    for mode, needed in MODES.items():
        of_mode = [k for k, limit in enumerate(limits) if limit.mode in needed]
        if not any(limits[k].mode == mode for k in of_mode):
            continue
        riser, worst, best = (
            np.asarray(flags[:, of_mode].all(axis=1)) for flags in (rows.found, rows.worst, rows.best)
        )
        resumes = resuming[single]
        hours = hours_of(record, known, single, riser & also, resumes)._replace(lost=lost_by(of_sea, riser))
        low, high = (
            float(in_operation(flags & also, resumes, hours.joined).mean()) for flags in (worst, best)
        )
        modes.append(OfMode(mode, hours, low, high))
    lost = np.asarray(np.isnan(rows.demand).any(axis=1))
    return RiserHours(modes, _by_limit(rows, limits, error, lost, also), float(lost.mean()))


def _by_limit(rows: Met, limits: Sequence[Limit], error: FloatArray, lost: Flags, also: Flags) -> Table:
    """Share of rows in which each limit is exceeded, and in which only this limit of its mode is.

    ``lost``, ``also``: (rows,) rows without a response, and rows that meet all limits on the sea.
    """
    exceeded = ~rows.found & ~lost[:, None]
    table: list[list[Cell]] = []
    for k, (limit, name) in enumerate(zip(limits, labels(limits), strict=True)):
        among = [n for n, other in enumerate(limits) if other.mode in MODES[limit.mode]]
        alone = exceeded[:, k] & (exceeded[:, among].sum(axis=1) == 1) & also
        sided = np.nanmin if limit.side == "smallest" else np.nanmax
        table.append(
            [
                name,
                100.0 * float(exceeded[:, k].mean()),
                100.0 * float(alone.mean()),
                limit.allowable,
                float(sided(rows.demand[:, k])),
                OUTPUT_UNITS[limit.output],
                100.0 * float(error[k]),
            ]
        )
    return Table(COLUMNS, UNITS, table)
