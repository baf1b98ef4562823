"""The simulated responses behind workable hours, as a dataset and in words."""

from __future__ import annotations

import json
import math
from collections.abc import Collection, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.limits import FINER, SURE
from riserstudy.dataset.statistics import NOT_EXCEEDED
from riserstudy.files.digests import engine_digest
from riserstudy.records.numerals import newtons, percent
from riserstudy.records.words import counted, listed
from riserstudy.scene.load import SceneFile
from riserstudy.seas.between_headings import Middle
from riserstudy.seas.directions import FROM
from riserstudy.seas.heading_parts import Part
from riserstudy.seas.mesh_of_seas import has_own_mesh
from riserstudy.seas.netcdf_record import CONVERTED
from riserstudy.seas.record import with_peak_period
from riserstudy.seas.riser_hours import RiserHours
from riserstudy.seas.sea_states import with_calm_periods
from riserstudy.study.departures import prescribed_motions
from riserstudy.study.in_sea import heading_paths, sea_of

if TYPE_CHECKING:
    import xarray as xr


def largest_errors(parts: Sequence[Part], middles: Sequence[Middle]) -> NDArray[np.float64]:
    """Largest relative error of the response in comparisons, (limits,), of all headings."""
    errors = [*(part.cover.error for part in parts), *(middle.error for middle in middles)]
    return np.asarray(np.max(errors, axis=0))


def summarise(
    parts: Sequence[Part],
    middles: Sequence[Middle],
    hours: RiserHours,
    record: xr.Dataset,
    used: Collection[str],
) -> list[str]:
    """A summary of the simulations, as lines of text.

    ``used``: quantities of the record that limits on the sea name.
    """
    directed = not math.isnan(parts[0].heading.angle)
    return [
        *_of_seas(parts, directed),
        *_of_demands(parts),
        *_of_record(parts[0].riser.file, record, used),
        *_of_all_seas(parts[0].riser.file),
        *_of_headings(parts[0].riser.file, middles, record, directed),
        *_of_rows(parts, middles, hours, directed),
        *(f"{one.mode}: {lost}" for one in hours.modes for lost in one.hours.lost),
        *hours.modes[0].hours.notes,
    ]


def _of_seas(parts: Sequence[Part], directed: bool) -> Iterator[str]:
    """Lines about the simulated sea states and their meshes."""
    riser = parts[0].riser
    count = sum(len(part.cover.states) for part in parts)
    compared = sum(int(part.cover.held_out.sum()) for part in parts)
    off = max(float(part.cover.error.max()) for part in parts)
    many = f" in {counted(len(parts), 'heading')}" if directed else ""
    yield (
        f"{counted(count, 'sea state')}{many} of {riser.exposure:g} s, {counted(riser.seeds, 'seed')} each; "
        f"at the {compared} sea states of the check, the interpolated response differs by up to {off:.1%}"
    )
    if meshes := [part.mesh for part in parts if part.mesh]:
        words = sorted({one.words for one in meshes})
        off = max(float(one.error.max()) for one in meshes)
        yield (
            f"runs on {' or '.join(words)}; compared with runs that meet the scene's accuracy, demands "
            f"differ by up to {off:.1%}"
        )


def _of_demands(parts: Sequence[Part]) -> Iterator[str]:
    """Lines about the meaning of demands, and about their errors."""
    riser = parts[0].riser
    if riser.seeds > 1 and any(limit.side != "mean" for limit in riser.limits):
        yield (
            f"demands of extremes: estimates, without bias, of the value that {percent(NOT_EXCEEDED)} of the "
            f"intervals of {riser.interval / 3600.0:g} h do not exceed; {percent(riser.exceeded)} exceed an "
            f"estimate from {riser.seeds} seeds on average"
        )
    for name, mud in zip(riser.labels, riser.mud, strict=True):
        if mud > 0.0:
            yield (
                f"{name}: demands are those of runs minus {newtons(mud)}, the weight of the contents above "
                "the riser's upper end"
            )
    errors = np.max([part.estimated for part in parts], axis=0)
    if (off := float(errors.max())) > 0.0:
        own = has_own_mesh(riser.file) and not any(part.mesh for part in parts)
        kind = "mesh and step" if own else "accuracy"
        worst = riser.labels[int(errors.argmax())]
        yield (
            f"with the scene's {kind}, demands have an estimated error of up to {off:.1%} ({worst})"
            f"{f'; {FINER}' if own and off > SURE else ''}"
        )
    if riser.seeds == 1:
        yield "no band includes the effect of other seeds, which is unknown"


