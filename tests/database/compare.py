"""Values of the database beside those of its datasets, read by xarray and by nothing of ours."""

import math
import struct

import numpy as np
import xarray as xr

RUN = ("time", "s", "s_node", "cylinder", "statistic")
ROUNDED = 1e-9  # share to which datasets keep histories
LAID = 1e-6  # share that a value changes by, within the digits that common nodes have


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
        nodes = max(dataset.sizes.get("s", 0), dataset.sizes.get("s_node", 0))
        laid = nodes > dataset["elements"].min() + 1
        point = dataset.isel(at)
        seen = set()
        for quantity, statistic, unit, *found in db.execute(RESULTS, (row["point"],)):
            seen.add((quantity, statistic))
            where = f"{study} {cell}: {quantity} {statistic}"
            exact = [bits(value if value is None else float(value)) for value in found]
            if exact != told(point, f"{quantity} {statistic}", found[0]):
                yield f"{where} is {found}"
            variable = of_a_statistic(point, quantity, statistic)
            if variable is None:  # an envelope that is not kept
                continue
            if (unit or None) != dataset[variable].attrs.get("units"):
                yield f"{where}: unit"
            if not stands_in(point[variable], statistic, *found, laid):
                yield f"{where} {found} does not stand there"
        if missing := expected(point) - seen:
            yield f"{study} {cell}: nothing of {sorted(missing)}"


RESULTS = "select quantity, statistic, unit, value, s, time, cylinder from results where point = ?"


def told(point, label, value):
    """A statistic that a dataset tells of a point, with its places; the value itself of a single number."""
    if label not in point.get("statistic", []):
        return [bits(value), None, None, None]
    kinds = [f"{kind}_of_statistic" for kind in ("value", "s", "time", "cylinder")]
    here = point.sel(statistic=label)
    return [bits(here[kind].item()) if kind in here else None for kind in kinds]


def of_a_statistic(point, quantity, statistic):
    """The variable that a statistic is taken of: the one that its name says, or a history."""
    names = (f"{quantity}_{statistic}", f"{quantity}_{statistic.rpartition('_')[0]}", quantity)
    return next((name for name in names if name in point.data_vars), None)


def expected(point):
    """Quantities and statistics that a point must have, by the variables that it has numbers of."""
    there = set()
    for label, array in point.data_vars.items():
        name = str(label)
        if array.ndim == 0 or {*array.dims} - {*RUN} or "statistic" in array.dims:
            continue
        if array.dtype.kind not in "fiu" or np.isnan(array).all():
            continue
        quantity, _, ending = name.rpartition("_")
        if ending in ("max", "min", "absmax"):
            there.add((quantity, ending))
        elif ending == "static" and (quantity not in point or "time" in point[quantity].dims):
            there |= {(quantity, "static_max"), (quantity, "static_min")}
        elif ending != "static":
            there |= {(name, "max"), (name, "min")}
            if array.dims == ("time",):
                there |= {(name, "amplitude"), (name, "last")}
    return there


def stands_in(array, statistic, value, s, time, cylinder, laid):
    """Whether a value is that statistic of an array, and stands where it is said to stand.

    Histories are rounded, and do not see every step; on common nodes a curve may go beyond its own.
    """
    values = array.values
    share = LAID if laid else ROUNDED if "time" in array.dims else 0.0
    near = share * np.nanmax(np.abs(values))
    if statistic == "amplitude":
        return abs(value - np.ptp(values[~np.isnan(values)]) / 2.0) <= near
    if statistic == "last":
        return abs(value - values[~np.isnan(values)][-1]) <= near
    if values.ndim == 0:
        return bits(value) == bits(float(values))
    sign = -1.0 if statistic.endswith("min") else 1.0
    largest = np.nanmax(sign * values)
    if {"time", "s"} <= {*array.dims}:
        return laid or sign * value >= largest - near
    if not (laid or abs(sign * value - largest) <= near):
        return False
    place = {"s": s, "s_node": s, "time": time, "cylinder": cylinder}
    where = {dim: place[dim] for dim in array.dims if dim in array.coords}
    try:
        return abs(float(array.sel(where, method="nearest", tolerance=1e-6)) - value) <= near
    except KeyError:  # no such place, as where common nodes are others
        return bool(laid)


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
    labels = dataset["statistic"].values.tolist() if "statistic" in dataset.coords else []
    told = {label.replace(" ", "_"): label for label in labels}
    for number, (name, role, unit) in enumerate(about):
        if name in told:
            values = dataset["value_of_statistic"].sel(statistic=told[name])
            for row, at in zip(rows, cells, strict=True):
                if bits(row[number]) != bits(values.isel(at).item()):
                    yield f"{table} {at}: {name} is {row[number]!r}"
            continue
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
