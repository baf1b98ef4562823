"""Workable hours of a record over a grid of settings as one dataset, made part by part from the store."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from importlib.metadata import version
from typing import Any

import numpy as np
import xarray as xr

from riserstudy.dataset.label import history
from riserstudy.dataset.title import titled
from riserstudy.dataset.variables import attributes
from riserstudy.files.digests import engine_digest
from riserstudy.scene.units import to_si
from riserstudy.seas.directions import Directions, directions_that_count
from riserstudy.seas.heading_parts import Effort, headings, riser_half_way, simulate
from riserstudy.seas.hours import sea_limit, whole
from riserstudy.seas.record import read_record
from riserstudy.seas.riser_downtime import Downtime, Notify, riser_downtime
from riserstudy.seas.riser_hours import MODES, OfMode
from riserstudy.seas.riser_returns import returned
from riserstudy.seas.synthetic import synthetic
from riserstudy.study.collect import add_on_axes
from riserstudy.study.months import MONTHS
from riserstudy.study.seas_model import SeasModel, SyntheticModel
from riserstudy.study.seas_study import SeasStudy

#: variables of sea states from `riser_downtime`, with or without the dimension of limits
OF_STATES = ("demand_of_limit", "standard_error", "held_out")


def record_of(study: SeasStudy) -> xr.Dataset:
    """The record of a study."""
    of = study.model.record
    if isinstance(of, SyntheticModel):
        return synthetic(of.years, of.seed)
    return read_record(study.config / of)


def directions_of(study: SeasStudy) -> Directions | None:
    """Conversion of directions to headings."""
    of = study.model.headings
    return Directions(of.sectors, to_si(of.x_towards, "rad")) if of else None


def effort_of(study: SeasStudy, cores: int) -> Effort:
    """Extent of the simulations."""
    return Effort(study.model.seeds, study.model.error, study.model.most, cores)


def simulate_part(study: SeasStudy, number: int, cores: int, notify: Notify) -> int:
    """Simulate and store one setting in one heading, and half-way to the next; returns the number of seas.

    Raises InputError when the record lacks what this needs. Raises SimulationError when so many sea states do
    not suffice.
    """
    file, sector = study.part(number)
    record = record_of(study)
    directions = directions_that_count(directions_of(study), file, record)
    if sector and directions is None:
        notify("equal to the first heading, because the operators have no headings")
        return 0
    heading = headings(file, record, directions)[sector]
    if not heading.of.rows.any():
        notify("no row of the record has this heading")
        return 0
    effort = effort_of(study, cores)
    part = simulate(heading, record, effort, notify)
    if heading.half is None:
        return len(part.cover.states)
    riser_half_way(heading.half, part)(heading.half.states)
    return len(part.cover.states) + len(heading.half.states)


def seas_hours(study: SeasStudy, cores: int, notify: Notify) -> xr.Dataset:
    """Workable hours at each setting, the limits that reduce them, and the responses behind them.

    Raises InputError when the record lacks what this needs. Raises SimulationError when so many sea states do
    not suffice.
    """
    record, effort = record_of(study), effort_of(study, cores)
    limits = [sea_limit(one) for one in study.model.sea_limits]
    found = []
    for point in study.settings.plan:
        made = riser_downtime(
            study.settings.grid.file(point.index),
            record,
            limits,
            directions=directions_of(study),
            notify=notify,
            **effort._asdict(),
        )
        for line in made.lines:
            notify(line)
        found.append(made)
    windows = [to_si(one, "s") / 3600.0 for one in study.model.windows]
    model = study.model
    flat = xr.concat(
        [_of_setting(one, windows, model) for one in found],
        "setting",
        join="outer",
        coords="minimal",
        compat="override",
    )
    dataset = xr.Dataset(coords={name: flat[name] for name in flat.coords if name != "setting"})
    add_on_axes(dataset, flat, "setting", study.settings)
    dataset = dataset.assign(_sea_states(found, study))
    for name in set(dataset.variables).difference(study.settings.axes):
        dataset[name].attrs = attributes(str(name)) | dataset[name].attrs
    dataset.attrs = _about(study, found, record)
    return dataset


def _of_setting(of: Downtime, windows: Sequence[float], model: SeasModel) -> xr.Dataset:
    """Workable hours of one setting."""
    hours = of.hours
    modes = {one.mode: one for one in hours.modes}
    columns = np.array([row[1:3] for row in hours.limits.rows], float) / 100.0
    each = [_of_mode(one, windows, model) for one in modes.values()]
    dataset = xr.concat(each, "riser_mode", join="outer").assign_coords(riser_mode=list(modes))
    labels = [str(row[0]) for row in hours.limits.rows]
    errors = of.responses["response_error"].values
    return (
        dataset.assign(
            {
                "exceeded": ("limit", columns[:, 0]),
                "exceeded_alone": ("limit", columns[:, 1]),
                "response_error": ("limit", errors),
                "unknown_hours": hours.unknown,
            }
        )
        .assign_coords(limit=labels)
        .assign(_returns(of, labels, model.return_periods))
    )


def _returns(of: Downtime, labels: list[str], periods: Sequence[int]) -> xr.Dataset:
    """Return values of responses, with bands; NaN for means."""
    if not periods:
        return xr.Dataset()
    values = np.full((6, len(labels), len(periods)), math.nan)
    for one in returned(of.demands, periods):
        at = [*of.demands.limits].index(one.limit), periods.index(int(one.years))
        values[:, *at] = [*one.by_years, *one.by_storms]
    names = [f"response_by_{way}{end}" for way in ("years", "storms") for end in ("", "_low", "_high")]
    both = ("limit", "return_period")
    return xr.Dataset(
        {name: (both, values[k]) for k, name in enumerate(names)},
        {"limit": labels, "return_period": [*map(float, periods)]},
    )


def _of_mode(one: OfMode, windows: Sequence[float], model: SeasModel) -> xr.Dataset:
    """Workable hours of one mode, with bands, by month and year, with windows and waits."""
    hours = one.hours
    band = hours.mean_year(model.persistence)
    ahead_of = hours.next_years(model.next_years, model.persistence)
    counted = whole(hours.years)
    dataset = xr.Dataset(
        {
            "workable": hours.share,
            "workable_at_worst": one.low,
            "workable_at_best": one.high,
            "mean_year": band.share,
            "mean_year_low": band.low,
            "mean_year_high": band.high,
            "next_years_low": ahead_of.low,
            "next_years_high": ahead_of.high,
            "workable_by_month": ("month", hours.of_months()),
            "workable_by_year": (
                "year",
                [year.share if year in counted else math.nan for year in hours.years],
            ),
        },
        {"month": list(MONTHS), "year": [year.year for year in hours.years]},
    )
    return dataset.assign(_windows(one, windows)).assign_coords(window=[*windows]) if windows else dataset


def _windows(one: OfMode, windows: Sequence[float]) -> dict[str, tuple[str, list[float]]]:
    """Windows of work, and waits for them from all starts."""
    of = [one.hours.of_windows(hours) for hours in windows]
    waits = [one.hours.of_waits(hours)[0][1] for hours in windows]
    return {
        "windows": ("window", [w.number for w in of]),
        "inside_windows": ("window", [w.inside for w in of]),
        "starts_of_windows": ("window", [w.starts for w in of]),
        "wait_mean": ("window", [w.mean for w in waits]),
        "wait_p50": ("window", [w.p50 for w in waits]),
        "wait_p90": ("window", [w.p90 for w in waits]),
    }


def _sea_states(found: Sequence[Downtime], study: SeasStudy) -> dict[str, Any]:
    """Responses to all simulated sea states, one setting after the other."""
    grid = study.settings
    many = [one.responses.sizes["sea_state"] for one in found]
    names = ("significant_wave_height", "peak_period", "heading")
    joined: dict[str, Any] = {
        f"{name}_of_sea_state": (
            "sea_state",
            np.concatenate([one.responses[name].values for one in found]),
            found[0].responses[name].attrs,
        )
        for name in names
    }
    for name in OF_STATES:
        every = xr.concat([one.responses[name].drop_vars(names) for one in found], "sea_state", join="outer")
        joined[name] = every  # aligned by labels of the limits
    for number, axis in enumerate(grid.axes):
        values = [grid.axes[axis][point.index[number]][0] for point in grid.plan]
        joined[f"{axis}_of_sea_state"] = (
            "sea_state", np.repeat(np.array(values), many), {"long_name": f"{axis} of the setting"}
        )  # fmt: skip
    return joined


def _about(study: SeasStudy, found: Sequence[Downtime], record: xr.Dataset) -> dict[str, Any]:
    base = study.settings.base
    model = study.model
    return {
        "Conventions": "CF-1.11",
        "title": titled(model.caption, study.paper, study.name),
        "paper": study.paper,
        "tier": study.tier,
        "digest": study.digest,
        "engine": engine_digest(),
        "riserstudy": version("riserstudy"),
        "scene": json.dumps(base.tree),
        "scene_file": base.source,
        "record": str(record.attrs["title"]),
        "interval_hours": float(record.attrs["interval_hours"]),
        "seeds": model.seeds,
        "next_years": model.next_years,
        "persistence": model.persistence,
        "modes": json.dumps({mode: [*needs] for mode, needs in MODES.items()}),
        "said": "\n".join(_in_words(study, found)),
        "history": history(f"hours of {study.name} of {study.paper}, tier {study.tier}"),
    }


def _in_words(study: SeasStudy, found: Sequence[Downtime]) -> Iterator[str]:
    """A summary of the simulations in words, one line per setting."""
    for point, one in zip(study.settings.plan, found, strict=True):
        axes = study.settings.axes.items()
        place = ", ".join(f"{n}={v[k][0]}" for (n, v), k in zip(axes, point.index, strict=True))
        yield from (f"{place}: {line}" if place else line for line in one.lines)
