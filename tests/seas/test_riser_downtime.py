"""Hours that a riser's limits leave of a record: its demands are those of runs, and its hours follow them."""

import csv
import json

import numpy as np
import pytest
import xarray as xr
from platform_in_a_sea import RISER, in_a_sea, words

from riserstudy import load_scene, simulate
from riserstudy.dataset.provenance import scene_of_point
from riserstudy.errors import InputError
from riserstudy.scene.pressures import not_in_tension
from riserstudy.seas.hours import sea_limit
from riserstudy.seas.record import write_record
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.synthetic import synthetic
from riserstudy.study.in_sea import Sea, in_sea

LIMITS = [
    {"output": "ufj_angle", "largest": "0.6 deg", "mode": "drilling"},
    {"output": "lfj_angle", "mean": "9 deg", "mode": "drilling"},
    {"output": "effective_tension", "smallest": "2250.5 kN", "mode": "connected"},
]
SEA = in_a_sea(LIMITS, (1, 6, 12, 60), components=30, duration="80 s")


@pytest.fixture(scope="module")
def record():
    """A row in twelve days of two years."""
    return synthetic(2, 8).isel(time=slice(None, None, 293))


@pytest.fixture(scope="module")
def file():
    """A riser under a platform in a sea."""
    return load_scene(RISER).with_values(SEA, "test")


@pytest.fixture(scope="module")
def found(file, record):
    """Its hours, by one seed."""
    return riser_downtime(file, record, seeds=1, error=0.1, cores=1)


def demands(run):
    """Value of each limit, in SI; a smallest tension without the weight of the mud above the ring."""
    mud = not_in_tension(scene_of_point(run, {}))
    rows = json.loads(run.attrs["limits"])
    return [row["demand"] - (mud if row["side"] == "smallest" else 0.0) for row in rows]


@pytest.mark.long
def test_demands_are_those_of_runs_in_these_seas(file, record, found):
    of = found.responses
    assert of.attrs["interval_hours"] == record.attrs["interval_hours"]
    for k in range(0, of.sizes["sea_state"], 7):
        sea = Sea(*(float(of[n][k]) for n in ("significant_wave_height", "peak_period")))
        run = simulate(in_sea(file, sea, 1), progress=False)
        np.testing.assert_allclose(of["demand_of_limit"][k], demands(run), rtol=1e-9)


@pytest.mark.long
def test_hours_are_those_of_a_run_of_every_row(file, record, found):
    """Each row simulated, which nothing is interpolated for."""
    rows = np.column_stack([record[n].values for n in ("significant_wave_height", "peak_period")])
    runs = [demands(simulate(in_sea(file, Sea(*row), 1), progress=False)) for row in rows.tolist()]
    angle, mean, tension = np.array(runs).T
    connected = tension >= 2250.5e3
    drilling = connected & (np.degrees(angle) <= 0.6) & (np.degrees(mean) <= 9.0)
    assert 0.2 < drilling.mean() < 0.98
    for one, true in zip(found.hours.modes, (drilling, connected), strict=True):
        assert one.low <= true.mean() <= one.high
        assert abs(one.hours.share - true.mean()) <= 2 / len(rows)


def test_wider_limits_leave_more_hours_and_limits_on_the_sea_fewer(file, record, found):
    wide = [LIMITS[0] | {"largest": "0.8 deg"}, *LIMITS[1:]]
    wider = riser_downtime(file.with_values({"limits": wide}, "test"), record, seeds=1, error=0.1)
    low = [sea_limit("hs <= 1.5 m")]
    fewer = riser_downtime(file, record, low, seeds=1, error=0.1)
    drilling, more, less = (one.hours.modes[0].hours.share for one in (found, wider, fewer))
    assert less < drilling < more
    sea = float((record["significant_wave_height"] <= 1.5).mean())
    assert less <= sea


def test_rows_without_a_value_of_a_limit_on_the_sea_count_as_neither(file, record, found):
    """Whether they are workable is not known; all other rows count as before."""
    for seed in range(3):
        draw = np.random.default_rng(seed)
        wind = draw.uniform(0.0, 30.0, record.sizes["time"])
        wind[draw.random(len(wind)) < 0.3] = np.nan
        one = record.assign(wind_speed=("time", wind))
        calm = [sea_limit("wind <= 15 m/s")]
        windy = riser_downtime(file, one, calm, seeds=1, error=0.1, cores=1)
        for mode, whole in zip(windy.hours.modes, found.hours.modes, strict=True):
            expected = (whole.hours.workable & (wind <= 15.0))[np.isfinite(wind)]
            np.testing.assert_array_equal(mode.hours.workable, expected)
            assert mode.hours.lacking == np.isnan(wind).sum()
        assert len(windy.demands.time) == len(wind)


def test_what_each_limit_takes_adds_up(found):
    exceeded, alone = (np.array([row[k] for row in found.hours.limits.rows]) for k in (1, 2))
    assert (alone <= exceeded).all()
    lost = 100.0 * (1.0 - found.hours.modes[0].hours.share)
    assert exceeded.max() - 1e-9 <= lost <= exceeded.sum() + 1e-9


