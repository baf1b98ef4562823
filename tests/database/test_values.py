"""What the database holds is what the datasets hold, to the last bit."""

import json
import sqlite3
from contextlib import closing
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import workspace
import xarray as xr
from compare import bits, wrong

from riserstudy import simulate
from riserstudy.database import wide_table, write_study
from riserstudy.database.build import build
from riserstudy.database.sources import Sources
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.files.cache import cache_folder
from riserstudy.scene.load import SceneFile
from riserstudy.study import store
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

CONFIG = Path(__file__).parents[2] / "config"
RESULTS = CONFIG.parent / "results"


@pytest.fixture
def db(here):
    """The database as any program opens it."""
    with closing(sqlite3.connect(f"file:{workspace.DATABASE}?mode=ro", uri=True)) as db:
        yield db


@pytest.mark.long
def test_every_value_of_every_study_is_that_of_its_dataset(db):
    assert [*wrong(db, workspace.RESULTS)] == []
    counts = "select count(*), count(distinct study) from points"
    assert db.execute(counts).fetchone() == (6 + 3 + 4 + 1 + 1 + 48 + 2, 7)


@pytest.mark.long
@pytest.mark.parametrize(
    "spoil",
    [
        "update result_values set value = value * (1 + 3e-16) where value > 1",
        "update result_values set s = s + 1 where s is not null",
        "delete from result_values where point = 5",
        "update points set wall_seconds = 1.0 where point = 1",
        "update plain_surge set period = period + 1e-14",
        'update "plain_swing_over_naïve axis" set largest = 1.0',
        "update columns set unit = 'kN' where column_name = 'swing'",
        "delete from plain_surge where amplitude = 1 and period = 9",
    ],
)
def test_the_comparison_sees_what_is_not_the_same(mine, spoil):
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        assert db.execute(spoil).rowcount > 0
        assert next(wrong(db, workspace.RESULTS), None) is not None


@pytest.mark.long
@pytest.mark.parametrize("many", [1, 7, 60, 1000])
def test_values_that_are_written_in_several_parts_are_those_of_their_datasets(mine, monkeypatch, many):
    """Few rows in memory at a time, as of a study with many points."""
    monkeypatch.setattr(write_study, "MANY", many)
    monkeypatch.setattr(wide_table, "MANY", many)
    workspace.DATABASE.unlink()
    workspace.built()
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        assert [*wrong(db, workspace.RESULTS)] == []


@pytest.mark.parametrize("seed", range(4))
def test_variables_with_their_axes_in_another_order_have_their_values_in_the_right_rows(mine, seed):
    """As a function of a chapter may return them: each over the same axes, or over some of them."""
    draw = np.random.default_rng(seed)
    sizes = {"a": 2, "b": 3, "c": 4}
    made = xr.Dataset(coords={axis: np.sort(draw.random(n)) for axis, n in sizes.items()})
    for k in range(5):
        axes = draw.permutation([*sizes]).tolist()[: 3 if k < 3 else int(draw.integers(1, 4))]
        made[f"value_{k}"] = (axes, draw.normal(size=[sizes[axis] for axis in axes]))
    write_dataset(made, workspace.RESULTS / "plain/swing.nc")
    workspace.built()
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        assert [*wrong(db, workspace.RESULTS)] == []
        assert db.execute("select count(*) from plain_swing").fetchone() == (24,)


@pytest.mark.slow
@pytest.mark.skipif(not (RESULTS / "results.sqlite").exists(), reason="no study was run here")
def test_every_value_of_the_whole_study_is_that_of_its_dataset():
    with closing(sqlite3.connect(f"file:{RESULTS / 'results.sqlite'}?mode=ro", uri=True)) as db:
        assert [*wrong(db, RESULTS)] == []


def test_the_same_point_in_two_studies_has_the_same_extremes_to_the_last_bit(here):
    """Alone, and beside points of other meshes and lengths: at own nodes that are common, and as a whole."""
    with (
        xr.open_dataset(workspace.RESULTS / "plain/one.nc", decode_times=False) as one,
        xr.open_dataset(workspace.RESULTS / "plain/meshes.nc", decode_times=False) as many,
    ):
        alone, beside = one.load(), many.load().sel(mesh="coarse")
    assert alone["point_key"].item() == beside["point_key"].item()
    assert beside.sizes["s_node"] > alone.sizes["s_node"]
    names = [str(n) for n in alone.data_vars if str(n).endswith(("_max", "_min", "_absmax"))]
    assert {"x_max", "bending_moment_absmax", "effective_tension_min"} <= {*names}
    whole = ("smallest_tension", "largest_bending_moment", "largest_bending_moment_s")
    both = np.intersect1d(alone["s_node"], beside["s_node"])
    assert {0.0, float(alone["s_node"].max())} <= {*both.tolist()}  # the ends of its riser at the least
    for name in (*names, *whole):
        found, own = beside[name], alone[name]
        if "s_node" in found.dims:
            found, own = found.sel(s_node=both), own.sel(s_node=both)
        assert found.values.tobytes() == own.values.tobytes(), name


