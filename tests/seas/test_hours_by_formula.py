"""From a table with gaps to hours of a riser, whose response to height, period and direction is a formula."""

import math

import numpy as np
import pytest
from test_directions import ALL_ROUND
from test_record_traps import written
from test_riser_downtime import RISER, SEA

from riserstudy import load_scene
from riserstudy.seas.directions import Directions
from riserstudy.seas.hours import sea_limit
from riserstudy.seas.record import read_record
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.synthetic import lasting, synthetic

TURN = {"platform.response.operators": ALL_ROUND, "platform.response.headings": "towards"}
TURN["platform.response.symmetry"] = "sides and ends"


def responses(height, period, heading):
    """Demands of the limits of the scene (rad, rad, N): a resonance, larger from one side."""
    base = height * (1.0 + 0.3 * np.cos(heading - 0.7)) * (1.0 + 0.8 * np.exp(-(((period - 9.0) / 3.0) ** 2)))
    return np.column_stack([0.003 * base, 0.09 * base**0.8, 2.3e6 - 1.2e4 * base])


def columns_of(draw):
    """A table of a year with calm rows and empty cells, by heading."""
    record = synthetic(1, int(draw.integers(99)))
    names = {"significant_wave_height": "hs (m)", "peak_period": "tp (s)", "wave_from_direction": "mwd (deg)"}
    columns = {head: record[name].values.copy() for name, head in names.items()}
    count = record.sizes["time"]
    columns["mwd (deg)"] = (columns["mwd (deg)"] + draw.uniform(0.0, 360.0)) % 360.0
    columns["wind (m/s)"] = 8.0 * np.exp(0.3 * lasting(draw, count, 12.0))
    for values in columns.values():
        values[draw.random(count) < 0.02] = math.nan
    calm = draw.random(count) < 0.01
    columns["hs (m)"][calm] = 0.0
    columns["tp (s)"][calm], columns["mwd (deg)"][calm] = math.nan, math.nan
    kept = np.ones(count, bool)
    kept[(first := int(draw.integers(100, 8000))) : first + 300] = False
    return {head: values[kept] for head, values in columns.items()}, record["time"].values[kept]


@pytest.mark.parametrize("seed", range(6))
def test_hours_are_those_of_rows_with_the_response_itself(monkeypatch, tmp_path, seed):
    def simulated(riser, states):
        heading = math.radians(float(riser.file.tree["platform"]["response"]["heading"].split()[0]))
        return responses(*states.T, heading)

    monkeypatch.setattr(RiserResponse, "__call__", simulated)
    monkeypatch.setattr(RiserResponse, "seconds", lambda *_: math.nan)
    monkeypatch.setattr(RiserResponse, "estimated_errors", lambda riser, of: np.zeros((len(of), 3)))
    draw = np.random.default_rng(seed)
    columns, time = columns_of(draw)
    record = read_record(written(tmp_path, columns, times=time))
    sectors, x_towards = int(draw.choice([2, 3, 6, 12])), float(draw.uniform(0.0, 360.0))
    most = float(draw.uniform(8.0, 14.0))
    file = load_scene(RISER).with_values(SEA, "test").with_values(TURN, "test")
    made = riser_downtime(
        file, record, [sea_limit(f"wind <= {most!r} m/s")],
        directions=Directions(sectors, math.radians(x_towards)), seeds=1, error=0.05,
    )  # fmt: skip
    height, period, bearing, wind = columns.values()
    # by vectors: x of the scene, and y to its left; waves travel away from their bearing
    east, north = (-of(np.radians(bearing)) for of in (np.sin, np.cos))
    x_east, x_north = math.sin(math.radians(x_towards)), math.cos(math.radians(x_towards))
    heading = np.arctan2(north * x_east - east * x_north, east * x_east + north * x_north)
    if sectors < 4:
        heading = np.round(heading * sectors / (2.0 * np.pi)) * 2.0 * np.pi / sectors
    calm = height == 0.0
    known = np.isfinite(wind) & (calm | np.isfinite(height + period + bearing))
    angle, mean, tension = np.where(calm[:, None], [0.0, 0.0, 2.3e6], responses(height, period, heading)).T
    connected = (tension >= 2250.5e3) & (wind <= most)
    drilling = connected & (angle <= math.radians(0.6)) & (mean <= math.radians(9.0))
    for mode, true in zip(made.hours.modes, (drilling, connected), strict=True):
        assert (mode.hours.rows, mode.hours.lacking) == (known.sum(), (~known).sum())
        assert mode.low <= true[known].mean() <= mode.high
        assert (mode.hours.workable != true[known]).mean() < 0.03
        (lost,) = mode.hours.lost
        assert lost.exceeded == pytest.approx((wind[known] > most).mean())
