"""Directions of a record as headings of a scene."""

import math

import numpy as np
import pytest
import xarray as xr
from random_rigs import rig, written
from test_riser_downtime import RISER, SEA, demands

from riserstudy import load_scene, simulate
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.seas.between_headings import states_between
from riserstudy.seas.directions import FROM, Directions, directions_that_count
from riserstudy.seas.heading_parts import headings
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.sea_states import SeaStates
from riserstudy.seas.synthetic import synthetic
from riserstudy.study.in_sea import Sea, heading_paths, in_sea


@pytest.fixture(scope="module")
def record():
    """A row in 24 days of two years."""
    return synthetic(2, 8).isel(time=slice(None, None, 586))


@pytest.fixture(scope="module")
def plain():
    """A riser under a platform in a sea; the platform's operators have no headings."""
    return load_scene(RISER).with_values(SEA, "test")


@pytest.fixture(scope="module")
def file(plain):
    """The same with operators of several headings; a current makes the two sides of the well different."""
    response = "platform.response"
    change = {f"{response}.operators": ALL_ROUND, f"{response}.headings": "towards"}
    return plain.with_values(change | {f"{response}.symmetry": "sides and ends"}, "test")


@pytest.mark.parametrize(
    "x_towards, wave_from, heading",
    [
        (90.0, 270.0, 0.0),  # x to the east, waves from the west: along x
        (90.0, 90.0, 180.0),
        (0.0, 90.0, 90.0),  # x to the north, waves from the east go west, which is y
        (0.0, 270.0, 270.0),
        (45.0, 225.0, 0.0),
        (350.0, 180.0, 350.0),
    ],
)
def test_headings_turn_the_other_way_than_bearings(record, x_towards, wave_from, heading):
    one = record.assign({FROM: ("time", np.full(record.sizes["time"], wave_from))})
    between = Directions(72, math.radians(x_towards)).between(one)
    assert (between.lower * 5.0 + between.share * 5.0) % 360.0 == pytest.approx(heading)


@pytest.mark.parametrize("sectors", [4, 12, 36])
@pytest.mark.parametrize("x_towards", [0.0, 137.3, 350.0])
def test_waves_along_the_headings_are_between_none(record, sectors, x_towards):
    """The sums of angles round, which no row between two headings may come from."""
    count = record.sizes["time"]
    bearings = (x_towards + 180.0 + 360.0 / sectors * np.arange(count)) % 360.0
    found = Directions(sectors, math.radians(x_towards)).between(record.assign({FROM: ("time", bearings)}))
    assert not any(found.inside(k).any() for k in range(sectors))
    np.testing.assert_array_equal(found.lower, -np.arange(count) % sectors)


def test_rows_half_way_between_four_headings_count_half_for_each_and_with_fewer_for_one(record):
    for sectors, parts in ((2, [0.0, 1.0]), (3, [0.0, 0.0, 1.0]), (4, [0.0, 0.0, 0.5, 0.5])):
        away = 360.0 / sectors * np.where(sectors < 4, 0.4, 0.5)
        one = record.assign({FROM: ("time", np.full(record.sizes["time"], 180.0 - away))})
        found = weights(Directions(sectors, 0.0), one)
        np.testing.assert_allclose(np.sort(found, axis=0), np.transpose([parts] * found.shape[1]), atol=1e-9)


@pytest.mark.parametrize("count", [1, 3, 4, 40])
def test_the_compared_sea_states_are_the_highest_and_others_of_the_rows_between(count):
    draw = np.random.default_rng(count)
    states = np.column_stack([draw.permutation(60) / 7.0, draw.uniform(5.0, 15.0, 60)])
    of = SeaStates(states, np.ones(60, int), np.arange(60))
    inside = np.isin(np.arange(60), draw.choice(60, count, replace=False))
    found = states_between(of, inside)
    assert len(np.unique(found, axis=0)) == len(found) == min(4, count)
    assert found[0, 0] == states[inside, 0].max()
    assert {*map(tuple, found)} <= {*map(tuple, states[inside])}


def test_a_heading_of_two_rows_has_the_corners_of_the_record_and_one_of_none_has_no_sea_state(file, record):
    bearings = np.full(record.sizes["time"], 0.0)
    bearings[:2] = 90.0
    one = record.assign({FROM: ("time", bearings)})
    found = headings(file, one, Directions(4, 0.0))
    sizes = {int(heading.of.rows.sum()): heading.of for heading in found}
    assert sorted(sizes) == [0, 2, record.sizes["time"] - 2]
    assert not len(sizes[0].states)
    seas = np.column_stack([one[name].values for name in ("significant_wave_height", "peak_period")])
    assert len(sizes[2].states) > 2
    for side in (np.min, np.max):
        np.testing.assert_allclose(side(sizes[2].states, axis=0), side(seas, axis=0), rtol=1e-12)


def weights(of, record):
    """What each heading counts in each row, (sectors, rows)."""
    between = of.between(record)
    return np.array([between.weight(k, of.sectors) for k in range(of.sectors)])


