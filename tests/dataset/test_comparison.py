"""A run compared with a table: units, places, lags and differences that are known beforehand."""

import csv

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.comparison import Pair, compared, difference
from riserstudy.dataset.unit_systems import UnitSystem, reading_in
from riserstudy.errors import InputError
from riserstudy.figures.comparison import comparison

TIME, S = np.arange(0.0, 100.0, 0.25), np.array([0.0, 100.0, 200.0, 300.0])


def run():
    """A run whose tension is known in closed form: 1 MN and 1 kN a metre, swinging by 50 kN in 10 s."""
    swing = 5e4 * np.sin(2.0 * np.pi * TIME / 10.0)
    tension = 1e6 + 1e3 * S[None, :] + swing[:, None]
    data = {
        "effective_tension": (("time", "s"), tension, {"units": "N"}),
        "ufj_angle": ("time", np.radians(2.0) * np.cos(TIME), {"units": "rad"}),
        "bending_moment_max": ("s_node", 1e3 * S, {"units": "N m"}),
    }
    return xr.Dataset(data, {"time": TIME, "s": S, "s_node": S}, {"title": "a run"})


def tension(time, place):
    """In kN."""
    return 1e3 + place + 50.0 * np.sin(2.0 * np.pi * time / 10.0)


@pytest.fixture
def table(tmp_path):
    def written(headings, *columns):
        path = tmp_path / "other.csv"
        with path.open("w", newline="") as file:
            csv.writer(file).writerows([headings, *zip(*columns, strict=True)])
        return path

    return written


@pytest.mark.parametrize("unit, per", [("kN", 1.0), ("N", 1e3), ("MN", 1e-3), ("kip", 1 / 4.4482216)])
def test_the_same_in_any_unit_differs_by_nothing(table, unit, per):
    path = table(["time (s)", f"effective_tension at 300 m ({unit})"], TIME, per * tension(TIME, 300.0))
    (pair,) = compared(run(), path).pairs
    off = difference(pair)
    assert pair.notes == []
    # to the digits of the kip
    assert off.rms < 1e-6 * 1.3e6
    assert abs(off.lag) < 1e-6


@pytest.mark.parametrize("seed", range(8))
def test_a_lag_is_found_and_taken_out(table, seed):
    """Of a table of its own times, between the run's: to a fiftieth of its step."""
    rng = np.random.default_rng(seed)
    late, times = rng.uniform(-2.0, 2.0), np.arange(5.0, 90.0, 0.2)
    path = table(["time (s)", "effective_tension at 100 m (kN)"], times, tension(times + late, 100.0))
    (pair,) = compared(run(), path).pairs
    off = difference(pair)
    assert off.lag == pytest.approx(late, abs=0.02)
    assert pair.notes == ["the run is interpolated over time"]
    exact = 5e4 * np.sqrt(2.0) * abs(np.sin(np.pi * late / 10.0))
    assert off.rms == pytest.approx(exact, rel=0.02)
    # what is left is less than a step of lag leaves
    assert off.rms_in_phase <= 5e4 * np.sqrt(2.0) * np.sin(np.pi * 0.1 / 10.0) * 1.2


@pytest.mark.parametrize("seed", range(4))
def test_peaks_and_the_largest_difference_are_those_that_were_added(table, seed):
    rng = np.random.default_rng(seed)
    theirs, k = tension(TIME, 0.0), int(rng.integers(40, 300))
    theirs[k] += 500.0
    path = table(["time (s)", "effective_tension at 0 m (kN)"], TIME, theirs)
    (pair,) = compared(run(), path).pairs
    off = difference(pair)
    assert (off.largest, off.at) == pytest.approx((-5e5, TIME[k]))
    assert off.peak == pytest.approx(1.05e6 - 1e3 * theirs.max(), rel=1e-3)
    assert off.low == pytest.approx(0.0, abs=1.0)


def test_a_place_between_stations_is_interpolated_and_told(table):
    path = table(["time (s)", "effective_tension at 150 m (kN)"], TIME, tension(TIME, 150.0))
    (pair,) = compared(run(), path).pairs
    assert pair.notes == ["the run is interpolated between 100 and 200 m"]
    assert difference(pair).rms < 1e-3


def test_values_along_the_riser(table):
    s = np.linspace(0.0, 300.0, 13)
    path = table(["s (m)", "bending_moment_max (kN m)"], s, s + 3.0)
    (pair,) = compared(run(), path).pairs
    off = difference(pair)
    assert off.rms == pytest.approx(3e3)
    assert np.isnan(off.lag)


@pytest.mark.parametrize(
    "headings, said",
    [
        (["time (s)", "wall_tension at 300 m (kN)"], "T_e = T_w"),
        (["time (s)", "end_force (kN)"], "the force at that end"),
        (["time (s)", "effective_tension (kN)"], "give the place"),
        (["time (s)", "effective_tension at 400 m (kN)"], "is not on the riser"),
        (["time (s)", "tension at 300 m (kN)"], "has no tension over time"),
        (["time (s)", "effective_tension at 300 m (m)"], "wrong dimension"),
        (["time (s)", "effective_tension at 300 m"], "not a heading with a unit"),
        (["depth (m)", "bending_moment_max (kN m)"], "is not an axis"),
    ],
)
def test_what_cannot_be_compared_is_refused_with_the_remedy(table, headings, said):
    with pytest.raises(InputError, match=said):
        compared(run(), table(headings, TIME, TIME))


