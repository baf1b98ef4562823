"""Options that a record or the lack of a scene leaves without effect are refused."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from riserstudy.errors import InputError
from riserstudy.seas.netcdf_record import Place
from riserstudy.seas.record import read_record


def written(tmp_path, periods, count=60):
    """A table with periods of a kind, and its path."""
    path = tmp_path / f"{periods}.csv"
    times = pd.date_range("2004-01-01", periods=count, freq="h")
    pd.DataFrame({"time": times, "hs (ft)": 6.0, f"{periods} (s)": 8.0}).to_csv(path, index=False)
    return path


@pytest.mark.parametrize("words", ["--set top.z=free", "--seeds 9", "--error 0.2", "--most 30", "--cores 2"])
def test_options_of_a_scene_are_refused_without_one(tmp_path, commands, words):
    path = written(tmp_path, "tp")
    code, _, said = commands("downtime", path, "--limit", "hs <= 2 m", *words.split())
    assert (code, words.split()[0] in said, "--scene" in said) == (2, True, True)


@pytest.mark.parametrize(
    "periods, words, fits",
    [
        ("tp", "--near 60,2", False),
        ("tp", "--seed 4", False),
        ("tp", "--gamma 2", False),
        ("tz", "--gamma 2", True),
        ("tp", "", True),
    ],
)
def test_options_that_a_record_leaves_without_effect_are_refused(tmp_path, commands, periods, words, fits):
    code, _, said = commands("seas", written(tmp_path, periods), *words.split())
    assert (code == 0) == fits
    assert fits or words.split()[0] in said


@pytest.mark.parametrize(
    "words, reason",
    [
        (["--limit", "hs <= -1 m"], "the value is impossible"),
        (["--limit", "hs <= 90 m"], "write a value from 0 to 35 m"),
        (["--limit", "hs <= nan m"], "hs <= nan m"),
        (["--limit", "hs <= 2 m", "--window", "-24 h"], "not above 0"),
        (
            ["--limit", "hs <= 2 m", "--window", "24 h", "--window", "90 min"],
            "the interval of the record, 1 h",
        ),
    ],
)
def test_limits_and_windows_that_no_sea_has_are_refused_before_results(tmp_path, commands, words, reason):
    code, out, said = commands("downtime", written(tmp_path, "tp"), *words)
    assert (code, "workable" in out) == (2, False)
    assert reason in said


@pytest.mark.parametrize("seed", range(4))
def test_limits_that_decide_nothing_are_named(tmp_path, commands, seed):
    """A limit outside of the heights of a record has a warning, and a limit between them has none."""
    draw = np.random.default_rng(seed)
    height = draw.uniform(1.0, 6.0, 60)
    times = pd.date_range("2004-01-01", periods=60, freq="h")
    pd.DataFrame({"time": times, "hs (m)": height}).to_csv(tmp_path / "sea.csv", index=False)
    for value, words in (
        (0.9 * height.min(), "no row meets"),
        (np.median(height), ""),
        (1.1 * height.max(), "every row meets"),
    ):
        code, _, said = commands("downtime", tmp_path / "sea.csv", "--limit", f"hs <= {value} m")
        assert (code, "warning" in said) == (0, bool(words))
        assert words in said


@pytest.mark.parametrize("seed", range(4))
def test_the_distance_of_the_only_place_is_noted(tmp_path, seed):
    draw = np.random.default_rng(seed)
    north, east = draw.uniform(-60.0, 60.0), draw.uniform(-170.0, 170.0)
    time = pd.date_range("2004-01-01", periods=5, freq="h")
    sea = xr.Dataset({"hs": ("time", np.ones(5), {"units": "m"})}, {"time": time})
    sea.to_netcdf(tmp_path / "nowhere.nc")
    sea.assign_coords(latitude=north, longitude=east).to_netcdf(tmp_path / "there.nc")
    near = Place(north + 1.0, east)
    assert "111 km" in read_record(tmp_path / "there.nc", near).attrs["conversions"]
    with pytest.raises(InputError, match="no latitudes and longitudes"):
        read_record(tmp_path / "nowhere.nc", near)


def test_conversions_are_printed_with_hours_and_kept_in_a_record(tmp_path, commands):
    path = written(tmp_path, "tz")
    _, said, _ = commands("downtime", path, "--limit", "hs <= 2 m")
    assert "converted: significant_wave_height from ft" in said
    assert commands("seas", path, "--gamma", "2", "-o", tmp_path / "record.nc")[0] == 0
    _, said, _ = commands("downtime", tmp_path / "record.nc", "--limit", "tp <= 12 s")
    assert "JONSWAP with gamma 2" in said


@pytest.mark.parametrize("words", [["--contour", "100"], ["--return-period", "100"]])
def test_extremes_that_a_record_does_not_have_are_refused_before_results(tmp_path, commands, words):
    """A record of a few rows, without periods."""
    path = tmp_path / "sea.csv"
    path.write_text("time,hs (m)\n" + "".join(f"2001-01-01 {hour:02d}:00,{hour}\n" for hour in range(9)))
    code, out, said = commands("seas", path, *words)
    assert (code, out) == (2, ""), said
