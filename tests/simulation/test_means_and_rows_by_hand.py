"""Means over a part of the time and rows of extremes, for drawn histories, by dense sums and loops."""

from types import SimpleNamespace

import numpy as np
import pytest

from riserstudy.simulation import extremes
from riserstudy.simulation.extremes import _along, _over_time, _time_mean


@pytest.mark.parametrize("seed", range(30))
def test_a_mean_begins_at_its_start_between_two_times(seed, monkeypatch):
    """Values are linear in between, on uneven times; two at one time are a jump."""
    draw = np.random.default_rng(seed)
    times = np.cumsum(draw.uniform(0.1, 1.0, 25))
    times[12] = times[11]
    values = draw.normal(size=(25, 3))
    start = float(draw.uniform(times[0], times[-2]))
    monkeypatch.setattr(extremes, "times_of_mean", lambda *_: SimpleNamespace(start=start))
    found = _time_mean(None, "ufj_angle", times, values, by_steps=True)
    total = np.zeros(3)
    for k in range(24):
        low, high = max(times[k], start), times[k + 1]
        if high > low:
            for place in low + (high - low) * np.array([0.25, 0.75]):  # of a line, exact
                share = (place - times[k]) / (times[k + 1] - times[k])
                total += 0.5 * (high - low) * ((1.0 - share) * values[k] + share * values[k + 1])
    assert found == pytest.approx(total / (times[-1] - start))
    monkeypatch.setattr(extremes, "times_of_mean", lambda *_: SimpleNamespace(start=times[-1]))
    assert _time_mean(None, "ufj_angle", times, values, by_steps=True) == pytest.approx(values[-1])


@pytest.mark.parametrize("seed", range(20))
def test_a_row_of_a_section_has_its_largest_and_smallest_value_with_place_and_time(seed, monkeypatch):
    draw = np.random.default_rng(seed)
    monkeypatch.setattr(extremes, "_time_mean", lambda *_: np.array([7.0]))
    s, times = np.cumsum(draw.uniform(1.0, 9.0, 8)), np.arange(30) * 0.5
    history = draw.normal(size=(30, 8))
    seen = {"x_max": history.max(axis=0), "x_min": history.min(axis=0)}
    seen["x_max"][3] += 0.5  # between outputs, so that its time is not known
    arrays = seen | {"x": history, "s_node": s, "time": times}
    low, high = sorted(int(one) for one in draw.choice(9, 2, replace=False))
    row = _along(None, "x", "part", slice(low, high), arrays, {})
    nodes = range(low, high)
    top, bottom = max(nodes, key=lambda k: seen["x_max"][k]), min(nodes, key=lambda k: seen["x_min"][k])
    assert (row["largest"], row["largest_s"]) == (seen["x_max"][top], s[top])
    assert (row["smallest"], row["smallest_s"]) == (seen["x_min"][bottom], s[bottom])
    assert row.get("largest_time") == (None if top == 3 else times[history[:, top].argmax()])
    assert row["smallest_time"] == times[history[:, bottom].argmin()]
    assert row.get("mean") == (7.0 if high - low == 1 else None)
    still = _along(None, "x", "part", slice(low, high), {"x_static": history[0], "s_node": s}, {})
    assert (still["largest"], still["smallest"]) == (history[0, low:high].max(), history[0, low:high].min())
    assert still.get("mean") == (history[0, low] if high - low == 1 else None)


@pytest.mark.parametrize("seed", range(10))
def test_cylinders_share_a_row(seed):
    draw = np.random.default_rng(seed)
    force, times = draw.normal(size=(20, 3)), np.arange(20) * 0.5
    row = _over_time("tensioner_force", {"tensioner_force": force, "time": times})
    at = [max(((force[k, c], times[k]) for k in range(20) for c in range(3)), key=lambda one: sign * one[0])
          for sign in (1.0, -1.0)]  # fmt: skip
    assert [(row["largest"], row["largest_time"]), (row["smallest"], row["smallest_time"])] == at
    still = _over_time("tensioner_force", {"tensioner_force_static": force[0]})
    assert (still["largest"], still["smallest"], still["mean"]) == (
        *(max(force[0]), min(force[0])),
        max(force[0]),
    )
