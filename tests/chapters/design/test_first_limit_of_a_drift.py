"""Offset of the first limit of a vessel that drifts from the well, for limits met between any two offsets."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from chapters.design.derived import watch_circles
from chapters.design.figures.watch_circles import _answer
from riserstudy.design import operability
from riserstudy.design.operability import Offsets
from riserstudy.design.watch_circles import CIRCLE, NEVER, TOO_LATE, UNKNOWN

HULL = {"mass": "5e7 kg", "drag": "1e-3 N*s^2/m^2", "force": "2 MN"}


def circles_of(found, monkeypatch):
    """Watch circles of a vessel that drifts from a well whose limits are met between these offsets."""
    scene = SimpleNamespace(limits=[], replaced=lambda **update: update)
    monkeypatch.setattr(watch_circles, "scenes_of", lambda _: iter([({"surface_speed": 0.0}, scene)]))
    monkeypatch.setattr(operability, "offsets", lambda *_: found)
    rests = xr.Dataset({"point_key": ("surface_speed", ["k"])}, {"surface_speed": [0.0]})
    made = watch_circles.watch_circles(rests, "200 m", {}, ["30 s"], "90 s", **HULL)
    return made.isel(surface_speed=0, eds_time=0)


@pytest.mark.parametrize("seed", range(60))
def test_the_first_limit_is_where_a_walk_from_the_well_leaves_one(seed, monkeypatch):
    """The walk goes down current by centimetres and asks each limit whether it is met there."""
    draw = np.random.default_rng(seed)
    found = []
    for _ in range(draw.integers(1, 5)):
        low, high = np.sort(draw.uniform(-90.0, 150.0, 2))
        if draw.random() < 0.6:
            low, high = -abs(low), abs(high)
        if draw.random() < 0.1:
            low = high = np.nan  # exceeded at every offset
        found.append(Offsets(low, high))
    walk = np.arange(0.0, 200.0, 0.01)
    met = np.array([(one.low <= walk) & (walk <= one.high) for one in found]).all(axis=0)
    reached = walk[np.flatnonzero(~met)[0]]
    circles = circles_of(found, monkeypatch)
    assert float(circles["limit_offset"]) == pytest.approx(reached, abs=0.011)
    assert int(circles["red_circle_outcome"]) == (
        TOO_LATE if reached < 18.0 else CIRCLE
    )  # F t^2 / 2 M in 30 s


def test_a_limit_that_is_not_evaluated_leaves_circles_unknown(monkeypatch):
    found = [Offsets(-50.0, 60.0), Offsets(np.nan, np.nan, "a static equilibrium")]
    circles = circles_of(found, monkeypatch)
    assert np.isnan(circles["limit_offset"])
    assert int(circles["red_circle_outcome"]) == UNKNOWN


@pytest.mark.parametrize("seed", range(60))
def test_the_title_on_alarms_holds_in_all_currents_and_muds(seed):
    draw = np.random.default_rng(seed)
    speeds, muds = np.linspace(0.0, 1.6, 5), [1100.0, 1800.0]
    kinds = {0: [CIRCLE], 1: [CIRCLE, NEVER], 2: [NEVER], 3: [CIRCLE, UNKNOWN], 4: [CIRCLE, TOO_LATE]}[
        seed % 5
    ]
    over = ("surface_speed", "mud_weight", "eds_time")
    red = draw.choice(kinds, (5, 2, 1))
    radius = np.where(red == CIRCLE, draw.uniform(5.0, 99.0, red.shape), 0.0)
    radius = np.where(red == NEVER, 3000.0, np.where(red == UNKNOWN, np.nan, radius))
    of = xr.Dataset(
        {
            "red_circle_outcome": (over, red),
            "red_circle_radius": (over, radius),
            "yellow_circle_outcome": (over, np.where(red == TOO_LATE, CIRCLE, red)),
        },
        {"surface_speed": speeds, "mud_weight": muds, "eds_time": [60.0]},
    )
    said = _answer(of)
    late = (red == TOO_LATE).any(axis=(1, 2))
    if late.any():
        first = speeds[late].min()
        assert f"{first:g} m/s" in said
        assert (" from " in said) == bool(late[speeds >= first].all())
    elif (red[-1] == UNKNOWN).any():
        assert said.endswith("is not known")
    elif (red[-1] == NEVER).all():
        assert "no limit" in said
    else:
        assert f"within {radius[-1][red[-1] == CIRCLE].min():.0f} m at 1.6 m/s" in said
