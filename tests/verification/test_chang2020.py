"""Chang et al. 2020 by the engine, against the printed equation solved in other ways."""

from pathlib import Path

import numpy as np
import pytest
import reference_chang as printed
from reference_chang import LAWS, Heave

from riserstudy import simulate
from riserstudy.study.read import read_study

CONFIG = Path(__file__).parents[2] / "config"
LENGTH = 2394.0


def point(name, **place):
    """A point of a configured study, simulated."""
    planned = read_study(CONFIG, "chang2020", name, "standard", None)
    axes = list(planned.axes)
    for candidate in planned.plan:
        at = {axis: planned.axes[axis][k][0] for axis, k in zip(axes, candidate.index, strict=True)}
        if all(at[axis] == value for axis, value in place.items()):
            return simulate(planned.grid.file(candidate.index))
    raise LookupError(place)


def heave_of(run):
    return run["z"].isel(s=-1).values - LENGTH


def extremes(run):
    top = run.isel(s_node=-1)
    return float(top["z_max"]) - LENGTH, float(top["z_min"]) - LENGTH


@pytest.mark.parametrize("model", LAWS)
@pytest.mark.parametrize("amplitude", [0.5, 3.0, 10.0])
def test_consistency_with_an_integrated_equation_from_rest(model, amplitude):
    run = point("from_rest", tensioner_model=model, heave_amplitude=amplitude)
    x, _ = printed.history(LAWS[model], Heave(amplitude), run["time"].values)
    assert np.abs(heave_of(run) - x).max() < 1e-3 * np.abs(x).max()
    assert np.allclose(run["effective_tension"].isel(s=-1), printed.STIFFNESS * heave_of(run))


@pytest.mark.parametrize("amplitude", [3.0, 10.0])
def test_consistency_with_the_periodic_solution_by_shooting(amplitude):
    run = point("steady", tensioner_model="gas law", heave_amplitude=amplitude)
    rest = printed.equilibrium(printed.gas_law)
    _, (x, _) = printed.periodic(printed.gas_law, Heave(amplitude), (rest, 0.0))
    half = 0.5 * np.ptp(x)
    highest, lowest = extremes(run)
    assert highest == pytest.approx(x.max(), abs=1e-3 * half)
    assert lowest == pytest.approx(x.min(), abs=1e-3 * half)
    index = (highest - rest) / (rest - lowest)
    assert index == pytest.approx((x.max() - rest) / (rest - x.min()), rel=1e-3)


@pytest.mark.parametrize("amplitude", [0.5, 10.0])
def test_settled_linear_motion_has_the_amplitude_of_the_transfer_function(amplitude):
    run = point("steady", tensioner_model="linear", heave_amplitude=amplitude)
    w, stiffness = 2.0 * np.pi / 20.0, -printed.SLOPE
    support = stiffness + 1j * w * printed.DAMPING
    gain = abs(support / (support + printed.STIFFNESS - printed.MASS * w**2))
    highest, lowest = extremes(run)
    assert 0.5 * (highest - lowest) == pytest.approx(gain * amplitude, rel=1e-3)
    rest = printed.equilibrium(printed.linear_law)
    assert 0.5 * (highest + lowest) == pytest.approx(rest, abs=1e-3 * gain * amplitude)


@pytest.mark.parametrize("model", LAWS)
@pytest.mark.parametrize("position", [-11.0, 0.0, 5.0, 18.0])
def test_consistency_with_equilibria_by_root_finding(model, position):
    run = point("quasi_static", tensioner_model=model, heave_position=position)
    x = printed.equilibrium(LAWS[model], position)
    assert float(run["z_static"][-1]) - LENGTH == pytest.approx(x, abs=1e-6)
    force = float(run["tensioner_force_static"].sum())
    assert force == pytest.approx(LAWS[model](x - position), rel=1e-6)


@pytest.mark.parametrize("period", [2.5, 2.63, 2.7, 5.28])
def test_period_sweep_agrees_with_shooting(period):
    run = point("period_sweep", tensioner_model="gas law", heave_amplitude=0.1, heave_period=period)
    highest, lowest = extremes(run)
    rest = printed.equilibrium(printed.gas_law)
    guess = heave_at_start_of_period(run, period)
    _, (x, _) = printed.periodic(printed.gas_law, Heave(0.1, period), guess)
    assert 0.5 * (highest - lowest) == pytest.approx(0.5 * np.ptp(x), rel=0.02)
    index = (highest - rest) / (rest - lowest)
    assert index == pytest.approx((x.max() - rest) / (rest - x.min()), abs=0.02)


