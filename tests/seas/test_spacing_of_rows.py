"""Records whose interval changes: refused, as each row counts as one interval; gaps at random are not."""

import numpy as np
import pandas as pd
import pytest
from test_record_traps import written

from riserstudy.errors import InputError
from riserstudy.seas.hours import hours, sea_limit
from riserstudy.seas.record import read_record

CALM, ROUGH = 1.0, 4.0


def changing(seed):
    """Times of a record that becomes or was dense, its heights, and the share of the time that is calm."""
    draw = np.random.default_rng(seed)
    minutes, times = int(draw.choice([10, 20, 30, 60])), int(draw.integers(2, 7))
    dense = int(draw.integers(2000, 4000))
    coarse = int(draw.integers(100, dense // times))  # so most rows are dense
    steps = [np.full(coarse, times * minutes), np.full(dense, minutes)]
    heights = [np.full(coarse, CALM), np.full(dense, ROUGH)]
    order = 1 if draw.random() < 0.5 else -1
    every = np.concatenate(steps[::order])
    time = np.datetime64("2001-01-01T00:00", "ns") + np.cumsum(every).astype("timedelta64[m]")
    height = np.concatenate(heights[::order])
    return time, height, every[height == CALM].sum() / every.sum(), times


@pytest.mark.parametrize("seed", range(8))
def test_a_record_whose_interval_becomes_longer_or_shorter_is_refused(tmp_path, seed):
    """Counted by rows, its workable time is far from the time that is calm; thinned, it is equal."""
    time, height, calm, times = changing(seed)
    assert abs((height == CALM).mean() - calm) > 0.02
    with pytest.raises(InputError, match=r"h apart from 200.* keep only rows"):
        read_record(written(tmp_path, {"hs (m)": height}, times=time))
    rough = np.flatnonzero(height == ROUGH)
    kept = np.sort(np.concatenate([np.flatnonzero(height == CALM), rough[times - 1 :: times]]))
    record = read_record(written(tmp_path, {"hs (m)": height[kept]}, times=time[kept]))
    assert hours(record, [sea_limit("hs <= 2 m")]).share == pytest.approx(calm, abs=0.003)


@pytest.mark.parametrize("seed", range(8))
def test_empty_cells_that_change_the_interval_are_refused(tmp_path, seed):
    """Heights in each row, but in a part of the record wind only in every second to sixth row."""
    draw = np.random.default_rng(seed)
    rows, every = 3000, int(draw.integers(2, 7))
    first, last = sorted(draw.choice(np.arange(100, 2900, 400), 2, replace=False))
    number = np.arange(rows)
    there = (number < first) | (number >= last) | (number % every == 0)
    columns = {
        "hs (m)": np.full(rows, 1.0),
        "wind (m/s)": [f"{5 + n % 7}" if known else "" for n, known in zip(number, there, strict=True)],
    }
    record = read_record(written(tmp_path, columns))
    assert hours(record, [sea_limit("hs <= 2 m")]).rows == rows
    with pytest.raises(InputError, match=f"rows with values are {every} h apart"):
        hours(record, [sea_limit("hs <= 2 m"), sea_limit("wind <= 8 m/s")])


@pytest.mark.parametrize("seed", range(8))
def test_a_part_in_which_a_quantity_is_measured_more_often_is_refused(tmp_path, seed):
    """Wind in every second to sixth row, and in each row of a rough part, which so counted too much."""
    draw = np.random.default_rng(seed)
    every, dense = int(draw.integers(2, 7)), int(draw.integers(40, 400))
    rows = int(draw.uniform(1.5, 10.0) * every * dense)
    first = every * int(draw.integers(0, (rows - dense) // every))
    number = np.arange(rows)
    rough = (number >= first) & (number < first + dense)
    wind = ["12" if of else "5" if n % every == 0 else "" for n, of in zip(number, rough, strict=True)]
    limits = [sea_limit("hs <= 2 m"), sea_limit("wind <= 8 m/s")]
    record = read_record(written(tmp_path, {"hs (m)": np.full(rows, 1.0), "wind (m/s)": wind}))
    with pytest.raises(InputError, match=f"rows with values are 1 h apart .* are {every} h apart"):
        hours(record, limits)
    thinned = [cell if n % every == 0 else "" for n, cell in enumerate(wind)]
    record = read_record(written(tmp_path, {"hs (m)": np.full(rows, 1.0), "wind (m/s)": thinned}))
    assert hours(record, limits).share == pytest.approx((~rough).mean(), abs=2.0 * every / rows)


@pytest.mark.parametrize("seed", range(8))
def test_gaps_at_random_are_allowed(tmp_path, seed):
    """Up to half of the rows missing one by one, and long gaps; or a coarse quantity in the whole record."""
    draw = np.random.default_rng(seed)
    time = pd.date_range("2003-02-01", periods=6000, freq="h").to_numpy()
    kept = draw.random(len(time)) > draw.uniform(0.0, 0.5)
    for start in draw.integers(0, 5900, 3):
        kept[start : start + int(draw.integers(5, 90))] = False
    record = read_record(written(tmp_path, {"hs (m)": np.ones(int(kept.sum()))}, times=time[kept]))
    assert hours(record, [sea_limit("hs <= 2 m")]).share == 1.0
    every = int(draw.integers(2, 7))
    cells = ["1.5" if k % every == 0 else "" for k in range(len(time))]
    record = read_record(written(tmp_path, {"hs (m)": cells}, times=time))
    assert hours(record, [sea_limit("hs <= 2 m")]).rows == -(-len(time) // every)


@pytest.mark.parametrize("seed", range(6))
def test_empty_rows_between_rows_with_heights_change_nothing(tmp_path, seed):
    """Buoys write rows of wind each ten minutes, and waves in each hour: the record of the hours alone."""
    draw = np.random.default_rng(seed)
    every, rows = int(draw.integers(2, 7)), 6 * 1500
    time = pd.date_range("2003-02-01", periods=every * rows, freq=f"{60 // every} min").to_numpy()
    noise = np.convolve(draw.standard_normal(rows + 99), np.ones(100) / 10.0, "valid")
    height = np.round(2.0 * np.exp(0.4 * noise), 2)
    height[draw.random(rows) < 0.01] = np.nan
    cells = np.full(len(time), np.nan)
    cells[::every] = height
    wind = np.where(np.arange(len(time)) % 2, 5.0, 15.0)
    made = [
        read_record(written(tmp_path, {"hs (m)": h, "wind (m/s)": w}, times=t))
        for h, w, t in ((cells, wind, time), (height, wind[::every], time[::every]))
    ]
    limits = [sea_limit("hs <= 2.5 m")]
    both, alone = (hours(one, limits) for one in made)
    assert (both.share, both.years, both.interval) == (alone.share, alone.years, 1.0)
    for length in (3.0, 24.0):
        assert both.of_windows(length) == alone.of_windows(length)
        np.testing.assert_equal(both.of_waits(length), alone.of_waits(length))
    assert both.of_windows(3.0).number > 0
    of_wind = hours(made[0], [sea_limit("wind <= 10 m/s")])
    assert of_wind.interval == pytest.approx(1.0 / every)
    assert of_wind.years[0].recorded == pytest.approx(alone.years[0].recorded, rel=0.02)
    assert made[0].attrs["interval_hours"] == made[1].attrs["interval_hours"]  # of demands and return values
