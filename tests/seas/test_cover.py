"""Responses over the sea states of a record: between simulated ones known to what was requested."""

import numpy as np
import pytest

from riserstudy.errors import InputError, SimulationError
from riserstudy.scene.limits import Limit
from riserstudy.seas.cover import corners, cover
from riserstudy.seas.riser_hours import by_rows, met, response_of, riser_hours
from riserstudy.seas.sea_states import SeaStates, sea_states
from riserstudy.seas.surface import Surface
from riserstudy.seas.synthetic import synthetic
from riserstudy.study.demand_in_sea import check_seeds, demand

LIMITS = [
    Limit(output="ufj_angle", largest="4 rad", mode="drilling"),
    Limit(output="effective_tension", smallest="0 N", mode="connected"),
]
ALLOWED = np.array([limit.allowable for limit in LIMITS])


@pytest.fixture(scope="module")
def record():
    """Three years."""
    return synthetic(3, 5)


def resonant(natural=11.0, damping=0.5):
    """A flex joint's angle that resonates over the period, and a tension that the height takes away."""

    def run(states):
        height, period = states.T
        ratio = natural / period
        amplified = 1.0 / np.sqrt((1.0 - ratio**2) ** 2 + (damping * ratio) ** 2)
        return np.column_stack([1.0 + 0.6 * height * amplified, 500.0 - 70.0 * height])

    return run


@pytest.mark.parametrize("natural", [8.0, 11.0, 15.0])
@pytest.mark.parametrize("error", [0.1, 0.03])
def test_no_hour_of_the_record_is_off_by_more_than_was_requested(record, natural, error):
    of, run = sea_states(record), resonant(natural)
    found = cover(of, run, ALLOWED, error, 500, seed=3)
    true = run(of.states)
    scale = np.array([4.0, np.median(np.abs(found.responses[:, 1]))])
    off = np.abs(found.surface.at(of.states) - true) / np.maximum(scale, np.abs(true))
    assert off.max() <= error
    assert found.error.max() <= error
    assert found.held_out.sum() == 16


def test_a_smaller_error_takes_more_sea_states(record):
    of = sea_states(record)
    counts = [len(cover(of, resonant(), ALLOWED, e, 500).states) for e in (0.2, 0.05, 0.02)]
    assert counts == sorted(set(counts))


def counted(record, of, found):
    """Limits that are met by row, and hours, without what is not known of seeds."""
    response = response_of(of, found, *2 * [np.zeros_like(found.responses)], LIMITS, np.ones((2, 2)))
    every = np.ones(record.sizes["time"], bool)
    known, rows = by_rows([(of, every.astype(float), response)])
    which = met(rows, LIMITS)
    return which, riser_hours(record, known, which, LIMITS, found.error, {}, np.ones_like(known))


def test_hours_are_those_of_the_response_itself_within_their_band(record):
    of, run = sea_states(record), resonant()
    found = cover(of, run, ALLOWED, 0.02, 500)
    which, hours = counted(record, of, found)
    true = run(sea_states(record).states)[of.state_of_row]
    drilling = ((true[:, 0] <= 4.0) & (true[:, 1] >= 0.0)).mean()
    connected = (true[:, 1] >= 0.0).mean()
    for one, share in zip(hours.modes, (drilling, connected), strict=True):
        assert one.low <= share <= one.high
        assert one.hours.share == pytest.approx(share, abs=2e-3)
    assert hours.unknown == 0.0
    assert [row[0] for row in hours.limits.rows] == [
        "drilling: largest ufj_angle",
        "connected: smallest effective_tension",
    ]


def test_beside_runs_that_fail_nothing_is_workable(record):
    of, whole = sea_states(record), resonant()

    def run(states):
        found = whole(states)
        found[states[:, 0] > 6.0] = np.nan
        return found

    found = cover(of, run, ALLOWED, 0.1, 500)
    which, hours = counted(record, of, found)
    high = record["significant_wave_height"].values > 6.0
    assert not which.found[high].any()
    assert hours.unknown >= high.mean()


def board(rows):
    """Sea states over a grid of heights and periods, (9, 9), with the numbers of rows that have them."""
    height, period = np.meshgrid(np.linspace(1.0, 5.0, 9), np.linspace(6.0, 14.0, 9), indexing="ij")
    states = np.column_stack([height.ravel(), period.ravel()])
    return SeaStates(states, rows(*states.T).astype(int), np.arange(len(states)))


