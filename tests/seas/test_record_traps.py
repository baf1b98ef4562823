"""What a record says of its numbers, times and limits, against the numbers that it was written from."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from riserstudy.errors import InputError
from riserstudy.seas.hours import hours, sea_limit
from riserstudy.seas.record import FILLS, gaps, read_record

HEIGHTS, FROM = "significant_wave_height", "wave_from_direction"
PER_METRE = {"m": 1, "cm": 100, "mm": 1000}
ROWS = 6
TIME = np.datetime64("2001-01-01T00", "ns") + np.timedelta64(3, "h") * np.arange(ROWS)
HEIGHT = np.array([1.0, 1.5, 2.2, 3.0, 2.4, 1.2])
PEAK = np.array([7.0, 8.0, 9.0, 11.0, 10.0, 8.5])


def written(tmp_path, columns, head="time", times=None):
    """A table of columns by heading, and its path."""
    count = len(next(iter(columns.values())))
    times = pd.date_range("2004-02-28", periods=count, freq="h") if times is None else times
    path = tmp_path / "sea.csv"
    pd.DataFrame({head: times} | columns).to_csv(path, index=False)
    return path


@pytest.mark.parametrize("seed", range(8))
def test_values_that_others_write_for_none_are_values_where_they_can_be(tmp_path, seed):
    """Bearings of 99.0 deg, and 99.0 and 999 cm beside such heights; 99.0 m, 99.0 s and 999 deg are none."""
    draw = np.random.default_rng(seed)
    bearing = draw.choice([3.0, 99.0, 100.0, 999.0], 60)
    steps = [98.0, 99.0, 150.0, 250.0, 450.0, 800.0, 998.0, 999.0]
    height = np.sort([*steps, *draw.choice(steps, 52)])
    period = draw.choice([8.0, 99.0], 60)
    columns = {
        "hs (cm)": np.where(height == 999.0, "999", height.astype(str)),
        "tp (s)": [f"{p:.2f}" for p in period],
        "mwd (deg)": np.where(bearing == 999.0, "999", bearing.astype(str)),
    }
    record = read_record(written(tmp_path, columns))
    np.testing.assert_allclose(record[HEIGHTS], height / 100.0, rtol=1e-12)
    np.testing.assert_array_equal(record["peak_period"], np.where(period == 99.0, np.nan, period))
    np.testing.assert_array_equal(record[FROM], np.where(bearing == 999.0, np.nan, bearing))
    assert "cells of hs with" in record.attrs["conversions"]
    in_metres = read_record(written(tmp_path, {"hs (m)": ["1.0", "99.00", "9.9"]}))
    np.testing.assert_array_equal(in_metres[HEIGHTS], [1.0, np.nan, 9.9])


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("unit", ["m", "cm", "mm", "float32"])
def test_a_limit_that_is_met_exactly_is_met_in_any_unit(tmp_path, seed, unit):
    """Heights of whole centimetres, against counting in centimetres."""
    draw = np.random.default_rng(seed)
    limit = int(draw.integers(30, 900))
    whole = draw.integers(limit - 3, limit + 4, 200)
    if unit == "float32":
        path = tmp_path / "sea.nc"
        time = pd.date_range("2004-02-28", periods=200, freq="h")
        values = (whole / 100.0).astype(np.float32)
        xr.Dataset({"hs": ("time", values, {"units": "m"})}, {"time": time}).to_netcdf(path)
    else:
        texts = [f"{w * PER_METRE[unit] / 100.0:.10g}" for w in whole]
        path = written(tmp_path, {f"hs ({unit})": texts})
    record = read_record(path)
    for text in (f"{limit / 100.0:.2f} m", f"{limit} cm"):
        most, least = (hours(record, [sea_limit(f"hs {sign} {text}")]) for sign in ("<=", ">="))
        assert most.share == pytest.approx((whole <= limit).mean())
        assert least.share == pytest.approx((whole >= limit).mean())


@pytest.mark.parametrize(
    "head", ["UTC+1", "UTC-05:00", "CET", "local", "h", "s", "days since 2000", "YYYY-MM-DD HH:mm CET", "EST"]
)
def test_times_that_are_not_in_utc_are_refused(tmp_path, head):
    with pytest.raises(InputError, match="neither UTC nor a pattern"):
        read_record(written(tmp_path, {"hs (m)": [1, 2, 3]}, f"time ({head})"))


@pytest.mark.parametrize("head", ["time", "time (UTC)", "time [GMT]", "time (ISO 8601)"])
@pytest.mark.parametrize("hours_east", [0, 1, -5])
def test_offsets_of_times_are_taken_out(tmp_path, head, hours_east):
    zone = f"{hours_east:+03d}:00"
    utc = pd.date_range("2004-02-28 12:00", periods=48, freq="h")
    times = [f"{t:%Y-%m-%dT%H:%M}{zone}" for t in utc + pd.Timedelta(hours_east, "h")]
    record = read_record(written(tmp_path, {"hs (m)": np.ones(48)}, head, times))
    np.testing.assert_array_equal(record["time"].values, utc.values)


@pytest.mark.parametrize("times", [["1000", "1001", "1002"], ["2001-01", "2001-02", "2001-03"]])
def test_times_without_a_day_are_refused(tmp_path, times):
    with pytest.raises(InputError, match="row 2: time"):
        read_record(written(tmp_path, {"hs (m)": [1, 2, 3]}, times=times))


@pytest.mark.parametrize(
    "text, said",
    [
        ("time,hs (m),hs (m)\n2001-01-01 00:00,1,2\n2001-01-01 01:00,1,2\n", "two columns"),
        ("time,hs (m)\n2001-01-01 00:00,1,8\n2001-01-01 01:00,1,8\n", "row 2: the row has 3 cells"),
        ("time,hs (m)\n2001-01-01 00:00,1\n2001-01-01 01:00,1,8\n", "line 3, saw 3"),
    ],
)
def test_columns_are_neither_lost_nor_moved(tmp_path, text, said):
    (tmp_path / "sea.csv").write_text(text)
    with pytest.raises(InputError, match=said):
        read_record(tmp_path / "sea.csv")


@pytest.mark.parametrize("text", ["", "\n", "\r\n\r\n", "  \n"])
def test_a_record_without_text_is_refused(tmp_path, text):
    (tmp_path / "sea.csv").write_text(text)
    with pytest.raises(InputError, match="give a header"):
        read_record(tmp_path / "sea.csv")


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_lines_may_end_as_on_any_system(tmp_path, end, separator):
    lines = ["time,hs (m),tp (s)", *(f"2001-01-01 {k:02}:00,{k + 1},{k + 5}" for k in range(9))]
    text = end.join(line.replace(",", separator) for line in lines) + end
    (tmp_path / "sea.csv").write_bytes(text.encode())
    assert read_record(tmp_path / "sea.csv")[HEIGHTS].values.tolist() == [*range(1, 10)]


@pytest.mark.parametrize("seed", range(8))
def test_rows_closer_than_others_are_refused_and_make_no_longer_windows(tmp_path, seed):
    """A record of three hours that becomes hourly: an hour is no three of them."""
    draw = np.random.default_rng(seed)
    coarse = int(draw.integers(200, 900))
    many = int(draw.integers(0.05 * coarse, 0.9 * coarse))
    steps = np.concatenate([np.full(coarse, 3), np.ones(many)]).astype("timedelta64[h]")
    time = np.datetime64("2001-01-01T00", "ns") + np.cumsum(steps)
    height = np.full(len(time), 5.0)
    with pytest.raises(InputError, match=f"row {coarse + 2}: time: this row is 1 h after"):
        read_record(written(tmp_path, {"hs (m)": height}, times=time))
    sea = xr.Dataset({HEIGHTS: ("time", height)}, {"time": time}, {"interval_hours": 3.0})
    with pytest.raises(InputError, match="rows with values are 1 h apart"):
        hours(sea, [sea_limit("hs <= 2 m")])


@pytest.mark.parametrize("seed", range(4))
def test_a_clock_that_is_set_ends_no_window(tmp_path, seed):
    draw = np.random.default_rng(seed)
    first = pd.date_range("2001-01-01 00:50", periods=int(draw.integers(80, 200)), freq="h")
    after = pd.date_range(first[-1] + pd.Timedelta("50min"), periods=150, freq="h")
    record = read_record(written(tmp_path, {"hs (m)": np.ones(len(first) + 150)}, times=first.append(after)))
    found = hours(record, [sea_limit("hs <= 2 m")])
    assert (found.of_windows(200.0).number, found.share) == (1, 1.0)


@pytest.mark.parametrize("seed", range(4))
def test_parts_of_a_speed_have_units_of_their_own(tmp_path, seed):
    draw = np.random.default_rng(seed)
    east, north = draw.normal(0.0, 8.0, (2, 50))
    parts = {"u10": (east, "m s-1"), "v10": (north * 100.0, "cm s-1")}
    data = xr.Dataset(
        {n: ("time", v, {"units": unit}) for n, (v, unit) in parts.items()}
        | {"hs": ("time", np.ones(50), {"units": "m"}), "hm0": ("time", np.zeros(50), {"units": "m"})},
        {"time": pd.date_range("2001", periods=50, freq="h")},
    )  # fmt: skip
    data.to_netcdf(tmp_path / "sea.nc")
    record = read_record(tmp_path / "sea.nc")
    np.testing.assert_allclose(record["wind_speed"], np.hypot(east, north))
    assert f"left out: a second variable of {HEIGHTS}" in record.attrs["conversions"]


@pytest.mark.parametrize("name, noted", [("hs", False), ("wave_height", True)])
def test_a_height_that_does_not_state_its_kind_is_noted(tmp_path, name, noted):
    of_table = read_record(written(tmp_path, {f"{name} (m)": [1, 2, 3]}))
    time = pd.date_range("2004", periods=3, freq="h")
    made = xr.Dataset({name: ("time", [1.0, 2.0, 3.0], {"units": "m"})}, {"time": time})
    made.to_netcdf(tmp_path / "sea.nc")
    for record in (of_table, read_record(tmp_path / "sea.nc")):
        said = "taken as the significant height" in record.attrs["conversions"]
        assert said == noted
        np.testing.assert_array_equal(record[HEIGHTS], [1.0, 2.0, 3.0])


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("fill", [99, 999, 9999])
@pytest.mark.parametrize("unit", ["cm", "mm", "ft", "netCDF"])
def test_a_fill_far_from_the_values_beside_it_is_neither_a_value_nor_none(tmp_path, unit, fill, seed):
    """Heights that wander, far below or above what is written for none: refused where it can be a height."""
    draw = np.random.default_rng(seed)
    factor = {"cm": 0.01, "mm": 0.001, "ft": 0.3048, "netCDF": 0.01}[unit]
    ways = [far for far in (0.2 * fill, 3.0 * fill) if far * factor < 25.0] or [10.0 / factor]
    far = float(draw.choice(ways))
    values = np.round(far * np.exp(0.05 * draw.normal(size=50)), 2)
    count = int(draw.integers(1, 6))
    first = int(draw.integers(0, 50 - count))
    values[first : first + count] = fill
    if unit == "netCDF":
        time = pd.date_range("2004", periods=50, freq="h")
        path = tmp_path / "sea.nc"
        xr.Dataset({"hs": ("time", values, {"units": "cm"})}, {"time": time}).to_netcdf(path)
    else:
        text = draw.choice([f"{fill}", f"{fill}.0", f"{fill}.00"])
        path = written(tmp_path, {f"hs ({unit})": [text if v == fill else str(v) for v in values]})
    if fill * factor > 35.0 and unit != "netCDF" and text in FILLS:
        values = read_record(path)[HEIGHTS].values
        assert np.flatnonzero(np.isnan(values)).tolist() == [*range(first, first + count)]
    elif fill * factor <= 35.0:
        with pytest.raises(InputError, match=f"row {first + 2}: hs: {fill} .* missing value"):
            read_record(path)
    else:
        with pytest.raises(InputError, match="give 0 to 35 m"):
            read_record(path)


@pytest.mark.parametrize("seed", range(6))
def test_rows_some_minutes_early_or_late_are_next_to_each_other(tmp_path, seed):
    """Rows of a buoy some minutes beside the hour have its gaps, windows and waits, and no others."""
    draw = np.random.default_rng(seed)
    interval = int(draw.choice([1, 3, 6]))
    times = pd.date_range("2003-11-30", periods=1500, freq=f"{interval}h")
    kept = np.ones(1500, bool)
    for first in draw.integers(5, 1480, 6):
        kept[first : first + int(draw.integers(1, 9))] = False
    phase = np.arange(1500) * interval / draw.uniform(20.0, 60.0)
    height = (2.0 + np.sin(phase) + draw.normal(0.0, 0.1, 1500))[kept]
    late = pd.to_timedelta(np.where(draw.random(1500) < 0.1, draw.integers(0, 7, 1500), 0), "min")
    found = []
    for clock in (times, times + late):
        record = read_record(written(tmp_path, {"hs (m)": height}, times=clock[kept]))
        of = hours(record, [sea_limit("hs <= 2.2 m")])
        assert of.interval == interval
        found.append([len(gaps(record)), of.of_windows(4.0 * interval), of.of_waits(4.0 * interval)])
    np.testing.assert_equal(found[1], found[0])
    assert found[0][0] > 0
    assert found[0][1].number > 3


def numbered(calendar="standard", units="hours since 2001-01-01"):
    """Times as numbers, with a calendar and units."""
    return xr.DataArray(3.0 * np.arange(ROWS), dims="time", attrs={"units": units, "calendar": calendar})


@pytest.mark.parametrize(
    "times, found",
    [
        (numbered("noleap"), "the times are dates of the calendar 'noleap'"),
        (numbered("360_day"), "the times are dates of the calendar '360_day'"),
        (xr.DataArray(3.0 * np.arange(ROWS), dims="time"), "the times are numbers, not dates"),
        (None, "the file has no times"),
    ],
)
def test_times_that_are_no_dates_are_refused_by_what_they_are(tmp_path, times, found):
    data = xr.Dataset({"hs": ("time", HEIGHT, {"units": "m"}), "tp": ("time", PEAK, {"units": "s"})})
    (data if times is None else data.assign_coords(time=times)).to_netcdf(tmp_path / "sea.nc")
    with pytest.raises(InputError, match=f"time: {found}"):
        read_record(tmp_path / "sea.nc")


def test_a_record_of_one_row_is_refused_by_its_number_of_rows(tmp_path):
    data = xr.Dataset({"hs": ("time", HEIGHT[:1], {"units": "m"})}, {"time": TIME[:1]})
    data.to_netcdf(tmp_path / "sea.nc")
    with pytest.raises(InputError, match="time: the record has 1 row; give two rows or more"):
        read_record(tmp_path / "sea.nc")


@pytest.mark.parametrize("seed", range(8))
def test_several_heights_at_a_time_without_places_are_named(tmp_path, seed):
    """Of stations, members or grid points, in either order of dimensions, by any of the known names."""
    draw = np.random.default_rng(seed)
    dim = str(draw.choice(["station", "site", "number", "node"]))
    name = str(draw.choice(["swh", "hs", "significant_wave_height", "VHM0"]))
    many = int(draw.integers(2, 6))
    attributes = {"units": "m"}
    if name == "VHM0":
        attributes["standard_name"] = "sea_surface_wave_significant_height"
    values = xr.DataArray(np.tile(HEIGHT[:, None], many), dims=("time", dim), attrs=attributes)
    variables = {name: values if seed % 2 else values.T} | {"pp1d": ("time", PEAK, {"units": "s"})}
    xr.Dataset(variables, {"time": TIME}).to_netcdf(tmp_path / "r.nc")
    with pytest.raises(
        InputError, match=f"{name}: the file has several values for each time: {many} of {dim}; write one"
    ):
        read_record(tmp_path / "r.nc")
