"""Workable hours by direction, against rows that are counted one after another."""

import math
import re

import numpy as np
import pytest
import xarray as xr

from riserstudy.seas.by_direction import UNKNOWN, by_direction
from riserstudy.seas.hours import hours, sea_limit


def record(seed):
    """Hourly rows, some without a value or a direction; many directions are ends of sectors."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(50, 400))
    time = np.datetime64("2003-05-01T00", "ns") + np.arange(count) * np.timedelta64(1, "h")
    height = draw.uniform(0.5, 5.0, count)
    height[draw.random(count) < 0.1] = math.nan
    direction = np.where(
        draw.random(count) < 0.5, draw.integers(0, 48, count) * 7.5, draw.uniform(0, 360, count)
    )
    direction[draw.random(count) < draw.choice([0.0, 0.2])] = math.nan
    return xr.Dataset(
        {"significant_wave_height": ("time", height), "wave_from_direction": ("time", direction)},
        {"time": time},
        {"interval_hours": 1.0},
    )


def counted(seas, sectors, largest):
    """Rows, workable rows and lost rows of each sector; the last are those without a direction."""
    tally = [[0, 0, 0] for _ in range(sectors + 1)]
    for height, bearing in zip(
        seas["significant_wave_height"].values, seas["wave_from_direction"].values, strict=True
    ):
        if math.isnan(height):
            continue
        k = sectors
        if not math.isnan(bearing):
            apart = [(bearing - 360.0 * k / sectors + 180.0) % 360.0 - 180.0 for k in range(sectors)]
            (k,) = [k for k, one in enumerate(apart) if -180.0 / sectors <= one < 180.0 / sectors]
        tally[k][0] += 1
        tally[k][1 if height <= largest else 2] += 1
    return tally


@pytest.mark.parametrize("sectors", [2, 4, 8, 12, 36])
@pytest.mark.parametrize("seed", range(6))
def test_each_row_counts_in_one_sector(seed, sectors):
    seas = record(seed)
    found = hours(seas, [sea_limit("hs <= 2.5 m")])
    table = by_direction(found, seas, sectors)
    tally = counted(seas, sectors, 2.5)
    if not tally[-1][0]:
        tally.pop()
    assert len(table.rows) == len(tally)
    lost = sum(one[2] for one in tally)
    for row, (number, workable, out) in zip(table.rows, tally, strict=True):
        assert row[1] == number
        assert row[3] == (pytest.approx(100.0 * workable / number, abs=0.051) if number else "")
        assert row[4] == pytest.approx(100.0 * out / lost, abs=0.051)
    assert sum(row[1] for row in table.rows) == found.rows
    named = table.rows[-1][0] == UNKNOWN
    assert named == bool(
        np.isnan(seas["wave_from_direction"].values[~np.isnan(seas["significant_wave_height"])]).any()
    )


@pytest.mark.parametrize("seed", range(4))
def test_turned_waves_have_the_hours_of_the_next_sector(seed):
    seas, limits = record(seed), [sea_limit("hs <= 2.5 m")]
    turned = seas.assign(wave_from_direction=(seas["wave_from_direction"] + 45.0) % 360.0)
    own, other = (by_direction(hours(one, limits), one, 8).rows for one in (seas, turned))
    for k in range(8):
        assert other[(k + 1) % 8][1:] == own[k][1:]


def test_sectors_are_named_by_their_ends():
    names = [row[0] for row in by_direction(hours(record(0), [sea_limit("hs <= 9 m")]), record(0), 4).rows]
    assert names[:4] == ["315 to 45", "45 to 135", "135 to 225", "225 to 315"]


def test_nothing_lost_has_no_shares_of_it():
    seas = record(1)
    table = by_direction(hours(seas, [sea_limit("hs <= 9 m")]), seas, 4)
    assert {row[4] for row in table.rows} == {""}


def test_a_record_without_directions_is_refused(commands, tmp_path):
    """Only where the table is requested."""
    hours = np.datetime_as_string(record(0)["time"].values[:40], unit="s")
    rows = "".join(f"{time},{1.0 + k % 3}\n" for k, time in enumerate(hours))
    (tmp_path / "seas.csv").write_text("time,hs (m)\n" + rows)
    words = ["downtime", tmp_path / "seas.csv", "--limit", "hs <= 2 m"]
    assert commands(*words)[0] == 0
    code, out, err = commands(*words, "--by-direction", "8")
    assert (code, out) == (2, "")
    assert re.search(r"--by-direction.*no directions", err)
