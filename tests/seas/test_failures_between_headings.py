"""Sea states half-way between headings whose runs fail are counted, since no band includes their error."""

import math

import numpy as np
import pytest
from test_directions import ALL_ROUND
from test_riser_downtime import RISER, SEA

from riserstudy import load_scene
from riserstudy.seas.directions import Directions
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.synthetic import synthetic


@pytest.mark.parametrize("highest", [math.inf, 3.0, 0.0])
def test_failures_half_way_between_headings_are_counted(monkeypatch, highest):
    """Responses by a formula, of which seas half-way between headings have none above a height."""

    def responses(riser, states):
        found = np.outer(states[:, 0], np.arange(1.0, len(riser.limits) + 1.0))
        half = float(riser.file.tree["platform"]["response"]["heading"].split()[0]) % 90.0
        return np.where((half > 0.0) & (states[:, :1] > highest), math.nan, found)

    monkeypatch.setattr(RiserResponse, "__call__", responses)
    monkeypatch.setattr(RiserResponse, "seconds", lambda *_: math.nan)
    monkeypatch.setattr(RiserResponse, "estimated_errors", lambda riser, of: responses(riser, of) * 0.0)
    response = "platform.response"
    change = {f"{response}.operators": ALL_ROUND, f"{response}.headings": "towards"}
    change[f"{response}.symmetry"] = "sides and ends"
    file = load_scene(RISER).with_values(SEA, "test").with_values(change, "test")
    record = synthetic(2, 8).isel(time=slice(None, None, 100))
    made = riser_downtime(file, record, directions=Directions(4, 0.3), seeds=1, error=0.3)
    of = made.responses
    halves = of["heading"].values % 90.0 > 0.0
    failed = int(np.isnan(of["demand_of_limit"].values[halves]).any(axis=1).sum())
    assert failed == (halves & (of["significant_wave_height"].values > highest)).sum()
    lines = [line for line in made.lines if "have no result, and no band includes their error" in line]
    assert [line.split()[0] for line in lines] == ([str(failed)] if failed else [])
    assert bool(failed) == math.isfinite(highest)
