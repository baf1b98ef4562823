"""A few reports between the hours, and clocks that are set, change neither hours nor windows nor waits."""

import numpy as np
import pandas as pd
import pytest
from test_record_traps import written

from riserstudy.scene.limits import Limit
from riserstudy.seas.hours import hours, sea_limit
from riserstudy.seas.record import gaps, read_record, write_record
from riserstudy.seas.riser_hours import Response, met, riser_hours

CALM = [sea_limit("hs <= 2.2 m")]
ANGLE = Limit(output="ufj_angle", largest="2.2 rad", mode="drilling")


def of_seed(seed):
    """Times and heights of a record with gaps, and reports at other minutes between some rows."""
    draw = np.random.default_rng(seed)
    interval = int(draw.choice([20, 60, 180]))  # minutes
    count = 4000
    time = pd.date_range("2003-11-30", periods=count, freq=f"{interval}min")
    phase = np.arange(count) * interval / 60.0 / draw.uniform(20.0, 60.0)
    height = 2.0 + np.sin(phase) + draw.normal(0.0, 0.1, count)
    kept = np.ones(count, bool)
    for first in draw.integers(5, count - 20, 6):
        kept[first : first + int(draw.integers(1, 9))] = False
    time, height = time[kept], height[kept]
    near = np.flatnonzero(np.diff(time) == pd.Timedelta(minutes=interval))
    at = draw.choice(near, int(draw.integers(5, 15)), replace=False)
    late = [pd.Timedelta(minutes=int(k)) for k in draw.integers(1, interval, len(at))]
    extra = pd.DatetimeIndex([time[k] + of for k, of in zip(at, late, strict=True)])
    order = np.argsort(time.append(extra))
    return interval / 60.0, time, height, time.append(extra)[order], np.append(height, height[at])[order]


def statistics(found):
    """All of some hours that their rows decide."""
    lengths = (found.interval, 8.0 * found.interval)
    each = [(found.of_windows(length), found.of_waits(length)) for length in lengths]
    return found.rows, found.interval, found.share, found.years, each


@pytest.mark.parametrize("seed", range(12))
def test_reports_between_hours_are_not_hours(tmp_path, seed):
    interval, time, height, times, heights = of_seed(seed)
    plain, more = (
        read_record(written(tmp_path, {"hs (m)": h}, times=t)) for t, h in ((time, height), (times, heights))
    )
    one, other = hours(plain, CALM), hours(more, CALM)
    assert one.interval == interval
    np.testing.assert_equal(statistics(other), statistics(one))
    assert one.of_windows(8.0 * interval).number > 3
    assert len(gaps(plain)) == len(gaps(more)) > 0
    count = len(times) - len(time)
    note = next(line for line in other.notes if "rows between rows that are" in line)
    assert note.startswith(f"{count} ")
    assert (other.between, other.lacking) == (count, 0)


@pytest.mark.parametrize("seed", range(12))
def test_nor_are_they_hours_of_a_riser(tmp_path, seed):
    """With a response in each row, of which some rows lack it."""
    _, time, height, times, heights = of_seed(seed)
    found = []
    for t, h in ((time, height), (times, heights)):
        record = read_record(written(tmp_path, {"hs (m)": h}, times=t))
        none = np.zeros((len(h), 1))
        rows = met(Response(h[:, None], none + 0.1, none, none, none), [ANGLE])
        there = np.ones(len(h), bool)
        made = riser_hours(record, there, rows, [ANGLE], np.zeros(1), {}, np.ones_like(there))
        (mode,) = made.modes
        found.append([mode.low, mode.high, statistics(mode.hours), made.limits.rows])
    np.testing.assert_equal(found[1], found[0])


@pytest.mark.parametrize("seed", range(8))
def test_a_clock_that_is_set_by_any_part_of_an_interval_ends_no_window(tmp_path, seed):
    draw = np.random.default_rng(seed)
    first = pd.date_range("2001-01-01 00:50", periods=int(draw.integers(80, 200)), freq="h")
    after = pd.date_range(first[-1] + pd.Timedelta(minutes=int(draw.integers(10, 60))), periods=150, freq="h")
    times = first.append(after)
    record = read_record(written(tmp_path, {"hs (m)": np.ones(len(times))}, times=times))
    found = hours(record, CALM)
    assert (found.of_windows(200.0).number, found.share) == (1, 1.0)
    assert found.rows >= len(times) - 1


@pytest.mark.parametrize("minutes", [1, 7, 10, 15, 20, 35, 50])
def test_times_of_any_minutes_come_back_exactly_from_a_file(tmp_path, minutes):
    """Hours as floating-point numbers do not hold a third of an hour."""
    draw = np.random.default_rng(minutes)
    times = pd.date_range("2003-11-30 00:03", periods=3000, freq=f"{minutes}min")[draw.random(3000) < 0.99]
    record = read_record(written(tmp_path, {"hs (m)": 2.0 + np.sin(np.arange(len(times)))}, times=times))
    write_record(record, tmp_path / "sea.nc")
    back = read_record(tmp_path / "sea.nc")
    assert (
        back["time"].values.astype("datetime64[ns]").tolist()
        == times.to_numpy().astype("datetime64[ns]").tolist()
    )
    assert back.attrs["interval_hours"] == record.attrs["interval_hours"]
    one, other = hours(record, CALM), hours(back, CALM)
    np.testing.assert_equal(statistics(other), statistics(one))
