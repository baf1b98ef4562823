"""Explicit stepping: against the stored surge, against implicit stepping, and where it stays stable."""

import numpy as np
import pytest
from engine import march, off, scene, slopes
from reference import DATA
from scipy.interpolate import CubicSpline
from scipy.linalg import eigh

import riserstudy.simulation.stable_step
from riserstudy.errors import SimulationError
from riserstudy.model.mesh import even
from riserstudy.simulation.equilibrium import settle
from riserstudy.solve.modes import FEW, matrices, stable_step

EXPLICIT = {"analysis__method": "explicit", "analysis__output": {"interval": "0.1 s"}}
DAMPED = {"riser[0].structural_damping": {"ratio": 0.05, "at_period": "1 s"}}


def at_rest(name, elements, **values):
    mesh = {"analysis__mesh": {"elements": elements}, "analysis__step": "0.1 ms"}
    file = scene(name, **(EXPLICIT | mesh | values)).resolved()
    return settle(file, even(file, elements))[0]


def limit(name, elements, **values):
    """Stable step about the equilibrium, as the engine predicts it."""
    model = at_rest(name, elements, **values)
    return stable_step(model.programs, model.state, model.fixed)


@pytest.mark.parametrize("elements", [18, 36, 72])
def test_the_stable_step_of_an_undamped_riser_is_that_of_its_axial_waves(elements):
    wave = 533.0 / elements / np.sqrt(8.3505393e9 / 1006.0)
    # held ends let the fastest wave be a little slower than an endless riser's
    assert limit("s2", elements) == pytest.approx(wave, rel=1e-2)
    assert limit("s2", elements) >= wave


@pytest.mark.parametrize("damping", [{}, DAMPED], ids=["undamped", "damped"])
@pytest.mark.parametrize("elements", [40, 180])
def test_the_stable_step_is_that_of_the_mode_that_needs_the_shortest(elements, damping):
    model = at_rest("s2", elements, **damping)
    stiff, rate, mass, _ = matrices(model.programs, model.state, model.fixed)
    assert (len(mass) > FEW) == (elements == 180)  # found in another way from there
    square, shapes = eigh(stiff, mass)
    w = np.sqrt(square)
    z = 0.5 * np.einsum("ij,ik,kj->j", shapes, rate, shapes) / w
    shortest = (2.0 * (np.sqrt(1.0 + z * z) - z) / w).min()
    predicted = stable_step(model.programs, model.state, model.fixed)
    assert 1.0 - 2e-5 < predicted / shortest < 1.0


@pytest.mark.parametrize("damping", [{}, DAMPED], ids=["undamped", "damped"])
@pytest.mark.parametrize("name, elements", [("s2", 10), ("s2", 20), ("s2", 40), ("s3", 20)])
def test_the_predicted_stable_step_is_the_true_one_to_a_tenth_and_never_unsafe(
    name, elements, damping, monkeypatch
):
    step = limit(name, elements, **damping)
    monkeypatch.setattr(riserstudy.simulation.stable_step, "explicit_limit", lambda *of: np.inf)
    values = EXPLICIT | damping | {"analysis__duration": "20 s"}
    calm = march(name, elements, 0.5 * step, **values).arrays["effective_tension"]
    safe = march(name, elements, 0.99 * step, **values).arrays["effective_tension"]
    assert np.abs(safe - calm).max() < 0.01 * np.abs(calm).max()
    # an end mass's drag may keep growth at bay, at forces beyond reason
    assert largest_tension(name, elements, 1.1 * step, values) > 100.0 * np.abs(calm).max()


def largest_tension(name, elements, step, values):
    """Infinite where the run stops because velocities grow without bound."""
    try:
        run = march(name, elements, step, **values)
    except SimulationError as error:
        return np.inf if "velocities grow" in str(error) else 0.0
    return float(np.abs(run.arrays["effective_tension"]).max())


def test_a_step_above_the_stable_one_is_refused_with_both_numbers():
    with pytest.raises(SimulationError, match=r"analysis\.step 0\.02 s is above the stable step 0\.00\d"):
        march("s2", 36, 0.02, **EXPLICIT)


def test_explicit_and_implicit_stepping_agree_as_the_mesh_is_refined():
    with np.load(DATA / "S2.npz") as file:
        best, stations = file["x"][:601:2], file["s"]
    elements = np.array([24, 36, 50, 72])
    explicit, implicit = [], []
    for n in elements:
        values = {"analysis__duration": "30 s", "analysis__output": {"interval": "0.1 s"}}
        step = 0.9 * limit("s2", int(n))
        for errors, run in (
            (explicit, march("s2", int(n), step, **(values | {"analysis__method": "explicit"}))),
            (implicit, march("s2", int(n), 0.01, **values)),
        ):
            x = CubicSpline(run.arrays["s"], run.arrays["x"], axis=1)(stations)
            errors.append(off(x, best))
    # lumped masses: second order; shared masses: fourth
    assert slopes(1.0 / elements, explicit) == pytest.approx(2.0, abs=0.2)
    assert explicit[1] < 0.015
    assert explicit[2] < 0.008
    assert implicit[2] < 2e-4


@pytest.mark.parametrize("damping", [{}, DAMPED], ids=["undamped", "damped"])
def test_explicit_runs_account_for_their_energy(damping):
    values = EXPLICIT | damping | {"analysis__duration": "20 s"}
    step = 0.9 * limit("s2", 36, **damping)
    assert march("s2", 36, step, **values).facts["audit"]["unexplained_share"] < 1e-3
