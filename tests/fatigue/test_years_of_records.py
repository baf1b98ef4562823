"""Damage over the years of a record: units of axes, what is converted or not used, what cannot be meant."""

import json

import numpy as np
import pytest
import xarray as xr
from test_years import study

from riserstudy.errors import InputError
from riserstudy.fatigue.occurrence import of_record
from riserstudy.fatigue.years import axes_of, over_years
from riserstudy.seas.record import PERIODS, with_peak_period
from riserstudy.seas.sea_states import with_calm_periods

TIME = np.datetime64("2003-01-01", "ns") + np.timedelta64(73, "h") * np.arange(120)


def seas(seed, **more):
    """Sea states at random over a year, and other quantities."""
    draw = np.random.default_rng(seed)
    columns = {
        "significant_wave_height": (draw.uniform(1.0, 8.0, len(TIME)), "m"),
        "peak_period": (draw.uniform(6.0, 15.0, len(TIME)), "s"),
    } | more
    variables = {n: ("time", v, {"units": unit}) for n, (v, unit) in columns.items()}
    return xr.Dataset(variables, {"time": TIME}, {"interval_hours": 73.0, "conversions": ""})


def summed(of, record):
    return over_years(of, of_record(record, of, axes_of(of)), {})


@pytest.mark.parametrize("seed", range(6))
def test_a_record_counts_in_the_units_of_the_study(seed):
    """Axes in feet, centimetres, minutes: the damage of axes in metres and seconds."""
    draw = np.random.default_rng(seed)
    of, record = study(), seas(seed)
    expected = summed(of, record).worst[0].rate
    for axis, units in (
        ("significant_height", {"ft": 0.3048, "cm": 0.01, "in": 0.0254}),
        ("peak_period", {"min": 60.0, "ms": 0.001}),
    ):
        unit = str(draw.choice([*units]))
        values = of[axis].values / units[unit]
        sets = dict(zip(map(str, values.tolist()), json.loads(of[axis].attrs["sets"]).values(), strict=True))
        about = {"units": unit, "sets": json.dumps(sets)}
        of = of.assign_coords({axis: (axis, values, about)})
    assert summed(of, record).worst[0].rate == pytest.approx(expected, rel=1e-9)


def test_a_record_without_values_or_units_does_no_damage_of_nought():
    of, record = study(), seas(1)
    empty = record.copy(deep=True)
    empty["peak_period"][:] = np.nan
    with pytest.raises(InputError, match="no row of the record has"):
        summed(of, empty)
    del record["peak_period"].attrs["units"]
    with pytest.raises(InputError, match="peak_period: the heading has no unit"):
        summed(of, record)


@pytest.mark.parametrize("seed", range(4))
def test_what_is_converted_and_what_is_not_used_is_noted(seed):
    wind = np.full(len(TIME), 9.0), "m s-1"
    record = seas(seed, wind_speed=wind, wave_from_direction=(np.zeros(len(TIME)), "degree"))
    record.attrs["conversions"] = "significant_wave_height from ft"
    notes = summed(study(), record).notes
    unused = "not used, as the study has no such axis: wind_speed, wave_from_direction"
    assert notes == ("converted: significant_wave_height from ft", unused)
    assert not summed(study(), seas(seed)).notes


@pytest.mark.parametrize("seed", range(4))
def test_bearings_of_a_record_are_no_headings_of_a_study(seed):
    """Not even for an axis that has their name: bearings count from north, headings from the x axis."""
    name = "wave_from_direction"
    record = seas(seed, **{name: (np.random.default_rng(seed).uniform(0, 180, len(TIME)), "degree")})
    sets = json.dumps({str(angle): {"wave.heading": f"{angle} deg"} for angle in (0.0, 180.0)})
    both = xr.concat([study(), study()], dim=name, data_vars=["damage_rate"])
    of = both.assign_coords({name: (name, [0.0, 180.0], {"units": "degree", "sets": sets})})
    with pytest.raises(InputError, match="the record has compass bearings"):
        summed(of, record)


@pytest.mark.parametrize("gamma", [None, 2.0, 4.5])
def test_zero_crossing_periods_become_peak_periods_by_the_sea_of_the_study(
    tmp_path, commands, monkeypatch, gamma
):
    """Its scene has a peak enhancement of 2; the option has the last word, and either is printed."""
    monkeypatch.chdir(tmp_path)
    study().to_netcdf("study.nc")
    record = seas(3)
    ratio = sum(factor * (gamma or 2.0) ** power for power, factor in enumerate(PERIODS))
    zero = record["peak_period"] * ratio
    cells = [
        f"{t},{h!r},{z!r}"
        for t, h, z in zip(
            TIME, record["significant_wave_height"].values.tolist(), zero.values.tolist(), strict=True
        )
    ]
    (tmp_path / "sea.csv").write_text("\n".join(["time,hs (m),tz (s)", *cells]) + "\n")
    words = ["--gamma", str(gamma)] if gamma else []
    code, said, _ = commands("fatigue", "study.nc", "--seas", "sea.csv", "--csv", "a.csv", *words)
    assert code == 0
    assert f"JONSWAP with gamma {gamma or 2:g}" in said
    expected = summed(study(), record).worst[0].rate
    row = (tmp_path / "a.csv").read_text().splitlines()[1]
    assert float(row.split(",")[3]) == pytest.approx(expected, rel=1e-4)
    assert with_peak_period(record, 1.0) is record


@pytest.mark.parametrize("seed", range(6))
def test_rows_without_waves_count_as_calm_with_or_without_a_period(seed):
    """They have the share of the time that they have with a period, and so have all other sea states."""
    of, record = study(), seas(seed)
    still = np.random.default_rng(seed).random(len(TIME)) < 0.3
    record["significant_wave_height"].values[still] = 0.0
    record["peak_period"].values[still] = np.nan
    written = record.copy(deep=True)
    written["peak_period"].values[still] = np.median(record["peak_period"].values[~still])
    found, expected = (
        over_years(of, of_record(with_calm_periods(sea), of, axes_of(of)), {}, calm=True)
        for sea in (record, written)
    )
    assert found.worst[0].rate == pytest.approx(expected.worst[0].rate, rel=1e-12)
    assert any(f"{int(still.sum())} rows without waves" in line for line in found.notes)
    with pytest.raises(InputError, match=f"{100 * still.mean():.3g} % of the time, values are outside"):
        summed(of, with_calm_periods(record))


@pytest.mark.parametrize("seed", range(4))
def test_periods_in_every_third_row_of_a_season_are_refused(seed):
    """Otherwise this season would count a third of its time."""
    of, record = study(), seas(seed)
    first = int(np.random.default_rng(seed).integers(0, 50))
    season = np.arange(first, first + 60)
    record["peak_period"].values[season[season % 3 != 0]] = np.nan
    with pytest.raises(InputError, match="rows with values are 219 h apart"):
        summed(of, record)