@pytest.mark.parametrize("seed", range(20))
def test_a_turn_of_the_rig_with_all_directions_changes_nothing(record, seed):
    draw = np.random.default_rng(seed)
    sectors, turn = int(draw.integers(4, 37)), draw.uniform(-720.0, 720.0)
    turned = record.assign({FROM: (record[FROM] + turn) % 360.0})
    plain = weights(Directions(sectors, 0.3), record)
    again = weights(Directions(sectors, 0.3 + math.radians(turn)), turned)
    np.testing.assert_allclose(again, plain, atol=1e-8)
    # turned by some headings, the rig has the same seas so many headings on
    steps = int(draw.integers(-40, 40))
    on = weights(Directions(sectors, 0.3 + steps * 2.0 * math.pi / sectors), record)
    np.testing.assert_allclose(np.roll(plain, steps, axis=0), on, atol=1e-8)


@pytest.mark.parametrize("seed", range(10))
def test_between_headings_a_response_is_straight_round_the_whole_turn(record, seed):
    """Against a wave round the turn: within the error of straight lines, without a step at the first."""
    draw = np.random.default_rng(seed)
    sectors, lobes, phase = (int(draw.integers(4, 37)), int(draw.integers(1, 3)), draw.uniform(0.0, 7.0))
    of = Directions(sectors, draw.uniform(0.0, 7.0))

    def wave(heading):
        return np.cos(lobes * heading - phase)

    bearings = np.linspace(0.0, 360.0, 2001)
    one = xr.Dataset({FROM: ("time", bearings)})
    found = wave(np.array(of.headings)) @ weights(of, one)
    true = wave(of.x_towards - np.radians(bearings) - math.pi)
    width = 2.0 * math.pi / sectors
    assert np.abs(found - true).max() <= (lobes * width) ** 2 / 8.0 + 1e-9
    assert np.abs(np.diff(found)).max() <= lobes * math.radians(0.18) + 1e-9
    assert found[0] == pytest.approx(found[-1])
    np.testing.assert_allclose(weights(of, one).sum(axis=0), 1.0)


def test_of_three_headings_rows_have_the_nearest(record):
    plain = weights(Directions(3, 0.3), record)
    assert set(np.unique(plain)) == {0.0, 1.0}
    assert (plain.sum(axis=0) == 1.0).all()


@pytest.mark.parametrize("sectors", [2, 3])
@pytest.mark.parametrize("seed", range(6))
def test_rows_half_way_between_few_headings_are_shared_equally(sectors, seed):
    """Bearings in whole degrees: turned by some headings, the same rows are so many headings on."""
    draw = np.random.default_rng(seed)
    bearings = np.arange(0.0, 360.0, draw.choice([5.0, 10.0, 30.0]))
    one = xr.Dataset({FROM: ("time", draw.permutation(bearings))})
    x_towards = math.radians(float(draw.choice(bearings)))
    plain = weights(Directions(sectors, x_towards), one)
    assert len(set(plain.sum(axis=1))) == 1
    for steps in (-4, 1, 2, 7):
        on = weights(Directions(sectors, x_towards + steps * 2.0 * math.pi / sectors), one)
        np.testing.assert_array_equal(np.roll(plain, steps, axis=0), on)


@pytest.mark.long
def test_each_row_has_the_response_to_its_own_heading(file, record):
    """Against runs of every row in waves of its heading."""
    of = Directions(2, math.radians(70.0))
    found = riser_downtime(file, record, directions=of, seeds=1, error=0.1)
    scenes, sector = of.scenes(file), of.between(record).lower
    rows = np.column_stack([record[n].values for n in ("significant_wave_height", "peak_period")])
    runs = [
        demands(simulate(in_sea(scenes[k], Sea(*row), 1), progress=False))
        for k, row in zip(sector, rows.tolist(), strict=True)
    ]
    angle, mean, tension = np.array(runs).T
    connected = tension >= 2250.5e3
    drilling = connected & (np.degrees(angle) <= 0.6) & (np.degrees(mean) <= 9.0)
    for one, true in zip(found.hours.modes, (drilling, connected), strict=True):
        assert one.low <= true.mean() <= one.high
        assert abs(one.hours.share - true.mean()) <= 2 / len(rows)
    assert set(np.unique(found.responses["heading"])) == {0.0, 180.0}
    assert "2 headings" in found.lines[0]


ALL_ROUND = [
    {
        "heading": f"{heading} deg",
        "period": f"{period} s",
        "surge": f"{0.4 * abs(math.cos(math.radians(heading))):.6f} m/m",
        "surge_phase": "90 deg",
        "sway": f"{0.4 * abs(math.sin(math.radians(heading))):.6f} m/m",
        "sway_phase": "90 deg",
        "heave": f"{0.3 + 0.1 * abs(math.sin(math.radians(heading))):.6f} m/m",
        "heave_phase": "0 deg",
    }
    for heading in (0, 45, 90)
    for period in (1, 6, 12, 60)
]


