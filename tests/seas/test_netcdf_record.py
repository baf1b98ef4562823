"""Sea states out of small made-up files with the names, units and directions of public sources."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.errors import InputError
from riserstudy.seas.netcdf_record import Place
from riserstudy.seas.record import read_record

ROWS = 6
TIME = np.datetime64("2001-01-01T00", "ns") + np.timedelta64(3, "h") * np.arange(ROWS)
HEIGHT = np.array([1.0, 1.5, 2.2, 3.0, 2.4, 1.2])
PEAK = np.array([7.0, 8.0, 9.0, 11.0, 10.0, 8.5])
ZERO = PEAK / 1.3
FROM = np.array([240.0, 250.0, 265.0, 300.0, 10.0, 350.0])
WIND = np.array([6.0, 8.0, 11.0, 14.0, 9.0, 5.0])
EAST, NORTH = WIND * np.sin(1.1), WIND * np.cos(1.1)


def over(dims, **variables):
    """Variables with units, and attributes besides."""
    return {
        name: (dims, values, {"units": unit, **(more[0] if more else {})})
        for name, (values, unit, *more) in variables.items()
    }


def era5():
    """Four places, of which one is meant; times and units as the store of 2024 writes them."""
    places = np.ones((ROWS, 2, 2)) * np.array([[1.0, 0.5], [2.0, 3.0]])

    def at(values):
        return values[:, None, None] * places

    variables = over(
        ("valid_time", "latitude", "longitude"),
        swh=(at(HEIGHT), "m"),
        pp1d=(at(PEAK), "s"),
        mp2=(at(ZERO), "s"),
        mwp=(at(0.9 * PEAK), "s"),
        mwd=(np.ones_like(places) * FROM[:, None, None], "degrees"),
        u10=(at(EAST), "m s**-1"),
        v10=(at(NORTH), "m s**-1"),
    )
    return xr.Dataset(variables, {"valid_time": TIME, "latitude": [60.5, 60.0], "longitude": [2.0, 2.5]})


def ww3():
    """Peak frequency in place of a period, and a node."""
    return xr.Dataset(
        over(
            ("time", "node"),
            hs=(HEIGHT[:, None], "m"),
            fp=(1.0 / PEAK[:, None], "s-1"),
            t02=(ZERO[:, None], "s"),
            dir=(FROM[:, None], "degree", {"standard_name": "sea_surface_wave_from_direction"}),
            uwnd=(EAST[:, None], "m s-1"),
            vwnd=(NORTH[:, None], "m s-1"),
        ),
        {"time": TIME},
    )


def nora3():
    """Directions that waves go to, in radians."""
    towards = np.radians((FROM + 180.0) % 360.0)
    return xr.Dataset(
        over(
            "time",
            hs=(HEIGHT, "m"),
            tp=(PEAK, "s"),
            tm2=(ZERO, "s"),
            thq=(towards, "rad", {"standard_name": "sea_surface_wave_to_direction"}),
            hs_sea=(0.5 * HEIGHT, "m", {"standard_name": "sea_surface_wind_wave_significant_height"}),
            ff=(WIND, "m s-1"),
        ),
        {"time": TIME},
    )


def ndbc():
    """Units in words, and places of length one."""
    dims = ("time", "latitude", "longitude")
    return xr.Dataset(
        over(
            dims,
            wave_height=(HEIGHT[:, None, None], "meters"),
            dominant_wpd=(PEAK[:, None, None], "seconds"),
            average_wpd=(ZERO[:, None, None], "seconds"),
            mean_wave_dir=(FROM[:, None, None], "degrees_true"),
            wind_spd=(WIND[:, None, None], "meters/second"),
        ),
        {"time": TIME, "latitude": [40.0], "longitude": [-70.0]},
    )


@pytest.mark.parametrize("made, near", [(era5, Place(60.5, 2.1)), (ww3, None), (nora3, None), (ndbc, None)])
def test_sources_give_the_same_record(tmp_path, made, near):
    path = tmp_path / "source.nc"
    made().to_netcdf(path)
    record = read_record(path, near)
    for name, true in (
        ("significant_wave_height", HEIGHT),
        ("peak_period", PEAK),
        ("zero_crossing_period", ZERO),
        ("wave_from_direction", FROM),
        ("wind_speed", WIND),
    ):
        np.testing.assert_allclose(record[name].values, true, rtol=1e-6, err_msg=name)
    assert (record["time"].values == TIME).all()


@pytest.mark.parametrize(
    "unit, a_second", [("Hz", 1.0), ("s-1", 1.0), ("1/s", 1.0), ("rad/s", 2 * np.pi), ("rad s-1", 2 * np.pi)]
)
def test_a_peak_frequency_of_each_unit_is_the_same_period(tmp_path, unit, a_second):
    data = ww3().assign(fp=(("time", "node"), a_second / PEAK[:, None], {"units": unit}))
    data.to_netcdf(tmp_path / "source.nc")
    np.testing.assert_allclose(read_record(tmp_path / "source.nc")["peak_period"].values, PEAK, rtol=1e-6)


@pytest.mark.parametrize("unit, turn", [("degrees", 360.0), ("rad", 2.0 * np.pi), ("radian", 2.0 * np.pi)])
@pytest.mark.parametrize("away, sense", [("from", 0.0), ("to", 0.5)])
def test_a_bearing_of_each_unit_and_sense_is_the_same(tmp_path, unit, turn, away, sense):
    turns = (FROM / 360.0 + sense) % 1.0
    about = {"units": unit, "standard_name": f"sea_surface_wave_{away}_direction"}
    data = nora3().assign(thq=("time", turns * turn, about))
    data.to_netcdf(tmp_path / "source.nc")
    record = read_record(tmp_path / "source.nc")
    np.testing.assert_allclose(record["wave_from_direction"].values, FROM, rtol=1e-6)


def density(frequency):
    """JONSWAP spectra of all rows (m2/Hz), by the definition, with the heights that they are to have."""
    ratio = frequency * PEAK[:, None]
    width = np.where(ratio <= 1.0, 0.07, 0.09)
    shape = ratio**-5.0 * np.exp(-1.25 * ratio**-4.0) * 3.3 ** np.exp(-0.5 * ((ratio - 1.0) / width) ** 2)
    fine = np.linspace(0.02, 1.0, 4000)
    r = fine * PEAK[:, None]
    w = np.where(r <= 1.0, 0.07, 0.09)
    whole = r**-5.0 * np.exp(-1.25 * r**-4.0) * 3.3 ** np.exp(-0.5 * ((r - 1.0) / w) ** 2)
    energy = np.trapezoid(whole, fine, axis=1)[:, None]
    return shape * (HEIGHT[:, None] / 4.0) ** 2 / energy


def spread(bearing, of):
    """Share of the energy by direction (1/rad): cosine squared about a bearing (deg)."""
    away = np.radians((bearing - of + 180.0) % 360.0 - 180.0)
    return np.where(np.abs(away) < np.pi / 2.0, 2.0 / np.pi * np.cos(away) ** 2, 0.0)


def ww3_spectra():
    """Density in m2/Hz/rad over directions that waves go to."""
    frequency = 0.035 * 1.07 ** np.arange(45)
    direction = np.arange(0.0, 360.0, 10.0)
    parts = spread(direction[None], (FROM[:, None] + 180.0) % 360.0)
    efth = density(frequency)[:, None, :, None] * parts[:, None, None, :]
    return xr.Dataset(
        {"efth": (("time", "station", "frequency", "direction"), efth, {"units": "m2 s rad-1"})},
        {"time": TIME, "station": [1], "frequency": frequency, "direction": direction},
    )


def era5_spectra():
    """Decimal logarithms of the density over numbers of frequencies and directions that waves go to."""
    frequency = 0.03453 * 1.1 ** np.arange(30)
    direction = 7.5 + 15.0 * np.arange(24)
    parts = spread(direction[None], (FROM[:, None] + 180.0) % 360.0)
    both = density(frequency)[:, None, :] * parts[:, :, None]
    with np.errstate(divide="ignore"):
        logarithm = np.where(both > 1e-10, np.log10(both), np.nan)
    return xr.Dataset(
        {"d2fd": (("time", "direction", "frequency"), logarithm)},
        {"time": TIME, "direction": np.arange(1, 25), "frequency": np.arange(1, 31)},
    )


def ndbc_spectra():
    """Density over frequency alone, at a buoy."""
    frequency = np.concatenate([np.arange(0.02, 0.1, 0.005), np.arange(0.1, 0.49, 0.01)])
    return xr.Dataset(
        {"spectral_wave_density": (("time", "frequency"), density(frequency), {"units": "m2 Hz-1"})},
        {"time": TIME, "frequency": frequency},
    )


@pytest.mark.parametrize("made", [ww3_spectra, era5_spectra, ndbc_spectra])
def test_spectra_of_sources_become_heights_periods_and_directions(tmp_path, made):
    path = tmp_path / "spectra.nc"
    made().to_netcdf(path)
    record = read_record(path)
    assert "from spectra" in record.attrs["conversions"]
    np.testing.assert_allclose(record["significant_wave_height"].values, HEIGHT, rtol=0.02)
    np.testing.assert_allclose(record["peak_period"].values, PEAK, rtol=0.04)
    if made is not ndbc_spectra:
        off = (record["wave_from_direction"].values - FROM + 180.0) % 360.0 - 180.0
        assert np.abs(off).max() < 2.0


@pytest.mark.parametrize(
    "change, near, told",
    [
        (lambda d: d, None, "latitude, longitude: .*2 of latitude, 2 of longitude"),
        (
            lambda d: d.isel(latitude=0, longitude=0).rename(mwd="dir"),
            None,
            "dir: the file does not state whether waves",
        ),
        (lambda d: d.rename(valid_time="step"), Place(60.0, 2.0), "has no times"),
        (lambda d: d.rename(pp1d="mp2", mp2="pp1d"), Place(60.0, 2.0), "the two columns are exchanged"),
    ],
)
def test_what_is_not_clear_is_refused(tmp_path, change, near, told):
    path = tmp_path / "source.nc"
    change(era5()).to_netcdf(path)
    with pytest.raises(InputError, match=told):
        read_record(path, near)


def test_the_command_tells_the_place_and_the_conversions(commands, tmp_path):
    path = tmp_path / "source.nc"
    era5().to_netcdf(path)
    code, out, err = commands("seas", path, "--near", "60.45, 2.05")
    assert code == 0, err
    assert "read at 60.5 N, 2 E, 6 km" in out
    code, _, err = commands("seas", path)
    assert (code, "--near" in err) == (2, True)
    assert commands("seas", path, "--near", "91, 2")[0] == 2


def test_directions_of_a_table_that_waves_go_to_are_turned(tmp_path):
    path = tmp_path / "sea.csv"
    head = "time,hs (m),tp (s),wave_to_direction (deg)\n"
    lines = [f"{t},{h},{p},{(d + 180) % 360}\n" for t, h, p, d in zip(TIME, HEIGHT, PEAK, FROM, strict=True)]
    path.write_text(head + "".join(lines))
    record = read_record(path)
    np.testing.assert_allclose(record["wave_from_direction"].values, FROM)
    assert "180 deg" in record.attrs["conversions"]
    path.write_text(head + "".join(lines[:-1]) + f"{TIME[-1]},1,8,700\n")
    with pytest.raises(InputError, match="row 7: wave_from_direction: 700"):
        read_record(path)


def at_a_clock(tmp_path, of_time=None, of_file=None, units="hours since 2001-01-01 00:00"):
    """A file with attributes of its times and of itself."""
    path = tmp_path / "source.nc"
    made = xr.Dataset(
        {"hs": ("time", HEIGHT, {"units": "m"})},
        {"time": ("time", np.arange(ROWS), {"units": units} | (of_time or {}))},
        of_file or {},
    )
    made.to_netcdf(path)
    return path


LOCAL = {
    "time_zone": ["UTC-6", "America/Chicago", "local", "CET", "+01:00", "GMT +3"],
    "utc_offset": [-6, "5.5 hours", "-03:00"],
    "comment": ["local time", "time in UTC+1", "times are in CST", "Local standard time at the rig"],
}


@pytest.mark.parametrize("name, value", [(n, v) for n, values in LOCAL.items() for v in values])
def test_local_times_are_refused_wherever_they_are_stated(tmp_path, name, value):
    for where in ("of_time", "of_file"):
        with pytest.raises(InputError, match=f"{name}: .* a time zone other than UTC"):
            read_record(at_a_clock(tmp_path, **{where: {name: value}}))


@pytest.mark.parametrize(
    "about",
    [
        {"time_zone": "UTC"},
        {"timezone": "GMT"},
        {"tz": "Z"},
        {"utc_offset": 0},
        {"utc_offset": "+00:00"},
        {"comment": "times in UTC, local time is UTC-6"},
        {"title": "WAVES OFF THE WEST COAST, locally generated, of all times"},
    ],
)
def test_times_in_utc_are_not(tmp_path, about):
    for where in ("of_time", "of_file"):
        record = read_record(at_a_clock(tmp_path, **{where: about}))
        assert record["time"].values[0] == np.datetime64("2001-01-01T00")


@pytest.mark.parametrize("hours", [-11, -6, 0, 5, 12])
def test_an_offset_in_units_is_taken_out_and_a_name_of_a_zone_is_refused(tmp_path, hours):
    since = "hours since 2001-01-01 00:00:00"
    record = read_record(at_a_clock(tmp_path, units=f"{since} {hours:+d}:00"))
    first = np.datetime64("2001-01-01T00") - np.timedelta64(hours, "h")
    assert record["time"].values[0] == first
    with pytest.raises(InputError, match="a time zone other than UTC"):
        read_record(at_a_clock(tmp_path, units=f"{since} CET"))


@pytest.mark.parametrize("zone, fits", [("UTC", True), ("CST", False), ("-06:00", False)])
def test_a_column_of_zones_counts(tmp_path, zone, fits):
    path = tmp_path / "sea.csv"
    rows = [f"2001-01-01 {k:02d}:00,{'UTC' if k < 3 else zone},1.5" for k in range(6)]
    path.write_text("\n".join(["time,timezone,hs (m)", *rows]) + "\n")
    if fits:
        assert "left out: timezone" in read_record(path).attrs["conversions"]
    else:
        with pytest.raises(InputError, match="row 5: timezone"):
            read_record(path)


@pytest.mark.parametrize("packed, offset", [(False, 0.0), (True, 0.0), (True, 5.0)])
@pytest.mark.parametrize("ends", ["range", "ends", "one end", "unpacked range"])
@pytest.mark.parametrize("seed", range(3))
def test_values_beyond_a_valid_range_are_missing(tmp_path, seed, ends, packed, offset):
    draw = np.random.default_rng(seed)
    heights = draw.uniform(0.5, 12.0, ROWS).round(2)
    beyond = draw.random(ROWS) < 0.4
    written = np.where(beyond, 32.0, heights)
    scale = 0.01 if packed else 1.0
    least, most = (round((end - offset) / scale) for end in (0.0, 20.0))
    kind = "i2" if packed else "f4"
    if ends == "unpacked range":
        least, most, kind = 0.0, 20.0, "f8"
    attributes = {
        "range": {"valid_range": np.array([least, most], kind)},
        "unpacked range": {"valid_range": np.array([least, most], kind)},
        "ends": {"valid_min": np.array(least, kind), "valid_max": np.array(most, kind)},
        "one end": {"valid_max": np.array(most, kind)},
    }[ends]
    variables = over("time", swh=(written, "m", attributes), pp1d=(PEAK, "s"))
    packing = {"dtype": "i2", "scale_factor": scale, "add_offset": offset, "_FillValue": -9999}
    encoding = {"swh": packing if packed else {}}
    xr.Dataset(variables, {"time": TIME}).to_netcdf(tmp_path / "r.nc", encoding=encoding)
    record = read_record(tmp_path / "r.nc", None)
    expected = np.where(beyond, np.nan, heights)
    np.testing.assert_allclose(record["significant_wave_height"], expected, atol=1e-6)


def test_flags_of_quality_are_named_as_left_out(tmp_path):
    flags = (np.array([1, 4] * 3, "i1"), "1", {"standard_name": "status_flag"})
    xr.Dataset(over("time", swh=(HEIGHT, "m"), swh_qc=flags), {"time": TIME}).to_netcdf(tmp_path / "r.nc")
    assert "left out: quality flags swh_qc" in str(read_record(tmp_path / "r.nc", None).attrs)


@pytest.mark.parametrize("hours", [0, 3, 12])
@pytest.mark.parametrize("along", ["time", "step"])
def test_times_are_those_that_values_are_valid_at(tmp_path, hours, along):
    """As cfgrib writes forecasts: of several starts at one step, or of one start."""
    step = np.timedelta64(hours, "h")
    start = TIME - step if along == "time" else TIME[0] - step
    steps = step if along == "time" else TIME - start
    coordinates = {
        "time": (along if along == "time" else (), start, {"standard_name": "forecast_reference_time"}),
        "step": ((), steps) if along == "time" else ("step", steps),
        "valid_time": (along, TIME, {"standard_name": "time"}),
    }
    data = xr.Dataset(over(along, swh=(HEIGHT, "m"), pp1d=(PEAK, "s")), coordinates)
    data.to_netcdf(tmp_path / "r.nc")
    record = read_record(tmp_path / "r.nc", None)
    np.testing.assert_array_equal(record["time"].values, TIME)
    np.testing.assert_allclose(record["significant_wave_height"], HEIGHT)


@pytest.mark.parametrize("seed", range(4))
def test_variables_that_are_not_used_are_named(tmp_path, seed):
    draw = np.random.default_rng(seed)
    others = {
        "tm01": over("time", tm01=(PEAK, "s")),
        "u10": over("time", u10=(EAST, "m/s")),  # without v10
        "hs_sea": over(
            "time", hs_sea=(HEIGHT, "m", {"standard_name": "sea_surface_wind_wave_significant_height"})
        ),
        "tp (over number)": over(("time", "number"), tp=(np.c_[PEAK, PEAK], "s")),
    }
    chosen = [name for name in others if draw.random() < 0.6]
    variables = over("time", swh=(HEIGHT, "m"), pp1d=(PEAK, "s"))
    for name in chosen:
        variables |= others[name]
    xr.Dataset(variables, {"time": TIME}).to_netcdf(tmp_path / "r.nc")
    record = read_record(tmp_path / "r.nc", None)
    said = str(record.attrs.get("conversions", "")).partition("left out: ")[2]
    assert said == ", ".join(chosen)
    assert {*record.data_vars} == {"significant_wave_height", "peak_period"}