def _of_headings(
    file: SceneFile, middles: Sequence[Middle], record: xr.Dataset, directed: bool
) -> Iterator[str]:
    """Lines about directions of the record, and about seas between the simulated headings."""
    if FROM in record and not directed:
        why = "all seas have the heading of the scene"
        if not heading_paths(file):
            why = "the operators have no headings, so the response is equal from all sides"
        yield f"directions of the record are not used: {why}"
    if middles:
        count = sum(len(one.states) for one in middles)
        off = max(float(one.error.max()) for one in middles)
        yield (
            f"at {count} sea states half-way between headings, the interpolated response differs by up to "
            f"{off:.1%}"
        )
        if failed := sum(int(np.isnan(one.responses).any(axis=1).sum()) for one in middles):
            yield f"{failed} of these sea states have no result, and no band includes their error"
    elif directed:
        yield "each row uses the nearest heading; no band includes the effect of headings in between"


def _of_rows(
    parts: Sequence[Part], middles: Sequence[Middle], hours: RiserHours, directed: bool
) -> Iterator[str]:
    """Lines about sea states without a result, and about rows of the record that do not count."""
    risers = [*(part.riser for part in parts), *(middle.riser for middle in middles)]
    failures = [one for of in risers for one in of.failures.items()]
    for (height, period), why in failures[:3]:
        yield f"no result in {height:g} m, {period:g} s: {why}"
    if hours.unknown:
        yield (
            f"{hours.unknown:.2%} of the rows are next to such seas, and count as not workable; limits with "
            "such rows have no return values"
        )
    if lacking := hours.modes[0].hours.lacking:
        direction = ", a direction" if directed else ""
        yield (
            f"{counted(lacking, 'further row')} of the record without a height, a period{direction} or a "
            "value of a limit on the sea, not counted"
        )


def _of_record(file: SceneFile, record: xr.Dataset, used: Collection[str]) -> list[str]:
    """How periods of a record were found, and which of its quantities have no effect."""
    gamma = sea_of(file).peak_enhancement
    period = with_calm_periods(with_peak_period(record, gamma))["peak_period"]
    lines = [f"peak_period: {period.attrs['comment']}"] if "comment" in period.attrs else []
    converted = period.attrs.get(CONVERTED, gamma)
    if not math.isclose(converted, gamma, rel_tol=1e-6):
        lines.append(
            f"peak_period: converted from zero-upcrossing periods with a gamma of {converted:g}; the scene "
            f"has {gamma:g}, so the simulated seas have other zero-upcrossing periods than the record; write "
            f"the record by `riserstudy seas --gamma {gamma:g}`"
        )
    if idle := [name for name in ("wind_speed", "current_speed") if name in record and name not in used]:
        lines.append(
            f"not used: {' and '.join(idle)} of the record; all rows have the current and wind of the scene"
        )
    return lines


def _of_all_seas(file: SceneFile) -> Iterator[str]:
    """Lines about motions and forces of a platform that are equal in all sea states."""
    scene = file.resolved()
    if names := prescribed_motions(scene):
        yield (
            f"prescribed {listed(names)} of the platform: equal in all sea states, in addition to the "
            "response to the sea"
        )
    if scene.vessel and scene.vessel.wave_drift:
        yield "wave drift of the vessel: the force of the scene acts in all sea states"


def dataset_of(file: SceneFile, parts: Sequence[Part], middles: Sequence[Middle]) -> xr.Dataset:
    """Responses over sea states and limits."""
    import xarray as xr

    riser = parts[0].riser
    each = [
        *((p.heading.angle, p.cover.states, p.cover.responses, p.deviation) for p in parts),
        *((m.heading, m.states, m.responses, m.deviation) for m in middles),
    ]
    states, demand, deviation = (np.concatenate([one[k] for one in each]) for k in (1, 2, 3))
    headings = np.repeat([one[0] for one in each], [len(one[1]) for one in each])
    compared = np.ones(sum(len(one.states) for one in middles), bool)
    held = np.concatenate([*(p.cover.held_out for p in parts), compared]).astype(np.int8)
    worst = largest_errors(parts, middles)
    sides, units, labels = (
        np.array(values, object) for values in ([one.side for one in riser.limits], riser.units, riser.labels)
    )
    both, state, limit = ("sea_state", "limit"), "sea_state", "limit"
    own = "in the unit of the limit"
    return xr.Dataset(
        {
            "demand_of_limit": (both, demand, {"long_name": f"demand, {own}"}),
            "standard_error": (both, deviation, {"long_name": f"of the demand by seeds, {own}"}),
            "held_out": (state, held, {"long_name": "1: simulated to compare"}),
            "allowed": (limit, riser.allowed, {"long_name": f"allowable, {own}"}),
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
