"""What is printed of hours of which none is workable."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.cli.downtime_lines import Ahead, held_back, show_hours
from riserstudy.errors import InputError
from riserstudy.seas.hours import hours, sea_limit


def test_a_wait_that_never_ends_is_a_dash(capsys):
    time = np.datetime64("2000-01-01") + np.arange(24 * 800) * np.timedelta64(1, "h")
    sea = xr.Dataset({"significant_wave_height": ("time", np.full(len(time), 3.0))}, {"time": time})
    sea.attrs["interval_hours"] = 1.0
    show_hours(hours(sea, [sea_limit("hs <= 2 m")]), [24.0], Ahead(10, 0.66))
    printed = capsys.readouterr().out
    assert "nan" not in printed
    assert "all           –       –       –  19200" in printed


@pytest.mark.parametrize("seed", range(6))
def test_an_hour_of_a_new_year_is_no_year_that_is_held_back(capsys, seed):
    """A record to midnight of New Year has the prediction and outcome of its whole years."""
    draw = np.random.default_rng(seed)
    years, hold = 6, int(draw.integers(1, 5))
    begin, end = np.datetime64("2001-01-01T00"), np.datetime64(f"{2001 + years}-01-01T00")
    time = np.arange(begin, end + np.timedelta64(int(draw.integers(1, 500)), "h"))
    height = (
        draw.uniform(0.0, 4.0, len(time))
        + 0.3 * draw.random(years + 1)[time.astype("datetime64[Y]").astype(int) - 31]
    )
    sea = xr.Dataset({"significant_wave_height": ("time", height)}, {"time": time})
    sea.attrs["interval_hours"] = 1.0
    limits = [sea_limit("hs <= 2 m")]
    said = []
    for one in (sea, sea.isel(time=time < end)):
        held_back(one, limits, [], Ahead(hold, 0.66))
        said.append(capsys.readouterr().out)
    assert said[0] == said[1]
    first = 2001 + years - hold
    at = (time >= np.datetime64(str(first))) & (time < end)
    assert f"held back from {first} on" in said[0]
    assert f"observed {(height[at] <= 2.0).mean():.2%}" in said[0]
    with pytest.raises(InputError, match="no earlier years"):
        held_back(sea, limits, [], Ahead(years, 0.66))


@pytest.mark.parametrize("years", [2, 3, 5])
def test_without_a_band_nothing_is_inside_or_outside_of_it(capsys, years):
    """Of one year, or of equal years, no band is known."""
    for height, known in ((1.0, False), (None, years > 2)):
        time = np.arange(np.datetime64("2001-01-01T00"), np.datetime64(f"{2001 + years}-01-01T00"))
        draw = np.random.default_rng(years)
        year = time.astype("datetime64[Y]").astype(int)
        drawn = draw.uniform(0.0, 3.0 + 0.3 * (year - year[0]), len(time))
        values = drawn if height is None else np.full(len(time), height)
        sea = xr.Dataset({"significant_wave_height": ("time", values)}, {"time": time})
        sea.attrs["interval_hours"] = 1.0
        held_back(sea, [sea_limit("hs <= 2 m")], [], Ahead(1, 0.66))
        said = capsys.readouterr().out.strip()
        assert said.endswith("side") == known
        assert ("no band" in said) != known


@pytest.mark.parametrize("minutes", [10, 20, 30, 60])
def test_waits_are_printed_in_parts_of_an_hour(capsys, minutes):
    """To a tenth of an hour, also where rows are minutes apart."""
    draw = np.random.default_rng(minutes)
    time = np.datetime64("2000-01-01", "ns") + np.arange(9000) * np.timedelta64(minutes, "m")
    height = 2.0 + np.sin(np.arange(9000) / draw.uniform(1.0, 4.0))
    sea = xr.Dataset({"significant_wave_height": ("time", height)}, {"time": time})
    sea.attrs["interval_hours"] = minutes / 60.0
    found = hours(sea, [sea_limit("hs <= 1.8 m")])
    show_hours(found, [minutes / 30.0], Ahead(10, 0.66))
    (line,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith("  all ")]
    mean, p50, p90 = (float(cell) for cell in line.split()[1:4])
    (_, of), *_ = found.of_waits(minutes / 30.0)
    assert [mean, p50, p90] == pytest.approx([of.mean, of.p50, of.p90], abs=0.051)
    assert of.p90 > 0.0
