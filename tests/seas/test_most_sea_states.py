"""The largest number of sea states is never exceeded, and too small a number is refused before any run."""

import numpy as np
import pytest
from platform_in_a_sea import RISER, in_a_sea

from riserstudy import load_scene
from riserstudy.errors import InputError, SimulationError
from riserstudy.seas.cover import cover, least
from riserstudy.seas.directions import FROM, Directions, directions_that_count
from riserstudy.seas.heading_parts import headings
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.sea_states import sea_states
from riserstudy.seas.synthetic import synthetic


def drawn(seed):
    """A record, with from one row in two weeks to all rows of a year."""
    draw = np.random.default_rng(seed)
    return synthetic(1, seed).isel(time=slice(None, None, int(draw.choice([1, 7, 40, 330]))))


def resonant(natural, simulated):
    def run(states):
        simulated.extend(map(tuple, states.tolist()))
        height, period = states.T
        return (0.6 * height / np.sqrt((1.0 - (natural / period) ** 2) ** 2 + (0.3 * natural / period) ** 2))[
            :, None
        ]

    return run


@pytest.mark.parametrize("seed", range(24))
def test_no_more_sea_states_are_simulated_than_are_allowed(seed):
    draw = np.random.default_rng(seed)
    of, natural = sea_states(drawn(seed)), draw.uniform(6.0, 15.0)
    error, allowed = float(draw.choice([0.5, 0.1, 0.02])), np.array([4.0])
    simulated = []
    needed = len(cover(of, resonant(natural, simulated), allowed, error, 10**6).states)
    assert needed == len(simulated) == len({*simulated})
    fewest = least(of)
    assert fewest <= needed
    for most in sorted({fewest - 1, fewest, (fewest + needed) // 2, needed - 1, needed, needed + 5}):
        simulated = []
        refused = InputError if most < fewest else SimulationError
        if most >= needed:
            assert len(cover(of, resonant(natural, simulated), allowed, error, most).states) == needed
        else:
            with pytest.raises(refused, match=str(most)):
                cover(of, resonant(natural, simulated), allowed, error, most)
            assert not (simulated and most < fewest)
        assert len(simulated) <= most


@pytest.mark.parametrize("sectors", [None, 2, 5])
def test_too_few_for_any_heading_are_refused_before_the_first_run(monkeypatch, sectors):
    limits = [{"output": "ufj_angle", "largest": "0.6 deg", "mode": "drilling"}]
    file = load_scene(RISER).with_values(
        in_a_sea(limits, (1, 6, 12, 60), components=30, duration="80 s"), "test"
    )
    record = drawn(1)
    directions = Directions(sectors, 0.0) if sectors else None
    if sectors:
        angle = np.random.default_rng(sectors).uniform(0.0, 360.0, record.sizes["time"])
        record = record.assign({FROM: ("time", angle, {"units": "deg"})})
    directions = directions and directions_that_count(directions, file, record)
    needed = [least(one.of) for one in headings(file, record, directions) if one.of.rows.any()]

    def run(*_):
        raise AssertionError("simulated")

    monkeypatch.setattr("riserstudy.seas.riser_response.RiserResponse.__call__", run)
    most = max(needed) - 1
    with pytest.raises(
        InputError,
        match=f"--most: {most}: the record requires the simulation of at least {most + 1} sea states",
    ):
        riser_downtime(file, record, directions=directions, most=most, seeds=1)
    with pytest.raises(AssertionError, match="simulated"):
        riser_downtime(file, record, directions=directions, most=most + 1, seeds=1)
