"""Statistics of a run in an irregular sea, and of runs with several seeds, as tables."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from functools import cache, partial
from typing import TYPE_CHECKING

import numpy as np

from riserstudy.dataset.provenance import first_scene
from riserstudy.dataset.statistics import FEWEST_SEEDS, NOT_EXCEEDED, extremes, gumbel, record_statistics
from riserstudy.dataset.table import OF_ROW, Cell, Table
from riserstudy.errors import InputError
from riserstudy.scene.limits import SIGNED

if TYPE_CHECKING:
    import xarray as xr


LOWER_ANGLE = "lfj_angle"
# range of a history that counts as constant, relative to the largest value of its output, also elsewhere
NEGLIGIBLE = 1e-4
EVEN = 1e-6  # largest relative deviation of intervals that count as equal
OF_A_RECORD = {
    "mean": OF_ROW, "standard deviation": OF_ROW, "mean upcrossing period": "s", "largest": OF_ROW,
    "most probable largest": OF_ROW, "smallest": OF_ROW, "most probable smallest": OF_ROW,
}  # fmt: skip
WITHIN = f"{100 * NOT_EXCEEDED:g} % of seas"
OF_SEEDS = {"seeds": ""} | dict.fromkeys(
    (
        "mean", "standard deviation", "largest", "most probable largest", "its standard error",
        "Gumbel scale of largest", f"not exceeded in {WITHIN}", "smallest", "most probable smallest",
        "its standard error ", "Gumbel scale of smallest", f"not undercut in {WITHIN}",
    ),
    OF_ROW,
)  # fmt: skip


def of_a_run(run: xr.Dataset, start: float, exposure: float | None) -> Table:
    """Statistics of every history of a run, one row per history and place along the riser.

    Raises InputError when no output varies with time after the start, or output intervals are not equal.

    Parameters
    ----------
    start : time (s) up to which the sea builds up, and which is excluded.
    exposure : exposure time (s) of the most probable extremes; None: the duration of the record.
    """
    rows: list[list[Cell]] = []
    sizes = _sizes(run)
    for name, s, unit, history in _histories(run, start):
        time = history["time"].values
        record = record_statistics(time, history.values, exposure or float(time[-1] - time[0]))
        size = name in sizes
        smallest, probable = _least(record.smallest, size), _least(record.most_probable_smallest, size)
        rows.append([name, s, unit, *record._replace(smallest=smallest, most_probable_smallest=probable)])
    return Table(["output", "s", "unit", *OF_A_RECORD], ["", "m", "", *OF_A_RECORD.values()], rows)


def over_seeds(grid: xr.Dataset, axis: str, start: float) -> Table:
    """Statistics over an axis of seeds, with the Gumbel distribution of largest and smallest values.

    Times before ``start`` (s) are excluded. Raises InputError when there is no such axis, or it has too few
    seeds.
    """
    axes = [str(dim) for dim in grid["point_key"].dims] if "point_key" in grid else []
    if axis not in axes:
        allowed = f"use one of {', '.join(axes)}" if axes else "give a dataset of a study, which has axes"
        raise InputError("--over", axis, "the dataset has no axis of this name", allowed)
    sets = json.loads(grid[axis].attrs.get("sets", "{}"))
    others = sorted({path for one in sets.values() for path in one if not path.endswith("seed")})
    if others:
        allowed = "give an axis that sets seeds only, and select a value of this axis with --at"
        raise InputError("--over", axis, f"this axis sets {others[0]}, not only seeds", allowed)
    if (count := grid.sizes[axis]) < FEWEST_SEEDS:
        found = f"the axis has only {count} seeds"
        raise InputError("--over", axis, found, f"give a study with {FEWEST_SEEDS} seeds or more")
    rows: list[list[Cell]] = []
    sizes = _sizes(grid)
    for name, s, unit, history in _histories(grid, start):
        values, size = history.transpose(axis, "time").values, name in sizes
        smallest, largest = extremes(values)
        smallest = np.array([_least(one, size) for one in smallest])
        high, low = gumbel(largest), gumbel(-smallest)
        rows.append(
            [
                name, s, unit, count,
                float(values.mean()), math.sqrt(float(values.var(axis=1).mean())),
                float(largest.max()), high.mode, high.mode_error, high.scale, high.fractile,
                float(smallest.min()), _least(-low.mode, size), low.mode_error, low.scale,
                _least(-low.fractile, size),
            ]
        )  # fmt: skip
    return Table(["output", "s", "unit", *OF_SEEDS], ["", "m", "", *OF_SEEDS.values()], rows)


def most_missed(run: xr.Dataset) -> tuple[str, float]:
    """The history whose extremes differ most from those over all time steps, and the share (1) of its range.

    The share is 0 where a dataset has no extremes over all steps, as in studies. The name includes the place.
    Raises InputError as `of_a_run` does.
    """
    found, largest = [("", 0.0)], cache(partial(_largest, run))
    for name, s, _, history in _histories(run, -math.inf):
        ends = _over_all_steps(run, name, s)
        anywhere = largest(name) if s is not None else 0.0
        if ends is None or not ends[1] - ends[0] > NEGLIGIBLE * max(anywhere, *map(abs, ends)):
            continue
        (least,), (most,) = extremes(history.values[None])
        share = max(abs(ends[1] - most), abs(least - ends[0])) / (ends[1] - ends[0])
        found.append((name if s is None else f"{name} at s = {s:.4g} m", share))
    return max(found, key=lambda one: one[1])


def _over_all_steps(run: xr.Dataset, name: str, s: float | None) -> tuple[float, float] | None:
    """Smallest and largest value of an output over all time steps, at a place (m); None if not known."""
    if s is not None:
        if f"{name}_max" not in run or "s_node" not in run[f"{name}_max"].dims:
            return None
        at = np.flatnonzero(run["s_node"].values == s)
        ends = [run[f"{name}_{end}"].values[at] for end in ("min", "max")]
        return (float(ends[0][0]), float(ends[1][0])) if len(at) else None
    rows = json.loads(run.attrs.get("extremes", "[]"))
    row = next((row for row in rows if (row["output"], row["where"]) == (name, "")), None)
    return (row["smallest"], row["largest"]) if row else None


def _largest(run: xr.Dataset, name: str) -> float:
    """Largest magnitude of an output over time and along the riser, in its unit.

    At some places an output is only rounding, such as the tension of a joint that slides without force.
    """
    return float(np.fabs(run[name].values).max(initial=0.0, where=np.isfinite(run[name].values)))


def _sizes(run: xr.Dataset) -> tuple[str, ...]:
    """Outputs that are magnitudes: in space, those whose sign in a plane is a convention."""
    in_space = first_scene(run).spatial
    return tuple(name for name in SIGNED if name not in "xy") if in_space else ()


def _least(value: float, size: bool) -> float:
    """A most probable smallest value; for a magnitude at least zero. NaN is kept."""
    return float(np.maximum(value, 0.0)) if size else value


def _histories(run: xr.Dataset, start: float) -> Iterator[tuple[str, float | None, str, xr.DataArray]]:
    """Name, arclength (m), unit and history from a time (s) on, of all outputs that vary with time.

    The angle of a lower flex joint ends with its release by a disconnect, and is absent if fewer than two of
    its outputs are left.
    """
    if "time" not in run:
        found = "the run is static and has no time histories, which statistics require"
        raise InputError("dataset", "time", found, "add analysis.duration and output to its scene")
    time = run["time"].values
    steps = np.diff(time[time >= start])
    if not len(steps):
        allowed = f"give at most {time[-2]:g} s" if len(time) > 1 else "give a run with more outputs"
        raise InputError("--start", f"{start:g} s", "fewer than two outputs follow this time", allowed)
    if np.ptp(steps) > EVEN * steps[0]:
        found = "the intervals between outputs differ"
        raise InputError("dataset", "time", found, "give a run with equal intervals")
    later = run.isel(time=time >= start)
    for name, history in later.data_vars.items():
        if "time" not in history.dims or history.dtype.kind != "f":
            continue
        if name == LOWER_ANGLE:
            history = history.isel(time=history["time"].values <= first_scene(run).lower_joint_until)
            if history.sizes["time"] < 2:
                continue
        unit = str(history.attrs.get("units", ""))
        across = next((dim for dim in ("s", "cylinder") if dim in history.dims), None)
        for k in range(history.sizes[across] if across else 1):
            place = float(history[across][k]) if across == "s" else None
            called = f"{name} {k}" if across == "cylinder" else str(name)
            yield called, place, unit, history.isel({across: k}) if across else history
