"""Rows of watch circles for a way that is known, and the way of a cruise by integration of its speed."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import quad

from riserstudy import load_scene
from riserstudy.design.watch_circles_of_run import COARSE, LEAST, Times, Way, _row, way_of

SCENE = Path(__file__).parents[2] / "config/scenes/design/riser.yaml"


@pytest.mark.parametrize("seed", range(40))
def test_circles_are_the_offsets_at_which_alarms_leave_enough_time(seed):
    draw = np.random.default_rng(seed)
    start, speed, unsure = draw.uniform(0.0, 3.0), draw.uniform(0.05, 0.5), draw.choice([0.0, 0.4])
    way = Way(lambda t: start + speed * t, lambda _: unsure)
    first, late = draw.uniform(10.0, 200.0), draw.choice([0.0, draw.uniform(0.1, 20.0)])
    times = Times(draw.uniform(5.0, 60.0), draw.uniform(5.0, 60.0))
    name, when, offset, red, yellow, note = _row("limit", first, late, way, times, "remark")
    assert (name, when, offset) == ("limit", first, pytest.approx(start + speed * first))
    doubts = []
    for colour, found, before in (("red", red, times[0]), ("yellow", yellow, sum(times))):
        left = first - before
        late_words = f"{colour}: an alarm at the start is too late"
        assert (late_words in note) == (left <= 0.0) == (found is None)
        if left > 0.0:
            assert found == pytest.approx(start + speed * left)
            doubts.append(unsure + speed * min(late, left))
            if doubts[-1] <= max(COARSE * found, LEAST):
                doubts.pop()
    said = re.search(r"may be (\S+) m too large", note)
    assert note.startswith("remark")
    assert (float(said[1]) if said else 0.0) == pytest.approx(max(doubts, default=0.0), rel=0.06)
    assert _row("limit", math.inf, 0.0, way, times)[1:] == [None] * 4 + ["not reached within the run"]


@pytest.mark.parametrize("seed", range(20))
def test_the_way_of_a_cruise_is_the_integral_of_its_speed(seed):
    """It begins at the position of the platform, and its speed increases linearly over its ramp."""
    draw = np.random.default_rng(seed)
    speed, ramp, heading = draw.uniform(0.1, 1.0), draw.choice([0.0, 30.0]), draw.uniform(-3.0, 3.0)
    at = draw.uniform(-20.0, 20.0, 2)
    cruise = {"speed": f"{float(speed)!r} m/s", "heading": f"{float(heading)!r} rad"} | (
        {"ramp": "30 s"} if ramp else {}
    )
    position = {"surge": f"{float(at[0])!r} m", "sway": f"{float(at[1])!r} m"}
    values = {"platform": {"cruise": cruise, "position": position}, "top.x": "platform"}
    scene = load_scene(SCENE).with_values(values, "test").resolved()
    way = way_of(scene, xr.Dataset(coords={"time": np.linspace(0.0, 100.0, 11)}))
    for t in draw.uniform(0.0, 100.0, 8):
        gone = quad(lambda one: speed * (min(one / ramp, 1.0) if ramp else 1.0), 0.0, t, points=[30.0])[0]
        place = [scene.top.offset or 0.0, 0.0] + at + gone * np.array([math.cos(heading), math.sin(heading)])
        assert way.at(t) == pytest.approx(math.hypot(*place))
        assert way.error(t) == 0.0
    assert way.at(500.0) == way.at(100.0)  # of the run, nothing later is known
