"""Hours of modes and what each limit takes of them, against rows that are counted one after another."""

import math

import numpy as np
import pytest
import xarray as xr

from riserstudy.scene.limits import Limit
from riserstudy.seas.hours import NAMES, Hours, SeaLimit, hours, idle_limits
from riserstudy.seas.riser_hours import Response, by_rows, met, riser_hours
from riserstudy.seas.sea_states import SeaStates

EVERY = [
    Limit(output="ufj_angle", largest="4 rad", mode="drilling"),
    Limit(output="lfj_angle", mean="3 rad", mode="drilling"),
    Limit(output="lfj_angle", largest="5 rad", mode="connected"),
    Limit(output="effective_tension", smallest="2 N", mode="connected"),
    Limit(output="stroke", largest="6 m", mode="disconnect"),
]
#: modes whose limits a riser must meet in a mode
NEEDED = {"drilling": "drilling connected disconnect", "connected": "connected disconnect"}


def drawn(seed):
    """A record, limits of it in any order, the response in its rows, and rows without a response."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(20, 60))
    time = np.datetime64("2001-01-01T00", "ns") + np.arange(count) * np.timedelta64(3, "h")
    record = xr.Dataset(coords={"time": time}, attrs={"interval_hours": 3.0})
    some = draw.permutation(len(EVERY))[: draw.integers(1, len(EVERY) + 1)]
    limits = [EVERY[k] for k in some]
    known = draw.random(count) < 0.8
    rows = int(known.sum())
    demand = draw.uniform(1.0, 6.0, (rows, len(limits)))
    demand[draw.random(rows) < 0.2] = math.nan
    off, worse, better, scale = draw.uniform(0.0, 0.8, (4, rows, len(limits)))
    return draw, record, limits, known, Response(demand, off, worse, better, scale)


def is_met(limit, demand, change):
    """Whether a limit is met with a demand that is worse by a change; NaN: no."""
    if limit.side == "smallest":
        return demand - change >= limit.allowable
    return demand + change <= limit.allowable


@pytest.mark.parametrize("seed", range(40))
def test_hours_are_those_of_rows_counted_one_by_one(seed):
    draw, record, limits, known, response = drawn(seed)
    error = draw.uniform(0.0, 0.2, len(limits))
    sea = {name: draw.random(len(known)) < 0.8 for name in ("wind", "current")[: draw.integers(3)]}
    found = riser_hours(record, known, met(response, limits), limits, error, sea, np.ones_like(known))
    rows = range(len(response.demand))
    of_sea = [all(flags[known][n] for flags in sea.values()) for n in rows]

    changes = {
        0.0: 0.0 * response.off,
        1.0: response.off + response.seeds_worse,
        -1.0: -response.off - response.seeds_better,
    }

    def share(mode, sign):
        names = NEEDED.get(mode, mode).split()
        of = [k for k, limit in enumerate(limits) if limit.mode in names]
        good = [
            of_sea[n] and all(is_met(limits[k], response.demand[n, k], changes[sign][n, k]) for k in of)
            for n in rows
        ]
        return sum(good) / len(good)

    modes = [mode for mode in ("drilling", "connected", "disconnect") if mode in {o.mode for o in limits}]
    assert [one.mode for one in found.modes] == modes
    for one in found.modes:
        expected = [share(one.mode, sign) for sign in (0.0, 1.0, -1.0)]
        assert [one.hours.share, one.low, one.high] == pytest.approx(expected)
        assert [of.limit for of in one.hours.lost] == [*sea]
        for of in one.hours.lost:  # if this limit were lifted, so many more rows would be workable
            lifted = riser_hours(
                record,
                known,
                met(response, limits),
                limits,
                error,
                {k: v for k, v in sea.items() if k != of.limit},
                np.ones_like(known),
            )
            (again,) = (other for other in lifted.modes if other.mode == one.mode)
            assert of.alone == pytest.approx(again.hours.share - one.hours.share)
            assert of.exceeded == pytest.approx((~sea[of.limit][known]).mean())
    there = [n for n in rows if not math.isnan(response.demand[n, 0])]
    assert found.unknown == pytest.approx(1.0 - len(there) / len(rows))
    for k, limit in enumerate(limits):
        names = NEEDED.get(limit.mode, limit.mode).split()
        over = [[j for j, o in enumerate(limits) if o.mode in names and not is_met(o, d[j], 0.0)]
                for d in response.demand[there]]  # fmt: skip
        calm = [of_sea[n] for n in there]
        row = dict(zip(found.limits.columns, found.limits.rows[k], strict=True))
        assert row["exceeded"] == pytest.approx(100.0 * sum(k in of for of in over) / len(rows))
        assert row["alone"] == pytest.approx(
            100.0 * sum(of == [k] and at for of, at in zip(over, calm, strict=True)) / len(rows)
        )
        order = sorted(response.demand[there, k], reverse=limit.side != "smallest")
        assert row["worst"] == order[0]
        assert row["allowed"] == float(next(filter(None, (limit.largest, limit.smallest, limit.mean)))[:2])
        assert row["error"] == pytest.approx(100.0 * error[k])


@pytest.mark.parametrize("seed", range(20))
def test_rows_between_headings_have_the_weighted_mean_of_their_responses(seed):
    draw = np.random.default_rng(seed)
    count, limits = 30, 2
    weight = draw.dirichlet([1.0, 1.0], count) * (draw.random((count, 2)) < 0.8)
    weight = np.where(weight.sum(axis=1, keepdims=True) > 0.0, weight, 0.0)
    parts = []
    for heading in range(2):
        states = int(draw.integers(3, 8))
        values = draw.uniform(-1.0, 1.0, (5, states, limits))
        values[:, 0] = math.nan  # a run that failed
        parts.append((SeaStates(np.ones((states, 2)), np.ones(states, int), draw.integers(0, states, count)),
                      weight[:, heading], Response(*values)))  # fmt: skip
    known, found = by_rows(parts)
    left = [n for n in range(count) if weight[n].max() > 0.0]
    assert np.flatnonzero(known).tolist() == left
    for field in range(5):
        for place, n in enumerate(left):
            expected = sum(w[n] * one[field][of.state_of_row[n]] for of, w, one in parts if w[n] > 0.0)
            np.testing.assert_allclose(found[field][place], expected)


@pytest.mark.parametrize("seed", range(20))
def test_limits_that_decide_nothing_are_named_with_the_values_of_the_rows_that_count(seed):
    """Values of rows that lack another quantity do not count."""
    draw = np.random.default_rng(seed)
    count = 12
    time = np.datetime64("2001-01-01T00", "ns") + np.arange(count) * np.timedelta64(3, "h")
    height, period = draw.uniform(1.0, 5.0, count), draw.uniform(5.0, 15.0, count)
    height[draw.random(count) < 0.3] = math.nan
    period[draw.random(count) < 0.3] = math.nan
    record = xr.Dataset(
        {"significant_wave_height": ("time", height), "peak_period": ("time", period)},
        {"time": time},
        {"interval_hours": 3.0},
    )
    both = [n for n in range(count) if not math.isnan(height[n] + period[n])]
    limit = SeaLimit(
        NAMES["significant_wave_height"], bool(draw.random() < 0.5), float(draw.uniform(1.0, 5.0))
    )
    every = SeaLimit(NAMES["peak_period"], True, 15.0)
    good = [height[n] <= limit.value if limit.largest else height[n] >= limit.value for n in both]
    found = idle_limits(record, [limit, every])
    assert len(found) == 1 + (all(good) or not any(good))
    assert f"values of the record are {min(period[both]):.3g} to {max(period[both]):.3g} s" in found[-1]
    if len(found) > 1:
        assert f"are {min(height[both]):.3g} to {max(height[both]):.3g} m" in found[0]
        assert ("every row meets" in found[0]) == all(good)
    counted = hours(record, [limit, every])
    assert counted.lacking == count - len(both)
    assert counted.share == pytest.approx(sum(good) / len(good))


@pytest.mark.parametrize("seed", range(20))
def test_bands_leave_out_years_of_which_a_part_is_recorded(seed):
    """From the first of a month on or until its end, with whole years between."""
    draw = np.random.default_rng(seed)
    first, last = int(draw.integers(0, 13)), int(draw.integers(12, 49))
    time = np.arange(np.datetime64("2001-01", "M") + first, np.datetime64("2001-01", "M") + first + last)
    time = np.arange(time[0].astype("datetime64[h]"), time[-1].astype("datetime64[h]"), 6)
    record = xr.Dataset(
        {"significant_wave_height": ("time", draw.uniform(1.0, 5.0, len(time)))},
        {"time": time.astype("datetime64[ns]")},
        {"interval_hours": 6.0},
    )
    found: Hours = hours(record, [SeaLimit(NAMES["significant_wave_height"], True, 3.0)])
    years = time.astype("datetime64[Y]").astype(int) + 1970
    days = {year: (years == year).sum() / 4 for year in sorted(set(years))}
    whole = [year for year, of in days.items() if of > 290]  # eight tenths
    partial = [year for year in days if year not in whole] if whole else []
    assert [one.year for one in found.partial_years] == partial
