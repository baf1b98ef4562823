"""Hours of a record as a dataset of a study: by the code of the command, part by part, as jobs."""

import os
import sqlite3

import numpy as np
import pytest
import short_study
import xarray as xr
import yaml
from platform_in_a_sea import RISER, in_a_sea
from without_end import KINDS, soon

from riserstudy import load_scene
from riserstudy.errors import InputError
from riserstudy.jobs.workplan import Workplan
from riserstudy.seas.directions import Directions
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.seas_hours import record_of, seas_hours, simulate_part

pytestmark = pytest.mark.long

LIMITS = [
    {"output": "ufj_angle", "largest": "0.6 deg", "mode": "drilling"},
    {"output": "effective_tension", "smallest": "2250.5 kN", "mode": "connected"},
]
SEA = in_a_sea(LIMITS, (1, 6, 12, 60), components=30, duration="80 s")
ROWS = 120  # of the record, that are a few days apart
MODEL = {
    "scene": "scenes/riser.yaml",
    "caption": "hours of a riser at two places",
    "record": "records/sea.csv",
    "set": {path: value for path, value in SEA.items() if path != "limits"},
    "limits": LIMITS,
    "headings": {"sectors": 2, "x_towards": "90 deg"},
    "seeds": 1,
    "error": 0.1,
    "windows": ["147 h", "294 h"],
    "axes": {"offset": {"path": "platform.position.surge", "unit": "m", "values": [0.0, 6.0]}},
}
CONFIG = "papers: [mine]\ntier: standard\ntiers: {preview: {}, standard: {}, reference: {}}\n"


def record(rows=ROWS):
    """Text of a record with seas from two sides."""
    draw = np.random.default_rng(3)
    height = 1.8 * np.exp(0.4 * draw.standard_normal(rows))
    period = 7.2 * height**0.32 * np.exp(0.1 * draw.standard_normal(rows))
    direction = np.where(draw.uniform(size=rows) < 0.7, 270.0, 80.0)
    days = np.datetime64("2001-01-01T00", "h") + 147 * np.arange(rows)
    lines = zip(days, height, period, direction, strict=True)
    text = "".join(f"{day},{h:.3f},{t:.3f},{d:.0f}\n" for day, h, t, d in lines)
    return "time,hs (m),tp (s),wave_from_direction (deg)\n" + text


def lay_out(folder, rows=ROWS, **changes):
    """A configuration with such a dataset alone, of a record of so many rows."""
    for name in ("scenes", "studies", "records"):
        (folder / "config" / name).mkdir(parents=True)
    config = folder / "config"
    (config / "config.yaml").write_text(CONFIG)
    (config / "scenes/riser.yaml").write_text(yaml.safe_dump(load_scene(RISER).tree))
    (config / "records/sea.csv").write_text(record(rows))
    file = {"paper": "mine", "studies": {}, "seas": {"years": MODEL | changes}}
    (config / "studies/mine.yaml").write_text(yaml.safe_dump(file, sort_keys=False))
    return config


def planned(config):
    """The study as a run plans it."""
    return Workplan.read(config, {}).seas("mine", "years")


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """Such a study, none of whose sea states need be stored."""
    return planned(lay_out(tmp_path_factory.mktemp("seas")))


@pytest.fixture(scope="module")
def made(study):
    """Its dataset, after each part was simulated by itself."""
    for number in range(1, len(study.parts.grid) + 1):
        simulate_part(study, number, 1, lambda _: None)
    return seas_hours(study, 1, lambda _: None)


def test_hours_are_those_of_the_command_at_each_setting(study, made):
    directions = Directions(2, np.pi / 2.0)
    for offset in (0.0, 6.0):
        file = load_scene(RISER).with_values(SEA, "test")
        file = file.with_values({"platform.position.surge": f"{offset} m"}, "test")
        alone = riser_downtime(file, record_of(study), directions=directions, seeds=1, error=0.1)
        one = made.sel(offset=offset)
        for mode in alone.hours.modes:
            of = one.sel(riser_mode=mode.mode)
            assert float(of["workable"]) == mode.hours.share
            assert float(of["workable_at_worst"]) == mode.low
            assert float(of["workable_at_best"]) == mode.high
            for hours in (147.0, 294.0):
                wait = dict(mode.hours.of_waits(hours))["all"]
                at = of.sel(window=hours)
                kept = [float(at[f"wait_{name}"]) for name in ("mean", "p50", "p90")]
                np.testing.assert_array_equal(kept, [wait.mean, wait.p50, wait.p90])
        mine = made["offset_of_sea_state"].values == offset
        np.testing.assert_array_equal(
            made["demand_of_limit"].values[mine], alone.responses["demand_of_limit"].values
        )