EVERY = "select quantity, statistic, unit, value, s from results join points using (point)"
SHARED = """
with shared as (select key, study, quantity, statistic, unit, value, s from points join results using (point)
                where key in (select key from points group by key having count(distinct study) > 1))
select a.study, b.study, key, quantity, statistic, a.value, b.value, a.s, b.s
from shared a join shared b using (key, quantity, statistic, unit)
where a.study < b.study"""
OTHER = " and (a.value is not b.value or a.s is not b.s)"


def test_so_it_has_in_the_database_where_common_nodes_have_other_ones(db, here):
    shared = db.execute(SHARED).fetchall()
    assert len(shared) > 20
    assert db.execute(SHARED + OTHER).fetchall() == []
    with xr.open_dataset(workspace.RESULTS / "plain/meshes.nc", decode_times=False) as many:
        beside = many.sel(mesh="coarse").load()
    laid = {name: float(beside[name].max()) for name in ("x_max", "bending_moment_max")}
    asked = f"{EVERY} where study = 'plain/one' and statistic = 'max'"
    own = {f"{quantity}_max": value for quantity, _, _, value, _ in db.execute(asked)}
    assert any(own[name] < value for name, value in laid.items())  # or nothing was to be told


def test_a_study_that_keeps_histories_alone_tells_the_extremes_of_every_step(db, here):
    key = db.execute("select key from points where study = 'plain/sampled' limit 1").fetchone()[0]
    about = store.about(key)
    run = simulate(SceneFile(about["source"], about["scene"]))
    asked = f"{EVERY} where key = ? and quantity = 'x' and statistic in ('max', 'min')"
    found = {row[1]: row[3:] for row in db.execute(asked, (key,))}
    for end, largest in (("max", run["x_max"].max()), ("min", run["x_min"].min())):
        assert bits(found[end][0]) == bits(float(largest))
    assert float(run["x"].min()) > found["min"][0]  # x_min is not kept


def test_the_same_point_in_two_real_studies_has_the_same_statistics(tmp_path, monkeypatch):
    """One beside risers of other lengths, and beside risers of the same length."""
    (tmp_path / ".cache").mkdir()
    (tmp_path / ".cache/numba").symlink_to(cache_folder() / "numba")
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path / ".cache"))
    monkeypatch.chdir(CONFIG.parent)  # where its scenes are
    results, paper = tmp_path / "results", "mao_hangoff"
    file = read_studies(CONFIG, paper)
    for name in ("lmrp_mass_equal", "riser_length_equal"):
        study = Study(paper, name, file.studies[name], CONFIG, "preview", "1 %", file.readings)
        made = dataset_of(study, results_of(study, 1, lambda _: None)[0])
        write_dataset(made, results / f"{paper}/{name}.nc")
    files = sorted(results.glob("*/*.nc"))
    build(results / "real.sqlite", Sources(CONFIG, [paper], files))
    with closing(sqlite3.connect(results / "real.sqlite")) as db:
        assert [*wrong(db, results)] == []
        shared = db.execute(SHARED).fetchall()
        assert {row[3:5] for row in shared} >= {("x", "max"), ("bending_moment", "min")}
        assert db.execute(SHARED + OTHER).fetchall() == []


@pytest.mark.slow
@pytest.mark.skipif(not (RESULTS / "results.sqlite").exists(), reason="no study was run here")
def test_so_has_every_point_that_two_studies_of_the_whole_share():
    with closing(sqlite3.connect(f"file:{RESULTS / 'results.sqlite'}?mode=ro", uri=True)) as db:
        assert db.execute(SHARED + OTHER).fetchall() == []


