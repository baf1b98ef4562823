"""Which history misses its extremes most, and tables of a run, for datasets that are written by hand."""

import json

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.statistics_tables import most_missed
from riserstudy.dataset.tables import tables_of, time_series

NODES = np.array([0.0, 12.5, 20.0, 40.0])


def waves(draw, time, count):
    """Histories of one frequency with many outputs in a period, (count, time), and their true extremes."""
    middle, size = draw.uniform(-3.0, 3.0, count), draw.uniform(0.5, 4.0, count)
    phase = draw.uniform(0.0, 6.0, count)
    return middle[:, None] + size[:, None] * np.sin(0.7 * time + phase[:, None]), middle, size


@pytest.mark.parametrize("seed", range(20))
def test_the_most_missed_history_lacks_the_largest_share_of_its_range(seed):
    """Extremes over all steps exceed those of the outputs by a drawn amount, on either side."""
    draw = np.random.default_rng(seed)
    time = np.arange(0.0, 60.0, 0.25)
    at = np.sort(draw.choice(4, 2, replace=False))
    at_stations, of_stations, sizes_there = waves(draw, time, 2)
    plain, of_plain, sizes = waves(draw, time, 2)
    more = draw.uniform(0.0, 2.0, (2, 4)) * (draw.random((2, 4)) < 0.5)
    middles, radii = np.r_[of_stations, of_plain], np.r_[sizes_there, sizes]
    least, most = middles - radii - more[0], middles + radii + more[1]
    envelope = np.full((2, 4), 1e6)  # of nodes without a station
    envelope[:, at] = least[:2], most[:2]
    stations = np.r_[NODES[at], 33.0]  # the last one is at no node
    rows = [
        {"output": name, "where": where, "smallest": low, "largest": high}
        for name, low, high in zip(("tension", "surge"), least[2:], most[2:], strict=True)
        for where, low, high in (("joint", -1e6, 1e6), ("", low, high))
    ]
    run = xr.Dataset(
        {
            "moment": (("s", "time"), np.vstack([at_stations, 9.0 * at_stations[:1]])),
            "moment_min": ("s_node", envelope[0]),
            "moment_max": ("s_node", envelope[1]),
            "tension": ("time", plain[0]),
            "surge": ("time", plain[1]),
            "unknown": ("time", 9.0 * plain[0]),
        },
        {"time": time, "s": stations, "s_node": NODES},
        {"extremes": json.dumps(rows)},
    )
    names = [f"moment at s = {s:.4g} m" for s in stations[:2]] + ["tension", "surge"]
    shares = more.max(axis=0) / (2.0 * radii + more.sum(axis=0))
    name, share = most_missed(run)
    assert share == pytest.approx(shares.max(), abs=1e-3)
    assert name == names[shares.argmax()] or share < 1e-3


@pytest.mark.parametrize("seed", range(10))
def test_rounding_where_an_output_is_zero_has_no_missed_peaks(seed):
    """A joint that slides without force has a tension of 1e-14 N, which differs from step to step."""
    draw = np.random.default_rng(seed)
    time = np.arange(0.0, 60.0, 0.25)
    (below,), (middle,), (radius,) = waves(draw, time, 1)
    size, more = 10.0 ** draw.uniform(3.0, 7.0), draw.uniform(0.1, 0.3)
    rounding = 1e-16 * size * draw.normal(size=len(time))
    run = xr.Dataset(
        {
            "tension": (("s", "time"), np.array([size * below, rounding])),
            "tension_min": ("s_node", [size * (middle - radius), 3.0 * rounding.min()]),
            "tension_max": ("s_node", [size * (middle + radius + more), 3.0 * rounding.max()]),
        },
        {"time": time, "s": [0.0, 40.0], "s_node": [0.0, 40.0]},
        {"extremes": "[]"},
    )
    name, share = most_missed(run)
    assert name == "tension at s = 0 m"
    assert share == pytest.approx(more / (2.0 * radius + more), abs=1e-3)


@pytest.mark.parametrize("seed", range(10))
def test_time_series_have_a_column_for_each_history(seed):
    """Read back cell by cell from the dataset; histories along the riser and of cylinders have places."""
    draw = np.random.default_rng(seed)
    time, s = np.arange(5) * 0.5, np.sort(draw.uniform(0.0, 1e3, 3))
    run = xr.Dataset(
        {
            "x": (("time", "s"), draw.normal(size=(5, 3)), {"units": "m"}),
            "force": (("cylinder", "time"), draw.normal(size=(2, 5)), {"units": "N"}),
            "surge": ("time", draw.normal(size=5)),
            "x_max": ("s", draw.normal(size=3)),
        },
        {"time": time, "s": s, "cylinder": [1, 2]},
    )
    table = time_series(run)
    expected = {"time": ("s", time), "surge": ("", run["surge"].values)}
    expected |= {f"x at {place:.8g} m": ("m", run["x"].values[:, k]) for k, place in enumerate(s)}
    expected |= {f"force at cylinder {k + 1}": ("N", run["force"].values[k]) for k in range(2)}
    assert sorted(table.columns) == sorted(expected)
    for k, (name, unit) in enumerate(zip(table.columns, table.units, strict=True)):
        assert unit == expected[name][0]
        np.testing.assert_array_equal([row[k] for row in table.rows], expected[name][1])


@pytest.mark.parametrize("moves", [True, False])
@pytest.mark.parametrize("limited", [True, False])
def test_a_run_has_the_tables_of_what_is_in_it(moves, limited):
    row = {"output": "stroke", "allowable": 2.0, "demand": 1.0}
    run = xr.Dataset({"surge": ("time", [0.0, 1.0])} if moves else {}, attrs={"limits": "[]"})
    run = run.assign_coords(time=[0.0, 1.0]) if moves else run
    run.attrs |= {"limits": json.dumps([row])} if limited else {}
    found = tables_of(None, run)
    assert list(found) == ["extremes", *["time-series"] * moves, *["limits"] * limited]
    if limited:
        cells = dict(zip(found["limits"].columns, found["limits"].rows[0], strict=True))
        assert {name: value for name, value in cells.items() if value != ""} == row