def test_tables_that_do_not_overlap_or_rise_are_refused(table):
    for times, said in ((TIME + 1e3, "only 0 rows have numbers between"), (-TIME, "do not increase")):
        with pytest.raises(InputError, match=said):
            compared(run(), table(["time (s)", "ufj_angle (deg)"], times, TIME))


def test_the_command_prints_differences_and_draws_both(table, commands, tmp_path):
    run().to_netcdf(tmp_path / "run.nc")
    path = table(
        ["time (s)", "effective_tension at 150 m (kN)", "ufj_angle (deg)"],
        *(TIME, tension(TIME + 1.0, 150.0), 2.0 * np.cos(TIME)),
    )
    code, said, wrong = commands("compare", tmp_path / "run.nc", path, "-o", tmp_path / "both.png")
    assert (code, wrong) == (0, "")
    assert "1 s" in said
    assert "interpolated between 100 and 200 m" in said
    assert (tmp_path / "both.png").stat().st_size > 1e4


def test_a_figure_has_a_panel_for_each_column(table):
    path = table(
        ["time (s)", "effective_tension at 100 m (kN)", "ufj_angle (deg)"],
        *(TIME, tension(TIME, 100.0), TIME),
    )
    figure = comparison(compared(run(), path).pairs, "a run", "other.csv")
    assert [ax.get_title(loc="left") for ax in figure.axes] == [
        "(a) effective tension at 100 m",
        "(b) UFJ angle",
    ]
    assert [ax.get_ylabel() for ax in figure.axes] == ["kN", "deg"]


@pytest.mark.parametrize("seed", range(4))
def test_places_along_the_riser_are_in_the_units_that_are_asked_for(tmp_path, table, commands, seed):
    """The largest difference is added at a place: in feet with kips, else in metres."""
    rng = np.random.default_rng(seed)
    s = np.sort(rng.uniform(0.0, 300.0, 12))
    tension, k = rng.uniform(1e6, 2e6, 12), int(rng.integers(12))
    other = tension - np.where(np.arange(12) == k, 4.4482216e6, 0.0)
    data = {"effective_tension": ("s", tension, {"units": "N"})}
    xr.Dataset(data, {"s": s}, {"title": "a run"}).to_netcdf(tmp_path / "run.nc", engine="netcdf4")
    path, figure = table(["s (m)", "effective_tension (N)"], s, other), tmp_path / "both.png"
    for units, place, size in (("us", f"{s[k] / 0.3048:.4g} ft", "1000"), ("field", f"{s[k]:.4g} m", "4448")):
        code, said, _ = commands("compare", tmp_path / "run.nc", path, "-o", figure, "--units", units)
        assert code == 0
        assert place in said
        assert size in said
    pairs = compared(xr.Dataset(data, {"s": s}), path).pairs
    with reading_in(UnitSystem.US):
        (ax,) = comparison(pairs, "a run", "other.csv").axes
    assert ax.get_xlabel() == "arclength from the bottom (ft)"
    assert ax.lines[0].get_xdata() == pytest.approx(s / 0.3048)


@pytest.mark.parametrize("seed", range(6))
def test_a_station_written_with_few_digits_is_that_station(table, seed):
    """Nodes of a mesh have places such as 165.3165..., which headings round."""
    rng = np.random.default_rng(seed)
    stations = np.sort(rng.uniform(0.0, 300.0, 9))
    swing = np.sin(0.3 * TIME)[:, None] * stations
    data = {"effective_tension": (("time", "s"), swing, {"units": "N"})}
    finer = xr.Dataset(data, {"time": TIME, "s": stations})
    k = int(rng.integers(9))
    path = table(["time (s)", f"effective_tension at {stations[k]:.4f} m (N)"], TIME, swing[:, k])
    (pair,) = compared(finer, path).pairs
    assert pair.notes == []
    assert difference(pair).rms < 1e-9


@pytest.mark.parametrize("seed", range(6))
def test_a_difference_has_the_unit_of_both_series_and_its_share_has_none(seed):
    """Both series in another unit, from another datum, or with the opposite sign."""
    draw = np.random.default_rng(seed)
    theirs = np.cumsum(draw.standard_normal(len(TIME)))
    ours = theirs + 0.3 * draw.standard_normal(len(TIME))
    factor, datum = draw.uniform(2.0, 5.0), draw.normal(0.0, 10.0)

    def of(slope, offset=0.0):
        both = (slope * theirs + offset, slope * ours + offset)
        return difference(Pair("a", "a", "time", "N", TIME, *both, []))

    plain, scaled, moved, turned = of(1.0), of(factor), of(1.0, datum), of(-1.0)
    for one, times in ((scaled, factor), (moved, 1.0), (turned, 1.0)):
        assert one.relative == pytest.approx(plain.relative)
        assert one.rms == pytest.approx(times * plain.rms)
        assert abs(one.largest) == pytest.approx(times * abs(plain.largest))
        assert one.at == plain.at
        assert one.lag == pytest.approx(plain.lag, abs=1e-6)
    assert (turned.peak, turned.low) == (pytest.approx(-plain.low), pytest.approx(-plain.peak))
    # half of the range off everywhere: a share of one half
    shifted = difference(Pair("a", "a", "time", "N", TIME, theirs, theirs + 0.5 * np.ptp(theirs), []))
    assert shifted.relative == pytest.approx(0.5)