def test_runs_that_fail_when_they_are_compared_make_their_surroundings_unknown():
    """The surface is linear, so only the comparison finds the failing ones, most frequent in the record."""

    def fails(height, period):
        return np.hypot(height - 3.5, (period - 9.0) / 2.0) < 0.6

    def run(states):
        return np.where(fails(*states.T)[:, None], np.nan, states[:, :1])

    of = board(lambda *sea: np.where(fails(*sea), 400, 1))
    found = cover(of, run, np.array([1e3]), 0.05, 80)
    assert np.isnan(found.responses).any()
    assert np.isfinite(found.responses[found.held_out]).all()
    assert np.isnan(found.surface.at(of.states[fails(*of.states.T)])).all()


def test_half_of_the_compared_sea_states_are_near_a_limit():
    """The limit is at a height that one row in a thousand has."""
    of = board(lambda height, _: np.where(height > 4.0, 1, 2000))
    found = cover(of, lambda states: states[:, :1], np.array([5.0]), 0.05, 80)
    height = found.states[found.held_out, 0]
    assert len(height) == 16
    assert (np.abs(height - 5.0) <= 0.3 * 5.0).sum() >= 8


@pytest.mark.parametrize("side, allowed", [("largest", 4.0), ("smallest", 0.0)])
def test_units_of_a_response_change_nothing(side, allowed):
    """Errors are relative to the allowable, or the usual response; uncertainties are in its unit."""
    of = board(lambda height, _: np.ceil(9.0 - height))
    found = []
    for unit in (1.0, 1e-3, 2e6):
        limit = Limit(output="effective_tension", **{side: f"{allowed * unit!r} N"}, mode="drilling")
        own = np.array([allowed * unit])
        one = cover(of, lambda states, u=unit: u * resonant()(states)[:, :1], own, 0.03, 80)
        seeds = np.zeros_like(one.responses)
        found.append((one, response_of(of, one, seeds, seeds, [limit], np.ones((2, 1)), 0.01).off / unit))
    (one, off), *others = found
    true = resonant()(of.states)[:, :1]
    assert (np.abs(one.surface.at(of.states) - true) <= off).mean() > 0.95
    for other, changed in others:
        np.testing.assert_array_equal(other.states, one.states)
        np.testing.assert_allclose(other.error, one.error, rtol=1e-3)
        np.testing.assert_allclose(changed, off, rtol=1e-3)


def test_a_response_that_one_run_lacks_leaves_the_others_known():
    of = board(lambda height, _: 1.0 + height)
    responses = np.column_stack([of.states[:, 0], of.states[:, 1]])
    lacking = 4 * 9 + 4
    responses[lacking, 1] = np.nan
    found = Surface(of.states, responses).at(of.states)
    far = np.abs(of.states - of.states[lacking]).max(axis=1) > 1.01
    np.testing.assert_allclose(found[far], of.states[far], rtol=1e-6)
    assert np.isnan(found[lacking, 1])


@pytest.mark.parametrize("seed", range(4))
def test_the_sea_states_of_some_rows_are_those_of_these_rows(seed):
    draw = np.random.default_rng(seed)
    of = board(lambda height, _: np.zeros_like(height))
    state = draw.integers(-1, 12, 60)
    rows = draw.random(60) < 0.4
    others = [70, 3]
    there = of._replace(state_of_row=state).among(rows, others)
    expected = [of.states[k].tolist() for k in sorted({*state[rows & (state >= 0)], *others})]
    assert there.states.tolist() == expected
    for k in range(60):
        if rows[k] and state[k] >= 0:
            assert there.states[there.state_of_row[k]].tolist() == of.states[state[k]].tolist()
        else:
            assert there.state_of_row[k] == -1
    counts = [
        sum(1 for one in state[rows] if one >= 0 and of.states[one].tolist() == each) for each in expected
    ]
    assert there.rows.tolist() == counts


