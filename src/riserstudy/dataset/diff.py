"""Differences between two sets of results: published values, verdicts, and every variable of datasets.

The change of a variable is its largest absolute difference divided by its largest magnitude in either
dataset, because a relative change near a zero crossing has no meaning. Statistics of different quantities in
one variable are compared one by one. If grids differ, their common points are compared, and their number is
reported. Elapsed times are not compared, and neither are keys of stored points, which change with every edit
of the engine, and records of warnings, whose sentences are compared.
"""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from riserstudy.dataset.open import open_dataset
from riserstudy.errors import InputError

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

TABLE = "reproduction.csv"
COLUMNS = ("published", "simulated", "unit", "error", "verdict", "depends_on")
MIXED = "statistic"  # a dimension along which quantities and units differ
_LEFT_OUT = re.compile(r"seconds$|^wall_|^time_(change|share)$|^(point_key|warning_records)$")


class Graded(NamedTuple):
    """One field of a graded number or claim that changed."""

    item: str
    column: str
    old: str
    new: str


class Varied(NamedTuple):
    """A variable of a dataset: its relative change, or the reason ``why`` it is not known."""

    dataset: str
    variable: str
    change: float
    why: str = ""


class Changes(NamedTuple):
    """All differences, and the numbers of compared rows and variables."""

    graded: list[Graded]
    varied: list[Varied]
    rows: int
    variables: int

    @property
    def largest(self) -> float:
        """Largest relative change of the variables that can be compared."""
        return max((one.change for one in self.varied if not one.why), default=0.0)

    @property
    def apart(self) -> int:
        """Number of variables that cannot be compared."""
        return sum(bool(one.why) for one in self.varied)


def changes(old: Path, new: Path) -> Changes:
    """Differences of two folders of results (of all chapters or of one), two tables or two datasets.

    Raises InputError when there is nothing to compare, or a file cannot be read.
    """
    tables = [_rows(path) for path in (old, new)]
    files = [_datasets(path) for path in (old, new)]
    for path, rows, paths in zip((old, new), tables, files, strict=True):
        if not rows and not paths:
            allowed = f"give a results folder, a dataset or a {TABLE}"
            raise InputError("diff", str(path), "contains no results", allowed)
    graded = list(_graded(*tables))
    varied, count = [], 0
    for name in sorted({*files[0], *files[1]}):
        for one in _varied(name, files[0].get(name), files[1].get(name)):
            count += 1
            varied += [one] if one.change or one.why else []
    return Changes(graded, varied, len({*tables[0], *tables[1]}), count)


def _rows(path: Path) -> dict[str, dict[str, str]]:
    """Graded rows by paper and ID."""
    table = path / TABLE if path.is_dir() else path
    if table.suffix != ".csv" or not table.is_file():
        return {}
    try:
        with table.open(newline="", encoding="utf-8") as stream:
            return {f"{row['paper']}/{row['id']}": row for row in csv.DictReader(stream)}
    except (OSError, UnicodeDecodeError, csv.Error, KeyError):
        raise InputError(
            table, "", "this is not a table of graded numbers", "repeat the command that writes it"
        ) from None


def _datasets(path: Path) -> dict[str, Path]:
    """Datasets by name."""
    if path.is_dir():
        files = [*path.glob("*.nc"), *path.glob("*/*.nc")]
        return {file.relative_to(path).with_suffix("").as_posix(): file for file in files}
    return {"dataset": path} if path.suffix == ".nc" and path.is_file() else {}


def _graded(old: dict[str, dict[str, str]], new: dict[str, dict[str, str]]) -> Iterator[Graded]:
    for item in sorted({*old, *new}):
        if item not in old or item not in new:
            yield Graded(item, "row", *("there" if item in t else "absent" for t in (old, new)))
            continue
        for column in COLUMNS:
            before, after = (str(table[item].get(column) or "") for table in (old, new))
            if before != after:
                yield Graded(item, column, before, after)