@pytest.mark.long
def test_rows_between_headings_have_the_response_to_their_own_direction(file, record):
    """Against a run of every row in waves from its direction, of a platform that heaves more in beam seas."""
    of = Directions(8, math.radians(70.0))
    found = riser_downtime(file, record, directions=of, seeds=1, error=0.1)
    runs = []
    for height, period, bearing in zip(
        *(record[n].values for n in ("significant_wave_height", "peak_period", FROM)), strict=True
    ):
        heading = {"platform.response.heading": f"{(70.0 - bearing - 180.0) % 360.0} deg"}
        sea = in_sea(file.with_values(heading, "test"), Sea(float(height), float(period)), 1)
        runs.append(demands(simulate(sea, progress=False)))
    angle, mean, tension = np.array(runs).T
    connected = tension >= 2250.5e3
    drilling = connected & (np.degrees(angle) <= 0.6) & (np.degrees(mean) <= 9.0)
    for mode, true in zip(found.hours.modes, (drilling, connected), strict=True):
        assert mode.low <= true.mean() <= mode.high
    off = np.abs(found.demands.rows.demand - np.array(runs))
    assert (off <= found.demands.rows.off + 1e-9).mean() > 0.95
    assert any("half-way between headings" in line for line in found.lines)
    turned = record.assign({FROM: (record[FROM] + 211.0) % 360.0})
    again = riser_downtime(file, turned, directions=Directions(8, math.radians(281.0)), seeds=1, error=0.1)
    np.testing.assert_allclose(again.demands.rows.demand, found.demands.rows.demand, rtol=1e-6)


@pytest.mark.long
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
    with pytest.raises(InputError, match=f"{FROM}: the record has no directions"):
        riser_downtime(file, bare, directions=Directions(2, 0.0), seeds=1)


def test_sectors_and_the_bearing_of_x_go_together(commands, tmp_path, record):
    from riserstudy.seas.record import write_record

    write_record(record, tmp_path / "sea.nc")
    for more in (["--sectors", "4"], ["--x-towards", "90 deg"]):
        code, _, err = commands("downtime", tmp_path / "sea.nc", "--scene", RISER, *more)
        assert (code, "--x-towards" in err) == (2, True), err


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("turns", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_sectors_set_the_heading_of_a_response_only_if_its_operators_have_headings(seed, turns, spatial):
    """Rigs on inclined cylinders; without headings, the response is that to waves from any side."""
    tree = written(rig(seed, spatial=spatial))
    sea = {"significant_height": "3 m", "peak_period": "9 s", "peak_enhancement": 2, "seed": 1}
    operators = [
        {"period": f"{period} s", "heave": "0.3 m/m", "heave_phase": "0 deg"} | side
        for side in ([{"heading": f"{k} deg"} for k in (0, 90, 180)] if turns else [{}])
        for period in (5, 12, 20)
    ]
    response = {"operators": operators, "phases": "lead", "beyond": "hold", "ramp": "30 s"}
    response |= {"headings": "towards", "symmetry": "sides"} if turns else {}
    tree["platform"]["response"] = response | {"wave": sea | {"components": 20}}
    tree["analysis"] = {"duration": "60 s", "output": {"interval": "0.5 s"}, "accuracy": "5 %"}
    scenes = Directions(4, 0.0).scenes(SceneFile("rig.yaml", tree))
    found = [one.resolved().platform.response.heading for one in scenes]
    assert found == [pytest.approx(0.5 * math.pi * k) if turns else None for k in range(4)]


def without_headings(seed):
    """A rig on inclined cylinders in a sea; its operators have no headings."""
    tree = written(rig(seed, spatial=bool(seed % 2)))
    sea = {"significant_height": "3 m", "peak_period": "9 s", "peak_enhancement": 2, "seed": 1}
    operators = [{"period": f"{period} s", "heave": "0.3 m/m", "heave_phase": "0 deg"} for period in (5, 20)]
    response = {"operators": operators, "phases": "lead", "beyond": "hold", "ramp": "30 s"}
    tree["platform"]["response"] = response | {"wave": sea | {"components": 20}}
    tree["analysis"] = {"duration": "60 s", "output": {"interval": "0.5 s"}, "accuracy": "5 %"}
    return SceneFile("rig.yaml", tree)


@pytest.mark.parametrize("seed", range(4))
def test_equal_scenes_of_several_headings_are_simulated_once(record, seed):
    of, file = Directions(4, 0.0), without_headings(seed)
    counting = directions_that_count(of, file, record)
    (only,) = headings(file, record, counting)
    assert only.of.rows.sum() == record.sizes["time"]
    with pytest.raises(InputError, match=FROM):
        directions_that_count(of, file, record.drop_vars(FROM))


@pytest.mark.long
def test_equal_scenes_of_several_headings_have_the_hours_of_one(plain, record):
    """The platform's operators have no headings; the summary states that directions are not used."""
    assert not heading_paths(plain)
    once = riser_downtime(plain, record, seeds=1, error=0.3)
    found = riser_downtime(plain, record, directions=Directions(4, 0.3), seeds=1, error=0.3)
    assert found.responses.sizes == once.responses.sizes
    assert found.hours.modes[0].hours.share == once.hours.modes[0].hours.share
    assert "1 seed each" in found.lines[0]
    assert any("operators have no headings" in line for line in found.lines)
