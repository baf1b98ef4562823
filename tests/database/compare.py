"""Values of the database beside those of its datasets, read by xarray and by nothing of ours."""

import math
import struct

import numpy as np
import xarray as xr

RUN = ("time", "s", "s_node", "cylinder")


def bits(value):
    """A value so that only what is the same to the last bit is equal; what is no number is None.

    SQLite has no minus zero: it is stored as zero.
    """
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return None
    return struct.pack("<d", value + 0.0) if isinstance(value, float) else value


def datasets(db, folder):
    """Each study of the database with its dataset."""
    for study, path in db.execute("select study, path from studies").fetchall():
        with xr.open_dataset(folder / path, decode_times=False) as dataset:
            yield study, dataset.load()


def wrong_points(db, study, dataset):
    """Where results and facts of the points of a study are not those of its dataset, a line each."""
    keys = dataset["point_key"]
    cells = [*np.ndindex(keys.shape)]
    asked = "select * from points where study = ? order by position"
    cursor = db.execute(asked, (study,))
    names = [column[0] for column in cursor.description]
    points = [dict(zip(names, row, strict=True)) for row in cursor.fetchall()]
    if len(points) != len(cells):
        yield f"{study}: {len(points)} points for {len(cells)} cells"
        return
    for row, cell in zip(points, cells, strict=True):
        at = dict(zip(keys.dims, cell, strict=True))
        if row["key"] != keys.values[cell]:
            yield f"{study} {cell}: key"
        for fact in set(row) & set(map(str, dataset.data_vars)) - {"effects"}:
            if bits(row[fact]) != bits(dataset[fact].isel(at).item()):
                yield f"{study} {cell}: {fact}"
        values = db.execute(RESULTS, (row["point"],)).fetchall()
        seen = set()
        for quantity, statistic, unit, *found in values:
            variable = of_a_statistic(dataset, quantity, statistic)
            seen.add(variable)
            array = dataset[variable]
            array = array.isel({axis: k for axis, k in at.items() if axis in array.dims})
            if (unit or None) != array.attrs.get("units"):
                yield f"{study} {cell}: unit of {variable}"
            if not stands_in(array, statistic, *found):
                yield f"{study} {cell}: {variable} {statistic} {found}"
        if missing := expected(dataset, at) - seen:
            yield f"{study} {cell}: nothing of {sorted(missing)}"


RESULTS = "select quantity, statistic, unit, value, s, time, cylinder from results where point = ?"


def of_a_statistic(dataset, quantity, statistic):
    """The variable that a statistic is taken of: the one that its name says, or a history."""
    names = (f"{quantity}_{statistic}", f"{quantity}_{statistic.rpartition('_')[0]}", quantity)
    return next(name for name in names if name in dataset.data_vars)


def expected(dataset, at):
    """Variables that a point must have results of: numbers over a run, if there are any."""
    found = set()
    for label, array in dataset.data_vars.items():
        name = str(label)
        large = {"time", "s"} <= {*array.dims} and f"{name}_max" in dataset
        again = name.removesuffix("_static") in set(map(str, dataset.data_vars)) - {name}
        static = again and "time" not in dataset[name.removesuffix("_static")].dims
        within = [dim for dim in array.dims if dim in RUN]
        if not within or large or static or array.dtype.kind not in "fiu":
            continue
        if not np.isnan(array.isel({k: v for k, v in at.items() if k in array.dims})).all():
            found.add(name)
    return found


def stands_in(array, statistic, value, s, time, cylinder):
    """Whether a value is that statistic of an array, and stands where it is said to stand."""
    values = array.values
    if statistic == "amplitude":
        return bits(value) == bits(float(np.ptp(values[~np.isnan(values)]) / 2.0))
    if statistic == "last":
        return bits(value) == bits(float(values[-1]))
    if values.ndim == 0:
        return bits(value) == bits(float(values))
    largest = not statistic.endswith("min")
    if value != (np.nanmax(values) if largest else np.nanmin(values)):
        return False
    place = {"s": s, "s_node": s, "time": time, "cylinder": cylinder}
    where = {dim: place[dim] for dim in array.dims if dim in array.coords}
    try:
        return bits(float(array.sel(where))) == bits(float(value))
    except KeyError:  # no such place
        return False


def wrong_tables(db, study, dataset):
    """Where wide tables of a study are not its dataset, and what is in none of them."""
    asked = "select distinct table_name from columns where study = ?"
    held = set()
    for (table,) in db.execute(asked, (study,)).fetchall():
        asked = "select column_name, role, unit from columns where table_name = ? order by position"
        about = db.execute(asked, (table,)).fetchall()
        held.update(name for name, *_ in about)
        yield from wrong_cells(db, table, about, dataset)
    plain = {str(n) for n, v in dataset.variables.items() if not {*v.dims} & {*RUN}}
    if missing := plain - held - {"effects", "point_key"}:
        yield f"{study}: no column {sorted(missing)}"


def wrong_cells(db, table, about, dataset):
    """Where a wide table is not its dataset."""
    quoted = ", ".join('"' + name.replace('"', '""') + '"' for name, *_ in about)
    rows = db.execute(f'select {quoted} from "{table}"').fetchall()
    axes = {name: dataset.sizes[name] for name, role, _ in about if role == "axis"}
    cells = [dict(zip(axes, cell, strict=True)) for cell in np.ndindex(*axes.values())]
    if len(rows) != len(cells):
        yield f"{table}: {len(rows)} rows for {len(cells)} cells"
        return
    for number, (name, role, unit) in enumerate(about):
        label = "point_key" if name == "key" else name
        if label not in dataset.variables or role == "assumed":
            continue
        array = dataset[label]
        if any(dim in RUN for dim in array.dims):
            continue
        if (unit or None) != array.attrs.get("units"):
            yield f"{table}: unit of {name}"
        for row, at in zip(rows, cells, strict=True):
            here = array.isel({dim: at[dim] for dim in array.dims}).values.item()
            if bits(row[number]) != bits(here):
                yield f"{table} {at}: {name} is {row[number]!r}, not {here!r}"


def wrong(db, folder):
    """Everything in a database that is not as in its datasets."""
    for study, dataset in datasets(db, folder):
        yield from wrong_tables(db, study, dataset)
        if "point_key" in dataset:
            yield from wrong_points(db, study, dataset)