def test_parameters_are_those_of_the_scene_with_what_axes_set_on_top(db):
    asked = (
        "select place, value, unit, as_written, origin from points join parameters using (point)"
        " where study = 'plain/surge' and path = ? order by position"
    )
    found = db.execute(asked, ("platform.surge.amplitude",)).fetchall()
    assert [row[1:] for row in found] == [
        (amplitude, "m", f"{amplitude} m", "varied") for amplitude in (1.0, 2.5) for _ in range(3)
    ]
    assert found[4][0] == "amplitude=2.5, period=12.0"
    (tension,) = {row[1:] for row in db.execute(asked, ("top.tension",))}
    assert tension == (2275e3, "N", "2275 kN", "given")
    asked = "select as_written, origin, because from parameters where path = ? and point = ?"
    asked += " and origin <> 'varied'"
    point = db.execute("select point from points where study = 'plain/one'").fetchone()[0]
    assumed = ("2 m", "assumed", workspace.INJECTION)
    assert db.execute(asked, ("platform.surge.amplitude", point)).fetchall() == [assumed]
    derived = ("15 s", "derived", "it's printed")
    assert db.execute(asked, ("platform.surge.period", point)).fetchall() == [derived]


def test_what_samples_assume_stands_beside_their_results(db):
    columns = "select column_name, unit, long_name from columns where role = 'assumed'"
    assert db.execute(columns).fetchall() == [
        ("assumed_platform_surge_amplitude", "m", "platform.surge.amplitude")
    ]
    asked = "select point, assumed_platform_surge_amplitude from plain_sampled"
    scene = "select value from parameters where point = ? and path = 'platform.surge.amplitude'"
    for point, assumed in db.execute(asked).fetchall():
        assert bits(db.execute(scene, (point,)).fetchone()[0]) == bits(assumed)
        assert 1.0 <= assumed <= 3.0


@pytest.mark.parametrize("accuracy", ["0.5 %", "2 %"])
def test_a_tuned_study_has_the_tolerance_that_its_settings_meet(mine, accuracy):
    """Its points have a mesh and a step in place of the tolerance."""
    with netCDF4.Dataset(workspace.RESULTS / "plain/surge.nc", "a") as file:
        assert "accuracy" not in json.loads(file.getncattr("scene"))["analysis"]
        file.setncattr("settings", json.dumps({"setting": {"elements": 8}, "accuracy": accuracy}))
    workspace.built()
    asked = "select study, accuracy from studies where study in ('plain/surge', 'plain/meshes')"
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        assert dict(db.execute(asked)) == {"plain/surge": accuracy, "plain/meshes": None}


def test_effects_say_which_are_on_and_why(db):
    asked = "select effect, is_on, because from effects join points using (point)"
    asked += " where study = 'plain/surge' and position = 0"
    found = {effect: (on, why) for effect, on, why in db.execute(asked)}
    with xr.open_dataset(workspace.RESULTS / "plain/surge.nc", decode_times=False) as dataset:
        named = dataset["effects"].values[0, 0].splitlines()
    assert {effect for effect, (on, _) in found.items() if on} == {*named}
    assert len(found) > len(named)
    assert all(why for _, why in found.values())


def test_numbers_and_claims_and_errata_are_those_of_the_tables(db):
    asked = "select id, published, simulated, error, share, met, samples, decided_by, statement"
    assert db.execute(f"{asked} from numbers_and_claims order by id").fetchall() == [
        ("A1", 0.1, 0.1 + 0.2, 2.0, 0.25, 2, 8, "period; in s: 9. Or 12", workspace.INJECTION),
        ("A2", None, 0.1 + 0.2, None, 0.25, 2, 8, "period; in s: 9. Or 12", workspace.INJECTION),
    ]
    assert db.execute("select paper, id, simulation from errata").fetchall() == [
        ("plain", "E1", workspace.INJECTION)
    ]
    asked = "select margin, margin_low, margin_high from numbers_and_claims where id = 'A1'"
    assert db.execute(asked).fetchall() == [(-0.3, -0.5, 0.25)]
    assert dict(db.execute("select place, margin from margins where id = 'A1'")) == {
        '{"sample": 0}': 0.25, '{"sample": 1, "line": "a; b"}': -0.5, "{}": None
    }  # fmt: skip


def test_figures_and_derived_datasets_say_what_they_read(db):
    figures = "select figure, study, png from figures join figure_reads using (figure)"
    assert db.execute(f"{figures} order by 1").fetchall() == [
        ("odd/fig1", "odd/Order-by_1", "odd/fig1.png"),
        ("plain/one", "plain/swing", "plain/one.png"),
    ]
    reads = db.execute("select study, source from reads order by 2").fetchall()
    assert reads == [("plain/swing", "plain/meshes"), ("plain/swing", "plain/surge")]
