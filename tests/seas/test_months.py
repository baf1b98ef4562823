"""Months of a record that are not whole, and years of which seasons are missing, against counting by hand."""

import math

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from riserstudy.cli.seas import described
from riserstudy.fatigue.occurrence import of_record
from riserstudy.seas.hours import hours, sea_limit
from riserstudy.study.months import MONTHS, uneven_months

HEIGHT = "significant_wave_height"
CALM = [sea_limit("hs <= 2 m")]


def record(time, height=None):
    """Sea states over times."""
    values = np.ones(len(time)) if height is None else height
    sea = {HEIGHT: ("time", values, {"units": "m"})}
    return xr.Dataset(sea, {"time": time}, {"interval_hours": 3.0, "conversions": ""})


@pytest.mark.parametrize("seed", range(8))
def test_a_month_of_which_little_is_recorded_has_no_share(seed):
    """Parts of months cut out at random: shares of the others, empty cells and the line that names them."""
    draw = np.random.default_rng(seed)
    time = pd.date_range("2003-01-01", "2005-12-31 21:00", freq="3h")
    part = {k: draw.uniform(0.02, 0.98) for k in draw.choice(36, 5, replace=False)}
    number = 12 * (time.year - 2003) + time.month - 1
    through = (time.day - 1 + time.hour / 24) / time.days_in_month
    keep = np.array([t < part.get(n, 1.0) for n, t in zip(number, through, strict=True)])
    time, number = time[keep], number[keep]
    of = record(time, draw.choice([1.0, 3.0], len(time)))
    found = hours(of, CALM)
    calm = of[HEIGHT].values <= 2.0
    cells = [cell for row in found.by_month().rows for cell in row[1:13]]
    lacking = []
    for k, cell in enumerate(cells):
        at = number == k
        days = pd.Timestamp(2003 + k // 12, k % 12 + 1, 1).days_in_month
        if at.sum() < 0.8 * 8 * days:
            lacking.append(f"{MONTHS[k % 12]} {2003 + k // 12}")
            assert cell == ""
        else:
            assert cell == pytest.approx(100.0 * calm[at].mean(), abs=0.05)
    for row in found.by_month().rows:
        at = time.year == int(row[0])
        whole = 8 * (366 if row[0] == "2004" else 365)
        assert row[13:] == pytest.approx([100.0 * calm[at].mean(), 100.0 * at.sum() / whole], abs=0.051)
    named = [line for line in found.notes if "months without a share" in line]
    assert named == (
        [f"months without a share, because less than 80% is recorded: {', '.join(lacking)}"] * bool(lacking)
    )
    for k, share in enumerate(found.of_months()):
        assert share == pytest.approx(calm[number % 12 == k].mean())


@pytest.mark.parametrize("seed", range(6))
def test_months_without_rows_are_listed_too(seed):
    """Several successive months left out at random, with a month of which little is left before them."""
    draw = np.random.default_rng(seed)
    first, count = int(draw.integers(2, 20)), int(draw.integers(1, 15))
    time = pd.date_range("2003-01-01", "2005-12-31 21:00", freq="3h")
    number = 12 * (time.year - 2003) + time.month - 1
    out = (number > first) & (number <= first + count) | ((number == first) & (time.day > 5))
    found = hours(record(time[~out]), CALM)
    lacking = [f"{MONTHS[k % 12]} {2003 + k // 12}" for k in range(first, first + count + 1)]
    (named,) = [line for line in found.notes if "months without a share" in line]
    words = named.partition(": ")[2].partition(" and ")
    listed = words[0].split(", ")
    assert listed == lacking[: len(listed)]
    assert len(listed) + int(words[2].split()[0] if words[1] else 0) == len(lacking)


def test_a_month_that_no_year_has_whole_has_no_share():
    found = hours(record(pd.date_range("2003-01-01", "2003-03-10", freq="3h")), CALM)
    assert [math.isnan(share) for share in found.of_months()] == [False] * 2 + [True] * 10


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("years", [1, 2, 3, 7])
def test_whole_years_are_even_and_parts_of_years_are_noted(seed, years):
    """From any day on, whole years are not noted; half a year more is, of up to four years."""
    draw = np.random.default_rng(seed)
    first = pd.Timestamp("2003-01-01") + pd.Timedelta(int(draw.integers(0, 365)), "D")
    for more, noted in ((0, False), (6, years < 5)):
        last = first + pd.DateOffset(years=years, months=more)
        of = record(pd.date_range(first, last, freq="3h", inclusive="left"))
        occurs = of_record(of, of.assign_coords({HEIGHT: ("x", [1.0], {"units": "m"})}), [HEIGHT])
        ways = described(of), hours(of, CALM).notes, occurs.notes
        said = [[line for line in lines if "unevenly" in line] for lines in ways]
        assert said[0] == said[1] == said[2]
        assert len(said[0]) == noted


@pytest.mark.parametrize("lost, noted", [(0.10, False), (0.115, True)])
def test_a_month_short_of_a_tenth_of_its_hours_is_uneven(lost, noted):
    """July without a share of its hours has 9.2 and 10.6 % less than an even share of what is left."""
    time = pd.date_range("2001-01-01", "2004-12-31 23:00", freq="h")
    july = np.flatnonzero(time.month == 7)
    time = time.delete(july[: round(lost * len(july))])
    assert bool(uneven_months(time.to_numpy())) == noted


@pytest.mark.parametrize("seed", range(4))
def test_uneven_months_are_listed_by_their_hours(seed):
    """Months dropped at random from three years, against their days."""
    draw = np.random.default_rng(seed)
    time = pd.date_range("2001-01-01", "2003-12-31 21:00", freq="3h")
    lost = draw.choice(12, 3, replace=False)
    time = time[~np.isin(time.month - 1, lost)]
    (line,) = (line for line in hours(record(time), CALM).notes if "unevenly" in line)
    shares = dict(part.split(" ") for part in line.rpartition(": ")[2].split(", "))
    days = {m: 0 if k in lost else (time.month == k + 1).sum() / 24 for k, m in enumerate(MONTHS)}
    whole = dict(zip(MONTHS, (31, 28.25, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31), strict=True))
    for name, of in shares.items():
        even = sum(days.values()) * whole[name] / 365.25
        assert float(of.rstrip("%")) == pytest.approx(100 * days[name] / even, abs=0.5)


@pytest.mark.parametrize("seed", range(4))
def test_a_month_has_a_share_from_four_fifths_of_its_own_rows_on(seed):
    """Each month of a common and of a leap year with just as many rows, or one fewer."""
    draw = np.random.default_rng(seed)
    time = pd.date_range("2003-01-01", "2004-12-31 21:00", freq="3h")
    number = 12 * (time.year - 2003) + time.month - 1
    whole = draw.random(24) < 0.5
    rows = [math.ceil(0.8 * np.sum(number == k)) - (not whole[k]) for k in range(24)]
    kept = np.concatenate([np.flatnonzero(number == k)[: rows[k]] for k in range(24)])
    found = hours(record(time[kept]), CALM)
    cells = [cell for row in found.by_month().rows for cell in row[1:13]]
    assert [cell != "" for cell in cells] == whole.tolist()