def _varied(name: str, old: Path | None, new: Path | None) -> Iterator[Varied]:
    """Every variable of a dataset with its change, 0 if it is identical bit for bit."""
    if old is None or new is None:
        yield Varied(name, "", float("inf"), "only in " + ("NEW" if old is None else "OLD"))
        return
    before, after = open_dataset(old), open_dataset(new)
    for axis in sorted({*map(str, before.indexes)} & {*map(str, after.indexes)}):
        places = [before[axis].values.tolist(), after[axis].values.tolist()]
        if _same(before[axis].values, after[axis].values):
            continue
        if set(places[0]) != set(places[1]):
            before, after, common = _at_common_points(axis, before, after)
            yield Varied(
                name, axis, float("inf"), f"{len(places[0])} values, now {len(places[1])}; {common} in both"
            )
        elif places[0] != places[1] and len(set(places[0])) == len(places[0]) == len(places[1]):
            before, after, _ = _at_common_points(axis, before, after)
            yield Varied(name, axis, 0.0, "other order")
    for variable in sorted({*map(str, before.variables), *map(str, after.variables)}):
        if _LEFT_OUT.search(variable):
            continue
        if variable not in before.variables or variable not in after.variables:
            where = "NEW" if variable not in before.variables else "OLD"
            yield Varied(name, variable, float("inf"), f"only in {where}")
        else:
            yield _one(name, variable, before[variable], after[variable])
    if any("limits" in one.attrs for one in (before, after)):
        same = _limits(before) == _limits(after)
        yield Varied(name, "limits", 0.0, "" if same else "other allowables or verdicts")


def _limits(dataset: xr.Dataset) -> str:
    """Limits in the attribute of a dataset, with their allowables and, in a run, their verdicts.

    An attribute that holds no limits, in a file of others, is its own text.
    """
    names, held = ("mode", "side", "output", "at", "allowable", "verdict"), dataset.attrs.get("limits", "[]")
    try:
        return json.dumps([[row.get(name) for name in names] for row in json.loads(held)])
    except (TypeError, ValueError, AttributeError, RecursionError):
        return str(held)


def _at_common_points(axis: str, old: xr.Dataset, new: xr.Dataset) -> tuple[xr.Dataset, xr.Dataset, int]:
    """Both datasets at the common values of an axis, and the number of these values."""
    import numpy as np

    common, here, there = np.intersect1d(old[axis], new[axis], return_indices=True)
    if not len(common):  # nothing to compare: reported as a different shape
        return old, new, 0
    return old.isel({axis: np.sort(here)}), new.isel({axis: there[np.argsort(here)]}), len(common)


def _same(old: NDArray[Any], new: NDArray[Any]) -> bool:
    """Whether two axes are equal; a missing value is equal to a missing value at the same place."""
    import numpy as np

    return np.array_equal(old, new, equal_nan=old.dtype.kind == new.dtype.kind == "f")


def _one(name: str, variable: str, old: xr.DataArray, new: xr.DataArray) -> Varied:
    import numpy as np

    a, b = old.values, new.values
    if a.shape != b.shape or old.dims != new.dims:
        return Varied(name, variable, float("inf"), f"shape {a.shape}, now {b.shape}")
    units = [str(values.attrs.get("units", "")) for values in (old, new)]
    if units[0] != units[1]:
        before, now = (unit or "none" for unit in units)
        return Varied(name, variable, float("inf"), f"unit {before}, now {now}")
    if a.dtype.kind not in "fiu" or b.dtype.kind not in "fiu":
        other = "other values" if a.dtype.kind == b.dtype.kind == "b" else "other text"
        return Varied(name, variable, 0.0, "" if np.array_equal(a, b) else other)
    if not np.array_equal(np.isfinite(a), np.isfinite(b)):
        return Varied(name, variable, float("inf"), "defined elsewhere")
    of_parts: list[Any] = [...]
    if MIXED in old.dims:
        ahead = (slice(None),) * old.dims.index(MIXED)
        of_parts = [(*ahead, k) for k in range(old.sizes[MIXED])]
    change = max((relative_change(a[part], b[part]) for part in of_parts), default=0.0)
    why = "infinite or undefined, unlike before" if np.isinf(change) else ""
    return Varied(name, variable, change, why)


def relative_change(old: NDArray[Any], new: NDArray[Any]) -> float:
    """Largest difference of two arrays of the same shape, relative to their largest magnitude.

    It is infinite if a value is infinite or missing in only one of the two.
    """
    import numpy as np

    a, b = old.astype(float), new.astype(float)
    there = np.isfinite(a) & np.isfinite(b)
    if not np.array_equal(a[~there], b[~there], equal_nan=True):
        return float("inf")
    a, b = a[there], b[there]
    scale = max(np.abs(a).max(initial=0.0), np.abs(b).max(initial=0.0))
    return float(np.abs(a - b).max() / scale) if scale else 0.0
