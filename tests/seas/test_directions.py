"""Directions of a record as headings of a scene."""

import math

import numpy as np
import pytest
from test_riser_downtime import RISER, SEA, demands

from riserstudy import load_scene, simulate
from riserstudy.errors import InputError
from riserstudy.seas.directions import FROM, Directions
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.synthetic import synthetic
from riserstudy.study.in_sea import Sea, in_sea


@pytest.fixture(scope="module")
def record():
    """A row in twelve days of two years."""
    return synthetic(2, 8).isel(time=slice(None, None, 293))


@pytest.fixture(scope="module")
def file():
    """A riser under a platform in a sea, in a current that makes the two sides of the well different."""
    return load_scene(RISER).with_values(SEA, "test")


@pytest.mark.parametrize(
    "x_towards, wave_from, heading",
    [
        (90.0, 270.0, 0.0),  # x to the east, waves from the west: along x
        (90.0, 90.0, 180.0),
        (0.0, 90.0, 90.0),  # x to the north, waves from the east go west, which is y
        (0.0, 270.0, 270.0),
        (45.0, 225.0, 0.0),
        (350.0, 180.0, 0.0),  # to the nearest of eight
    ],
)
def test_headings_turn_the_other_way_than_bearings(record, x_towards, wave_from, heading):
    one = record.assign({FROM: ("time", np.full(record.sizes["time"], wave_from))})
    of = Directions(8, math.radians(x_towards))
    sector = of.sector_of(one)
    assert np.degrees(np.array(of.headings)[sector]) == pytest.approx(heading)


def test_a_turn_of_the_rig_with_all_directions_changes_nothing(record):
    for turn in (-200.0, 33.0, 360.0):
        turned = record.assign({FROM: (record[FROM] + turn) % 360.0})
        plain = Directions(12, 0.3).sector_of(record)
        again = Directions(12, 0.3 + math.radians(turn)).sector_of(turned)
        assert (plain == again).mean() > 0.99  # but for those between two sectors


def test_each_row_has_the_response_to_its_own_heading(file, record):
    """Against runs of every row in waves of its heading."""
    of = Directions(2, math.radians(70.0))
    found = riser_downtime(file, record, directions=of, seeds=1, error=0.1)
    scenes, sector = of.scenes(file), of.sector_of(record)
    rows = np.column_stack([record[n].values for n in ("significant_wave_height", "peak_period")])
    runs = [
        demands(simulate(in_sea(scenes[k], Sea(*row), 1), progress=False))
        for k, row in zip(sector, rows.tolist(), strict=True)
    ]
    angle, mean, tension = np.array(runs).T
    connected = tension >= 2285e3
    drilling = connected & (np.degrees(angle) <= 0.6) & (np.degrees(mean) <= 9.0)
    for one, true in zip(found.hours.modes, (drilling, connected), strict=True):
        assert one.low <= true.mean() <= one.high
        assert abs(one.hours.share - true.mean()) <= 2 / len(rows)
    assert set(np.unique(found.responses["heading"])) == {0.0, 180.0}
    assert "2 headings" in found.lines[0]


def test_a_row_without_a_direction_counts_as_neither(file, record):
    values = record[FROM].values.copy()
    values[::5] = np.nan
    one = record.assign({FROM: ("time", values)})
    found = riser_downtime(file, one, directions=Directions(2, 0.0), seeds=1, error=0.3)
    hours = found.hours.modes[0].hours
    assert hours.rows == np.isfinite(values).sum()
    assert hours.lacking == np.isnan(values).sum()


def test_a_record_without_directions_is_refused(file, record):
    bare = record.drop_vars(FROM)
    with pytest.raises(InputError, match=f"{FROM}: not in the record"):
        riser_downtime(file, bare, directions=Directions(2, 0.0), seeds=1)


def test_sectors_and_the_bearing_of_x_go_together(commands, tmp_path, record):
    from riserstudy.seas.record import write_record

    write_record(record, tmp_path / "sea.nc")
    for more in (["--sectors", "4"], ["--x-towards", "90 deg"]):
        code, _, err = commands("downtime", tmp_path / "sea.nc", "--scene", RISER, *more)
        assert (code, "--x-towards" in err) == (2, True), err