@pytest.mark.long
def test_several_seeds_demand_more_than_the_mean_of_their_runs(file, record):
    few = record.isel(time=slice(None, None, 6))
    made = riser_downtime(file, few, seeds=5, error=0.5)
    assert sum("exceed an estimate from 5 seeds on average" in line for line in made.lines) == 1
    found = made.responses
    k = int(found["significant_wave_height"].values.argmax())
    sea = Sea(*(float(found[n][k]) for n in ("significant_wave_height", "peak_period")))
    runs = [demands(simulate(in_sea(file, sea, s), progress=False)) for s in range(1, 6)]
    angle, mean, tension = np.array(runs).T
    demand = found["demand_of_limit"].values[k]
    assert demand[0] > angle.max()  # 147 times as long as a run
    assert demand[2] < tension.min()
    assert demand[1] == pytest.approx(mean.mean(), rel=1e-9)
    assert (found["standard_error"].values[k] > 0.0).all()


@pytest.mark.parametrize(
    "change, told",
    [
        ({"limits": None}, "limits: missing"),
        ({"platform.response": None}, "no irregular sea"),
        ({"analysis.duration": "2 h"}, "analysis.duration: .*a row of the record stands for"),
        ({"analysis.duration": "20 s"}, "analysis.duration"),
    ],
)
def test_what_a_scene_lacks_is_one_error(file, record, change, told):
    hourly = record.assign_attrs(interval_hours=1.0)
    with pytest.raises(InputError, match=told):
        riser_downtime(file.with_values(change, "test"), hourly, seeds=1)


def test_a_record_without_periods_is_refused(file, record):
    with pytest.raises(InputError, match="peak_period: the record has no such column"):
        riser_downtime(file, record.drop_vars("peak_period"), seeds=1)


def test_no_cores_are_refused(file, record):
    with pytest.raises(InputError, match="cores: 0 is not a number of cores; give a whole number from 1"):
        riser_downtime(file, record, seeds=1, cores=0)


def test_the_command_writes_responses_table_and_map(commands, tmp_path, record):
    path = tmp_path / "sea.nc"
    write_record(record, path)
    files = [tmp_path / name for name in ("out.nc", "limits.csv", "map.png")]
    options = [w for pair in zip(("-o", "--csv", "--plot"), files, strict=True) for w in pair]
    asked = ["downtime", path, "--scene", RISER, *words(SEA), "--seeds", "1", "--error", "0.2"]
    code, out, err = commands(*asked, *options)
    assert (code, [file.exists() for file in files]) == (0, [True] * 3), err
    assert "drilling: " in out
    assert "directions of the record are not used" in out
    assert "riserstudy: at least " in err
    with xr.open_dataset(files[0]) as responses:
        assert set(responses["demand_of_limit"].dims) == {"sea_state", "limit"}
    again = commands(*asked)
    assert again[1] == "\n".join(line for line in out.splitlines() if "written" not in line) + "\n"


@pytest.mark.parametrize(
    "more, told",
    [
        (["--scene", RISER, "--seeds", "3"], "--seeds: 3"),
        (["--scene", RISER, "--hold-back", "2"], "--hold-back"),
        ([], "give limits on the sea, or --scene"),
    ],
)
def test_options_that_do_not_fit_are_refused(commands, tmp_path, record, more, told):
    path = tmp_path / "sea.nc"
    write_record(record, path)
    code, _, err = commands("downtime", path, *more)
    assert (code, told in err) == (2, True), err


@pytest.mark.long
def test_what_settings_buy_is_what_each_of_them_has_alone(commands, tmp_path, record):
    path, table = tmp_path / "sea.nc", tmp_path / "hours.csv"
    write_record(record, path)
    own = SEA | {"limits": LIMITS[:1]}
    base = ["downtime", path, "--scene", RISER, *words(own), "--seeds", "1", "--error", "0.2"]
    values = [f"limits[0].largest={angle} deg" for angle in (0.5, 0.6, 0.8)]
    asked = [word for value in values for word in ("--vary", value)]
    code, _, err = commands(*base, *asked, "--csv", table)
    assert code == 0, err
    rows = list(csv.DictReader(table.open()))
    shares = [float(row["workable (%)"]) for row in rows]
    assert [row["setting"] for row in rows] == values
    assert shares == sorted(shares)
    assert shares[0] < shares[-1]
    out = commands(*base, "--set", values[1])[1]
    assert f"drilling: {shares[1]:.2f}% of" in out


@pytest.mark.parametrize("option", ["--vary", "--x-towards"])
def test_options_of_a_riser_need_one(commands, tmp_path, record, option):
    path = tmp_path / "sea.nc"
    write_record(record, path)
    code, _, err = commands("downtime", path, "--limit", "hs <= 2 m", option, "a=1")
    refused = f"{option}: a=1 has no effect with limits on the sea; omit the option, or give --scene"
    assert (code, refused in err) == (2, True), err


def test_the_time_that_is_told_is_that_of_a_run_without_loading(file, record):
    """Told of two runs by the quicker one, which loads nothing; stored runs tell the same."""
    riser = RiserResponse(file, 1, 3600.0, 1)
    states = np.array([[2.1, 9.3], [2.3, 9.7]])
    told = riser.seconds(states)
    assert told > 0.0
    assert riser.seconds(states) == told
    assert told <= min(riser.seconds(states[:1]), riser.seconds(states[1:]))