def heave_at_start_of_period(run, period):
    """Heave and velocity where the simulated motion begins a period: tells shooting which branch."""
    time, x = run["time"].values, heave_of(run)
    begin = (np.ceil(time[0] / period) + 1) * period
    k = int(np.searchsorted(time, begin))
    cubic = np.polynomial.Polynomial.fit(time[k - 3 : k + 4], x[k - 3 : k + 4], 6)
    return cubic(begin), cubic.deriv()(begin)


@pytest.mark.parametrize("amplitude", [3.0, 10.0])
def test_over_a_settled_period_the_platform_supplies_what_the_cylinders_dissipate(amplitude):
    run = point("steady", tensioner_model="gas law", heave_amplitude=amplitude)
    time, x = run["time"].values[:-1], heave_of(run)[:-1]
    interval = time[1] - time[0]
    _, velocity = Heave(amplitude).at(time)
    own = np.fft.irfft(2j * np.pi * np.fft.rfftfreq(len(x), interval) * np.fft.rfft(x), len(x))
    pull = run["tensioner_force"].sum("cylinder").values[:-1]
    supplied = interval * (pull * velocity).sum()
    dissipated = interval * (printed.DAMPING * (own - velocity) ** 2).sum()
    assert dissipated > 0
    assert supplied == pytest.approx(dissipated, rel=0.02)


def test_halving_the_error_asked_for_changes_settled_extremes_by_less_than_a_tenth_of_a_percent():
    planned = read_study(CONFIG, "chang2020", "steady", "preview", None)
    file = planned.grid.file((0, 4))
    half = file.with_values({"analysis.accuracy": "0.0005 %"}, "test")
    coarse, fine = extremes(simulate(file)), extremes(simulate(half))
    assert np.abs(np.subtract(coarse, fine)).max() < 1e-3 * 0.5 * (fine[0] - fine[1])


def test_without_tensioner_the_ring_moves_with_the_platform():
    run = point("rigid", heave_amplitude=5.0)
    a, _ = Heave(5.0).at(run["time"].values)
    assert np.allclose(heave_of(run), a, atol=1e-9)
    assert np.allclose(run["effective_tension"].isel(s=-1), printed.STIFFNESS * a, atol=1.0)


def test_weight_along_the_riser_stretches_it_half_as_much():
    run = point("riser_mass", mass_place="along the riser", heave_amplitude=5.0)
    law = printed.gas_law
    x = printed.brentq(
        lambda x: law(x) - 0.5 * printed.MASS * printed.GRAVITY - printed.STIFFNESS * x, -1.0, 5.0
    )
    top = float(run["z_static"][-1]) - LENGTH
    assert top == pytest.approx(x, rel=1e-4)


def test_readings_that_the_errata_exclude_are_excluded():
    """E3 and E5 of config/published/chang2020.yaml, which no study simulates."""
    assert pytest.approx(6.8, abs=0.05) == printed.VOLUME / 0.470
    assert pytest.approx(4.6, abs=0.05) == printed.VOLUME / (printed.CYLINDERS * printed.AREA)
    annulus = printed.AREA - 0.25 * np.pi * 0.400**2
    assert printed.CYLINDERS * annulus * printed.PRESSURE < printed.MASS * printed.GRAVITY
    rest = printed.equilibrium(printed.gas_law)
    slope = (printed.gas_law(rest - 1e-4) - printed.gas_law(rest + 1e-4)) / 2e-4
    critical = 2.0 * np.sqrt((printed.STIFFNESS + slope) * printed.MASS)
    assert printed.DAMPING / critical == pytest.approx(0.001, rel=0.1)
    assert 0.05 * critical / printed.DAMPING == pytest.approx(46, abs=0.5)
    assert critical < 1000.0 * printed.DAMPING
    assert pytest.approx(387, abs=0.5) == 2.0 * printed.MASS / printed.DAMPING
