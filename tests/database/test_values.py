"""What the database holds is what the datasets hold, to the last bit."""

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
import workspace
import xarray as xr
from compare import bits, wrong

RESULTS = Path(__file__).parents[2] / "results"


@pytest.fixture
def db(here):
    """The database as any program opens it."""
    with closing(sqlite3.connect(f"file:{workspace.DATABASE}?mode=ro", uri=True)) as db:
        yield db


def test_every_value_of_every_study_is_that_of_its_dataset(db):
    assert [*wrong(db, workspace.RESULTS)] == []
    counts = "select count(*), count(distinct study) from points"
    assert db.execute(counts).fetchone() == (6 + 3 + 4 + 1 + 1 + 48 + 2, 7)


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


@pytest.mark.slow
@pytest.mark.skipif(not (RESULTS / "results.sqlite").exists(), reason="no study was run here")
def test_every_value_of_the_whole_study_is_that_of_its_dataset():
    with closing(sqlite3.connect(f"file:{RESULTS / 'results.sqlite'}?mode=ro", uri=True)) as db:
        assert [*wrong(db, RESULTS)] == []


def test_the_same_point_in_two_studies_has_the_same_extremes_to_the_last_bit(here):
    """Alone, and beside points of other meshes and lengths: at each of its own nodes, and as a whole."""
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
    for name in (*names, *whole):
        found = beside[name]
        if "s_node" in found.dims:
            found = found.sel(s_node=alone["s_node"])  # which are all among the common ones
        assert found.values.tobytes() == alone[name].values.tobytes(), name


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
        ("A1", 0.1, 0.1 + 0.2, 2.0, 0.25, 2, 8, "period", workspace.INJECTION),
        ("A2", None, 0.1 + 0.2, None, 0.25, 2, 8, "period", workspace.INJECTION),
    ]
    assert db.execute("select paper, id, simulation from errata").fetchall() == [
        ("plain", "E1", workspace.INJECTION)
    ]
    asked = "select margin, margin_low, margin_high from numbers_and_claims where id = 'A1'"
    assert db.execute(asked).fetchall() == [(-0.3, -0.5, 0.25)]
    assert dict(db.execute("select place, margin from margins where id = 'A1'")) == {
        "sample=0": 0.25, "sample=1; speed=2.0": -0.5, "sample=2": None
    }  # fmt: skip


def test_figures_and_derived_datasets_say_what_they_read(db):
    figures = "select figure, study, png from figures join figure_reads using (figure)"
    assert db.execute(f"{figures} order by 1").fetchall() == [
        ("odd/fig1", "odd/Order-by_1", "odd/fig1.png"),
        ("plain/one", "plain/swing", "plain/one.png"),
    ]
    reads = db.execute("select study, source from reads order by 2").fetchall()
    assert reads == [("plain/swing", "plain/meshes"), ("plain/swing", "plain/surge")]
