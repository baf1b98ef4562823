"""Parts of the riser that limits apply to, with their allowables, for a plot over arclength."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, NamedTuple

from riserstudy.dataset.limits import sections_of
from riserstudy.dataset.provenance import first_scene
from riserstudy.errors import InputError
from riserstudy.scene.limits import ENDS, Limit, sections_at

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.scene.resolve import Resolved


class Span(NamedTuple):
    """A part of the riser with a limit; both ends are equal for a limit at the end of a section."""

    allowable: float  # in the SI unit of the output
    low: float  # arclength (m); infinite: the end of the riser
    high: float
    until_disconnect: bool = False  # whether it does not apply after a disconnect in the run


def limited_spans(run: xr.Dataset, output: str) -> list[Span]:
    """Parts of a run's riser with a limit on the largest or smallest value of an output.

    Of a dataset without a scene, only limits without a place are known, and their parts are not.
    """
    try:
        scene = first_scene(run)
    except InputError:
        rows = json.loads(run.attrs.get("limits", "[]"))
        known = [row for row in rows if not row["at"] and row["allowable"] is not None]
        return [Span(row["allowable"], -math.inf, math.inf) for row in known if row["output"] == output]
    limits = [one for one in scene.limits or [] if one.output == output and one.side != "mean"]
    released = math.isfinite(scene.connected_until)
    return [
        Span(limit.allowable, *_ends(scene, limit), released and limit.ends_with_disconnect)
        for limit in limits
    ]


def _ends(scene: Resolved, limit: Limit) -> tuple[float, float]:
    """Arclengths (m) between which a limit applies."""
    names = [section.name for section in scene.riser]
    borders = scene.borders
    within = sections_at(limit.at, names) if limit.at else [one.name for one in sections_of(scene, limit)]
    low, high = borders[names.index(within[0])], borders[names.index(within[-1]) + 1]
    if limit.place.startswith(ENDS[0]):
        return low, low
    return (high, high) if limit.place.startswith(ENDS[1]) else (low, high)
