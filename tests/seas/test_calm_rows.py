"""Calm rows of a record, without waves, lack a period and a direction, but are hours of the record."""

import numpy as np
import pytest
from test_riser_downtime import RISER, SEA

from riserstudy import load_scene
from riserstudy.seas.directions import FROM, Directions
from riserstudy.seas.heading_parts import headings
from riserstudy.seas.hours import hours, idle_limits, sea_limit
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.sea_states import sea_states
from riserstudy.seas.synthetic import synthetic

HEIGHT, PERIOD = "significant_wave_height", "peak_period"
ALL_ROUND = [
    {"period": f"{period} s", "heading": f"{angle} deg", "surge": "0.4 m/m", "surge_phase": "90 deg"}
    for period in (1, 6, 12, 60)
    for angle in range(0, 360, 45)
]


@pytest.fixture(scope="module")
def file():
    """A riser under a platform in a sea."""
    return load_scene(RISER).with_values(SEA, "test")


def calmed(seed):
    """A record whose rows are partly calm, of which most lack other values; and these rows."""
    draw = np.random.default_rng(seed)
    record = synthetic(1, seed).isel(time=slice(None, None, 400)).copy(deep=True)
    calm = draw.random(record.sizes["time"]) < 0.4
    record[HEIGHT][calm] = 0.0
    for name in (PERIOD, FROM):
        record[name][calm & (draw.random(len(calm)) < 0.8)] = np.nan
    return record, calm


@pytest.mark.parametrize("seed", range(10))
def test_calm_rows_are_sea_states_of_one_heading(seed, file):
    record, calm = calmed(seed)
    of = sea_states(record)
    assert of.rows.sum() == len(calm)
    assert (of.states[of.state_of_row[calm], 0] < 0.01).all()
    turning = {"platform.response.operators": ALL_ROUND, "platform.response.headings": "towards"}
    found = headings(file.with_values(turning, "test"), record, Directions(8, 1.0))
    np.testing.assert_allclose(np.sum([one.weight for one in found], axis=0), 1.0)
    record[HEIGHT][calm] = 0.1  # waves of unknown period or direction
    lacking = np.isnan(record[PERIOD].values) | np.isnan(record[FROM].values)
    known = np.sum([one.weight for one in headings(file, record, Directions(8, 1.0))], axis=0)
    np.testing.assert_array_equal(known > 0.0, ~lacking)


def test_calm_rows_are_workable_hours(file):
    """Also where the riser's limits are so narrow that no sea is workable."""
    record, calm = calmed(3)
    limits = [{"output": "effective_tension", "smallest": "2255.5 kN", "mode": "drilling"}]
    narrow = file.with_values({"limits": limits}, "test")
    found = riser_downtime(narrow, record, seeds=1, error=0.2, cores=1)
    (mode,) = found.hours.modes
    assert mode.hours.rows == len(calm)
    assert mode.hours.workable[calm].all()
    assert mode.hours.workable.mean() < 1.0


@pytest.mark.parametrize("seed", range(3))
def test_rows_that_are_left_out_are_counted_in_a_line(file, seed):
    record, calm = calmed(seed)
    some = ~calm & (np.random.default_rng(seed).random(len(calm)) < 0.5)
    record[PERIOD][some] = np.nan
    found = riser_downtime(file, record, seeds=1, error=0.5, cores=1)
    (line,) = (one for one in found.lines if "not counted" in one)
    assert line.startswith(f"{some.sum()} further row")
    assert found.hours.modes[0].hours.rows == len(calm) - some.sum()


@pytest.mark.parametrize("name, limit", [(PERIOD, "tp <= 9 s"), ("zero_crossing_period", "tz <= 7 s")])
@pytest.mark.parametrize("seed", range(4))
def test_calm_hours_without_a_period_are_hours_of_limits_on_the_sea(seed, name, limit):
    """As if a buoy had recorded any period that meets the limit: they end no weather window."""
    record = synthetic(2, seed + 20).rename({PERIOD: name}).copy(deep=True)
    draw = np.random.default_rng(seed)
    calm = record[HEIGHT].values < np.quantile(record[HEIGHT].values, draw.uniform(0.05, 0.3))
    record[HEIGHT][calm] = 0.0
    written = record.copy(deep=True)
    written[name][calm] = 6.0
    record[name][calm] = np.nan
    record[name][draw.random(len(calm)) < 0.01] = np.nan  # in other rows, a missing period stays missing
    written[name][np.isnan(record[name].values) & ~calm] = np.nan
    limits = [sea_limit("hs <= 2 m"), sea_limit(limit)]
    one, other = hours(record, limits), hours(written, limits)
    assert (one.rows, one.lacking, one.years) == (other.rows, other.lacking, other.years)
    np.testing.assert_array_equal(one.workable, other.workable)
    assert one.of_windows(12.0) == other.of_windows(12.0)
    assert idle_limits(record, limits) == []
    none = record.isel(time=calm)
    assert hours(none, limits).workable.all()
    assert len(idle_limits(none, limits)) == 1  # only that on the height, of which there are values
