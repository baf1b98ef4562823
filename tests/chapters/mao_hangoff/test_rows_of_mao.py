"""Rows on where displacement grows, and on samples with long ramps and large drag areas."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.mao_hangoff.claims.errata import parts_of_samples
from chapters.mao_hangoff.claims.further import upper_half_moves_faster
from chapters.mao_hangoff.claims.towed import (
    change_near_the_lmrp,
    lower_half_moves_more,
    steep_near_the_surface,
)
from riserstudy.grading.words_of_size_file import read_words

CONFIG = Path(__file__).parents[3] / "config"
WORD = read_words(CONFIG).word
LENGTH = 1800.0  # m
TIMES = [10.0, 40.0, 70.0, 100.0, 130.0]  # s


def shape(kink, upper, lower):
    """A riser with one slope down to a depth and another below, at 130 s."""
    depth = np.linspace(LENGTH, 0.0, 361)
    away = np.where(depth < kink, upper * depth, upper * kink + lower * (depth - kink))
    coords = {"time": [130.0], "s": LENGTH - depth}
    return xr.Dataset({"x": (("time", "s"), -away[None])}, coords)


@pytest.mark.parametrize("seed", range(12))
def test_a_riser_is_steep_near_the_surface_where_its_slope_is(seed):
    random = np.random.default_rng(seed)
    upper, lower = random.uniform(0.02, 0.1, 2)
    found = steep_near_the_surface(shape(150.0, upper, lower), 150.0, WORD("considerable"))
    mean = (150.0 * upper + (LENGTH - 150.0) * lower) / LENGTH
    assert float(found.value) == pytest.approx(upper / mean, rel=1e-9)
    assert bool(found.true) == (mean < 0.75 * upper)


def test_a_straight_riser_makes_no_difference():
    found = steep_near_the_surface(shape(150.0, 0.05, 0.05), 150.0, WORD("considerable"))
    assert not bool(found.true)
    assert bool(found.same)


def test_shares_of_samples_are_those_of_either_side():
    """C5 is made true in every second sample, C10 in every third; ramps and areas are drawn."""
    random = np.random.default_rng(5)
    count = 60
    first = np.where(np.arange(count) % 2, 1.0, 20.0)  # m at 10 s, of 50 at 130 s
    lighter = np.where(np.arange(count) % 3, 0.9, 1.2)  # distance with 120 t over that with 140 t
    heavy = np.linspace(first, np.full(count, 50.0), 5)  # over time
    x = np.zeros((count, 3, 5, 2))
    for k, share in enumerate((lighter, 0.5 * (1.0 + lighter), np.ones(count))):
        x[:, k, :, 0] = -(heavy * share).T
    ramp, area = random.uniform(1.0, 120.0, count), random.uniform(0.0, 80.0, count)
    runs = xr.Dataset(
        {
            "x": (("sample", "lmrp_mass", "time", "s"), x),
            "assumed_platform_cruise_ramp": ("sample", [f"{x} s" for x in ramp]),
            "assumed_bottom_body_drag_area_horizontal": ("sample", [f"{x} m^2" for x in area]),
        },
        {"lmrp_mass": [120.0, 130.0, 140.0], "time": TIMES, "s": [0.0, LENGTH]},
    )
    facts = parts_of_samples(runs, 0.1, WORD("larger"), 60.0, 40.0)
    small, farther = np.arange(count) % 2 == 1, np.arange(count) % 3 == 0
    assert facts["ramp_count"] == int((ramp > 60.0).sum())
    assert facts["area_count"] == int((area > 40.0).sum())
    for side, drawn, edge in (("ramp", ramp, 60.0), ("area", area, 40.0)):
        for name, true in (("C5", small), ("C10", farther)):
            assert facts[f"{name}_{side}_above"] == pytest.approx(true[drawn > edge].mean())
            assert facts[f"{name}_{side}_below"] == pytest.approx(true[drawn <= edge].mean())


def test_halves_travel_between_the_times_of_fig_9c_however_often_a_record_has_outputs():
    """The lower half swings between these times, which only a record with more outputs has."""
    time, s = np.linspace(0.0, 130.0, 261), np.linspace(0.0, LENGTH, 37)
    swing = np.sin(2.0 * np.pi * (time - 10.0) / 10.0)[:, None] * (s < 0.5 * LENGTH)
    x = time[:, None] * (0.5 + 0.5 * s / LENGTH) + 5.0 * swing
    often = xr.Dataset({"x": (("time", "s"), x)}, {"time": time, "s": s})
    found = [upper_half_moves_faster(one, WORD("faster")) for one in (often, often.sel(time=TIMES))]
    assert float(found[0].value) == pytest.approx(float(found[1].value), rel=1e-12)
    assert all(bool(one.true) for one in found)


@pytest.mark.parametrize("seed", range(12))
def test_halves_are_means_over_the_length_however_the_nodes_are_graded(seed):
    """The mesh is finer near the ends; nodes that change no shape change no value."""
    draw = np.random.default_rng(seed)
    knots = np.linspace(0.0, LENGTH, 9)
    rises = draw.uniform(0.1, 1.0, (2, len(TIMES), 8))  # each node trails the one above
    shape = np.concatenate([np.zeros((2, len(TIMES), 1)), rises[:, :, ::-1].cumsum(-1)], axis=-1)[:, :, ::-1]
    x = np.array([TIMES])[..., None] * draw.uniform(1.0, 2.0) - np.sort(shape, axis=1)
    even = xr.Dataset(
        {"x": (("lmrp_mass", "time", "s"), x)}, {"lmrp_mass": [120.0, 140.0], "time": TIMES, "s": knots}
    )
    fine = LENGTH * draw.beta(0.4, draw.uniform(0.2, 2.0), 200)
    graded = even.interp(s=np.unique(np.concatenate([knots, fine])))
    checks = (
        lower_half_moves_more,
        change_near_the_lmrp,
        lambda runs: upper_half_moves_faster(runs, WORD("faster")),
    )
    for check in checks:
        np.testing.assert_allclose(check(graded).value, check(even).value, rtol=1e-9)
        np.testing.assert_allclose(check(graded).margin, check(even).margin, rtol=1e-9, atol=1e-12)
