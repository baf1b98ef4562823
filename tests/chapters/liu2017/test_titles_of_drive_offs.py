"""Titles of drive-offs say no more than drawn times show."""

import numpy as np
import pytest
import xarray as xr

from chapters.liu2017.figures.checks import calibration
from chapters.liu2017.figures.drive_off import _which_is_first, _who_arrives_later
from chapters.liu2017.limits import LIMITS
from riserstudy.figures.figure_text import headline


@pytest.mark.parametrize("seed", range(12))
def test_a_delay_is_told_only_where_every_platform_arrives_and_the_one_against_later(seed):
    draw = np.random.default_rng(seed)
    later = [float(of) for of in draw.choice([np.inf, np.nan, -3.0, 7.0, 12.0], 2)]
    said = _who_arrives_later(later)
    assert ("not reach" in said) == (not np.isfinite(later).all())
    assert ("not always" in said) == bool(np.isfinite(later).all() and min(later) < 0.0)
    if np.isfinite(later).all() and min(later) > 0.0:
        ends = sorted({round(of) for of in later})
        assert said.endswith(f"{' to '.join(map(str, ends))} s later")


@pytest.mark.parametrize("seed", range(12))
def test_the_first_limit_is_told_with_its_time_or_none_is(seed):
    draw = np.random.default_rng(seed)
    times = np.where(draw.random(len(LIMITS)) < 0.5, draw.uniform(20.0, 90.0, len(LIMITS)), np.inf)
    if seed % 4 == 0:
        times[:] = np.inf
    said = _which_is_first(xr.DataArray(times, {"limit": list(LIMITS)}))
    if np.isfinite(times).any():
        k = int(times.argmin())
        assert said == f"The {list(LIMITS)[k]} reaches its limit first, at {times[k]:.0f} s (calibrated)"
    else:
        assert said.startswith("No limit")
        assert "inf" not in said


@pytest.mark.parametrize("largest, met", [(15.0, True), (9.0, False)])
@pytest.mark.filterwarnings("ignore:No contour levels")
def test_pairs_are_said_to_give_the_printed_angle_only_where_some_do(largest, met):
    over = {
        "riser_weight": ["none", "500 N/m"],
        "hull_drag": [100.0, 300.0, 500.0],
        "gain": [40.0, 60.0, 80.0],
    }
    angle = np.deg2rad(np.broadcast_to(np.linspace(3.0, largest, 3), (2, 3, 3)))
    runs = {name: (tuple(over), angle) for name in ("ufj_angle", "ufj_angle_absmax")}
    fit = {"gain": 60.0, "hull_drag": 250.0, "riser_weight": 500.0}
    title = headline(calibration(xr.Dataset(runs, over, fit), 50.0))
    assert title.startswith("Many pairs" if met else "No simulated pair")