def test_beyond_the_sea_states_that_were_simulated_there_is_no_number():
    square = np.array([[1.0, 5.0], [1.0, 15.0], [4.0, 5.0], [4.0, 15.0], [2.0, 10.0]])
    surface = Surface(square, square)
    inside = np.array([[1.0, 5.0], [4.0, 15.0], [3.0, 7.0]])
    np.testing.assert_allclose(surface.at(inside), inside, rtol=1e-6)
    assert np.isnan(surface.at(np.array([[4.1, 10.0], [2.0, 16.0]]))).all()


@pytest.mark.parametrize("error", [0.1, 0.03])
def test_a_response_and_its_mirror_need_the_same_sea_states(record, error):
    """An allowable of zero has no sign: the size of the responses is what errors are compared with."""
    of, run = sea_states(record), resonant()
    found = cover(of, run, ALLOWED, error, 500)
    mirror = cover(of, lambda states: -run(states), -ALLOWED, error, 500)
    np.testing.assert_array_equal(mirror.states, found.states)
    np.testing.assert_allclose(mirror.error, found.error, rtol=1e-9)
    np.testing.assert_allclose(mirror.responses, -found.responses)


def test_three_sea_states_enclose_a_record_of_three():
    states = np.array([[1.0, 5.0], [4.0, 9.0], [2.0, 12.0]])
    assert sorted(corners(states)) == [0, 1, 2]


def test_too_few_sea_states_and_those_on_a_line_are_refused(record):
    of = sea_states(record)
    with pytest.raises(SimulationError, match="give a larger --error"):
        cover(of, resonant(damping=0.05), ALLOWED, 0.001, 60)
    line = np.column_stack([np.linspace(1.0, 2.0, 9), np.linspace(5.0, 9.0, 9)])
    with pytest.raises(InputError, match="on one line"):
        cover(SeaStates(line, np.ones(9, int), np.arange(9)), resonant(), ALLOWED, 0.1, 60)


@pytest.mark.parametrize("side, sign", [("largest", 1.0), ("smallest", -1.0)])
@pytest.mark.parametrize("runs", [1.0, 6.0])
def test_demand_is_the_fractile_of_the_largest_of_several_runs(side, sign, runs):
    """Against the fractile of drawn extremes: the largest of so many runs, over many hours."""
    draw = np.random.default_rng(2)
    seeds = sign * (10.0 + draw.gumbel(0.0, 1.5, 4000))
    hours = sign * (10.0 + draw.gumbel(0.0, 1.5, (40000, int(runs)))).max(axis=1)
    found = demand(seeds, side, runs)
    assert found.value == pytest.approx(sign * np.quantile(sign * hours, 0.9), rel=0.01)


def test_the_standard_error_is_the_spread_of_demands_from_other_seeds():
    draw = np.random.default_rng(4)
    every = [demand(draw.gumbel(10.0, 1.5, 20), "largest", 6.0) for _ in range(400)]
    spread = np.std([one.value for one in every])
    assert np.mean([one.deviation for one in every]) == pytest.approx(spread, rel=0.1)


def test_means_and_single_seeds_count_as_they_are():
    assert demand(np.array([3.0]), "largest", 6.0).value == 3.0
    assert demand(np.array([1.0, 2.0, 3.0, 4.0, 5.0]), "mean", 6.0).value == 3.0
    assert demand(np.full(5, 2.5), "smallest", 6.0) == (2.5, 0.0, 0.0)
    # squares of deviations from 3 add to 10: a variance of 2.5 for one seed, of 0.5 for the mean of five
    assert demand(np.array([1.0, 2.0, 3.0, 4.0, 5.0]), "mean", 6.0).deviation == pytest.approx(0.5**0.5)
    check_seeds(1)
    with pytest.raises(InputError, match="or 1 to use the extremes"):
        check_seeds(3)


@pytest.mark.parametrize("seed", range(6))
def test_an_interpolation_whose_checks_all_fail_is_not_accepted(seed):
    """Runs that fail wherever the interpolation gives a value leave it unchecked."""
    draw = np.random.default_rng(seed)
    of, done = board(lambda height, _: draw.integers(1, 50, len(height))), []

    def run(states):
        done.append(len(states))
        return resonant()(states) if len(done) == 1 else np.full((len(states), len(ALLOWED)), np.nan)

    try:
        found = cover(of, run, ALLOWED, 1e3, len(of.states), seed)
    except SimulationError:
        return
    held = found.states[found.held_out]
    assert np.isnan(found.surface.at(held)).all()