def test_shares_add_up_over_months_and_limits(made):
    rows = ROWS
    for mode in made["riser_mode"].values:
        of = made.sel(riser_mode=mode)
        counts = np.round(of["workable"].values * rows)
        np.testing.assert_allclose(of["workable"].values, counts / rows, rtol=1e-12)
        assert (of["workable_at_worst"] <= of["workable"]).all()
        assert (of["workable"] <= of["workable_at_best"]).all()
    assert (made["exceeded_alone"] <= made["exceeded"]).all()
    lost = 1.0 - made["workable"].sel(riser_mode="drilling")
    assert (made["exceeded"].max("limit") <= lost + 1e-12).all()
    assert (lost <= made["exceeded"].sum("limit") + 1e-12).all()


def test_the_parts_simulate_all_that_the_dataset_needs(study, made, monkeypatch):
    def refuse(*_, **__):
        raise AssertionError("a run")

    monkeypatch.setattr("riserstudy.simulation.refine.run", refuse)
    again = seas_hours(study, 1, lambda _: None)
    xr.testing.assert_identical(again, made)


@pytest.mark.parametrize(
    "changes, told",
    [
        ({"limits": None, "set": MODEL["set"] | {"limits": None}}, "limits: missing"),
        ({"record": "../sea.csv"}, "record: .*outside the folder of the configuration"),
        ({"record": "records/none.csv"}, "record: .*none.csv"),
        ({"seeds": 3}, "seeds: 3"),
        ({"windows": ["90 min"]}, "not a multiple"),
        ({"windows": ["90 kg"]}, "windows|kg"),
        ({"sea_limits": ["height < 2"]}, "not a limit on a quantity of the sea"),
        ({"sea_limits": ["current <= 1 m/s"]}, "current_speed: the record has no such column"),
        ({"axes": {"heading": {"one": {}}}}, "axes.heading: the heading is also given"),
        ({"set": MODEL["set"] | {"platform.response": None}}, "no irregular sea"),
        ({"axes": {"offset": "readings"}}, "no readings 'offset'"),
        (
            {"set": MODEL["set"] | {"platform.cruise": {"speed": "0.5 m/s"}}},
            "platform.cruise: moves the platform away during the runs in a sea",
        ),
    ],
)
def test_what_cannot_be_meant_is_one_error_before_any_job(tmp_path, changes, told):
    with pytest.raises(InputError, match=told):
        planned(lay_out(tmp_path, **changes))


@pytest.mark.parametrize("kind", KINDS)
def test_only_a_file_is_a_record_and_others_are_not_waited_for(tmp_path, kind):
    record = lay_out(tmp_path) / "records/sea.csv"
    record.unlink()
    KINDS[kind](record)
    with pytest.raises(InputError, match=r"sea\.csv cannot be read: this is not a regular file"):
        soon(lambda: planned(tmp_path / "config").digest)


def test_another_record_or_request_is_another_job(tmp_path):
    config = lay_out(tmp_path)
    digests = {planned(config).digest}
    (config / "records/sea.csv").write_text(record(ROWS - 1))
    digests.add(planned(config).digest)
    text = (config / "studies/mine.yaml").read_text()
    for change in ("error: 0.09", "error: 0.1\n    most: 100"):
        (config / "studies/mine.yaml").write_text(text.replace("error: 0.1", change))
        digests.add(planned(config).digest)
    assert len(digests) == 4


def test_the_workflow_makes_dataset_figure_and_rows_once(tmp_path):
    short_study.lay_out(tmp_path)
    for file in (tmp_path / "config").rglob("*.*"):
        file.unlink()
    for folder in ("scenes", "studies"):
        (tmp_path / "config" / folder).rmdir()
    lay_out(tmp_path, rows=30)

    def made(*targets):
        """Files of the dataset and its parts, and when each was written."""
        status, output = short_study.snakemake(tmp_path, os.environ, *targets)
        assert status == 0, output
        files = [*tmp_path.glob("results/mine/years.seas/*"), *tmp_path.glob("results/mine/*.*")]
        return {file.name: file.stat().st_mtime_ns for file in files if file.is_file()}, output

    first, _ = made()
    assert {f"{k}-of-4" for k in range(1, 5)} <= set(first)
    with xr.open_dataset(tmp_path / "results/mine/years.nc") as dataset:
        assert dataset["workable"].dims == ("offset", "riser_mode")
        shares = dataset["workable"].values
    assert (tmp_path / "results/mine/years_workable_hours.png").exists()
    with sqlite3.connect(tmp_path / "results/results.sqlite") as db:
        kind, table = db.execute("select kind, table_name from studies").fetchone()
        rows = db.execute(f'select workable from "{table}" order by cell').fetchall()
    assert kind == "hours"
    np.testing.assert_array_equal([one for (one,) in rows], shares.ravel())
    assert "years_workable_hours" in (tmp_path / "results/report.html").read_text()
    (tmp_path / "config/records/sea.csv").touch()
    untouched, output = made()
    assert untouched == first, output
    (tmp_path / "results/mine/years.nc").write_bytes(b"damaged")
    again, output = made("results/mine/years.nc")
    assert again["years.nc"] > first["years.nc"], output
    assert all(again[f"{k}-of-4"] == first[f"{k}-of-4"] for k in range(1, 5)), output
