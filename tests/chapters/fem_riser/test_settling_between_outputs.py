"""Averages over a wave, times to a steady state, and largest moments of either sign, with known answers."""

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import brentq

from chapters.fem_riser import claims
from chapters.fem_riser.figures import motion as figures

END, WAVE = 300.0, 8.0  # s


def recorded(curve, interval, swing, late):
    """Mid-length deflection over 300 s: a slow curve and the motion in the wave."""
    time = np.arange(0.0, END + 1e-9, interval)
    x = curve(time) + swing * np.sin(2.0 * np.pi * time / WAVE - late)
    return xr.Dataset({"x": (("time", "s"), np.stack([0.0 * x, x, 0.0 * x], axis=1))}, {"time": time})


@pytest.mark.parametrize("interval", [0.25, 0.5, 1.0])
@pytest.mark.parametrize("seed", range(4))
def test_the_mean_over_a_wave_is_the_level_in_its_middle(seed, interval):
    draw = np.random.default_rng(seed)
    level, rate = draw.uniform(-5.0, 5.0), draw.uniform(-0.2, 0.2)
    run = recorded(lambda t: level + rate * t, interval, draw.uniform(0.0, 1.0), draw.uniform(0.0, 6.0))
    slow = claims.averaged(run["x"].isel(s=1))
    np.testing.assert_allclose(slow, level + rate * slow["time"], atol=1e-9)


@pytest.mark.parametrize("interval", [0.25, 0.5, 1.0])
@pytest.mark.parametrize("seed", range(4))
def test_the_time_to_a_steady_state_does_not_depend_on_the_interval_of_outputs(seed, interval):
    """A level that approaches its last value exponentially, from the closed form of its mean over a wave."""
    draw = np.random.default_rng(seed)
    scale, within, size = draw.uniform(20.0, 90.0), draw.uniform(0.003, 0.02), draw.uniform(1.0, 30.0)

    def curve(t):
        return size * (1.0 - np.exp(-t / scale))

    def mean(t):  # over the wave around t
        early, late = (np.exp(-(t + end) / scale) for end in (-0.5 * WAVE, 0.5 * WAVE))
        return size * (1.0 - scale / WAVE * (early - late))

    last = mean(END - 0.5 * WAVE)
    exact = brentq(lambda t: last - mean(t) - within * last, 4.0, END - 4.0)
    run = recorded(curve, interval, 0.05 * size, 0.0)
    # outputs 1 s apart: the error of a trapezium is (1 s / scale)^2 / 12, of a line between means a fourth
    assert float(claims.settling_time(run, within)) == pytest.approx(exact, abs=0.05)


def test_a_missing_average_gives_no_time_and_a_steady_record_none_to_wait():
    run = recorded(lambda t: 3.0 + 0.0 * t, 1.0, 0.0, 0.0)
    run["x"][0] = 0.0
    assert float(claims.settling_time(run, 0.6)) == 0.0
    gap = run.copy(deep=True)
    gap["x"][150] = np.nan
    assert np.isnan(float(claims.settling_time(gap, 0.005)))


@pytest.mark.parametrize("seed", range(8))
def test_a_longer_step_is_told_by_the_change_of_the_largest_moment_of_either_sign(seed):
    draw = np.random.default_rng(seed)
    high, low = draw.uniform(10.0, 90.0, 2)
    changes = draw.uniform(0.01, 0.3, 2)  # of the moments of either sign, by the longer step

    def both(value, change):
        return ("time_step", "s_node"), [[0.0, value], [0.0, (1.0 + change) * value]]

    runs = xr.Dataset(
        {
            "solve_seconds": ("time_step", [100.0, 1.0]),
            "x_max": both(1.0, 0.0),
            "bending_moment_max": both(high, changes[0]),
            "bending_moment_min": both(-low, changes[1]),
        },
        {"time_step": [0.0005, 0.05]},
    )
    words = claims.run_time(runs)["run"]
    told = float(words.partition("by at most ")[2].partition(" %")[0])
    long, short = (max(high * (1.0 + k * changes[0]), low * (1.0 + k * changes[1])) for k in (1.0, 0.0))
    change = 100.0 * (long / short - 1.0)
    assert change <= told * (1.0 + 1e-9)  # rounded up to one digit
    assert told - change <= 10.0 ** np.floor(np.log10(change)) * (1.0 + 1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_the_title_of_the_base_case_tells_how_near_the_ends_stress_and_angle_peak(seed, monkeypatch):
    draw = np.random.default_rng(seed)
    places = draw.uniform(0.0, 0.5, 4)
    names = [f"{of}_from_{end}" for of in ("stress", "angle") for end in ("bottom", "top")]
    measured = dict(zip(names, places, strict=True)) | {"deflection_place": draw.uniform(0.3, 0.7)}
    said = []
    monkeypatch.setattr(figures, "measures", lambda runs: measured)
    monkeypatch.setattr(figures, "envelopes", lambda cases, colours: None)
    monkeypatch.setattr(figures, "headline", lambda figure, text: said.append(text))
    figures.fig05(xr.Dataset(coords={"solver": [figures.BEAM]}))
    told = float(said[0].partition("within ")[2].partition(" %")[0])
    assert 0.0 <= told - 100.0 * places.max() < 1.0
