"""What is unstable grows as its linearised eigenvalue says, and is called unstable before.

The base scene of fem_riser without joints, current and waves: a straight riser that a small push disturbs.
"""

from functools import cache

import numpy as np
import pytest
from scenes import from_file
from scipy.linalg import eigh

from riserstudy import simulate
from riserstudy.errors import SimulationError
from riserstudy.model.mesh import even
from riserstudy.simulation.hermite_run import beam_of
from riserstudy.solve.hermite import dynamics, frequencies
from riserstudy.solve.hermite_beam import HermiteError, Stepping

ELEMENTS = 200
CALM = {"current": None, "wave": None, "bottom__rotation": "free", "top__rotation": "free"}
PUSH = 1e-6  # N/m


@cache
def beam(ratio, drag=False):
    """The riser as a Hermite beam, with a small load of the shape of half a sine's sum."""
    values = {**CALM, "buoyancy__tension_ratio": ratio}
    scene = from_file("fem_riser/base", **values).resolved()
    found = beam_of(scene, even(scene, ELEMENTS))
    load = PUSH * np.sin(np.pi * found.s / found.s[-1])
    tension = np.repeat(found.tension.mean(axis=1)[:, None], 2, axis=1)  # as `squares` has it
    found = found._replace(load=np.stack([load[:-1], load[1:]], axis=1), tension=tension)
    return found if drag else found._replace(drag=0.0 * found.drag)


@cache
def squares(ratio):
    """Lowest squared circular frequencies of the beam (1/s2), by a plain assembly of its own."""
    found = beam(ratio)
    n, h = ELEMENTS, np.diff(found.s)[0]
    stiffness, mass = np.zeros((2, 2 * n + 2, 2 * n + 2))
    bend = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                     [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]) / h**3  # fmt: skip
    pull = np.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h * h, -3 * h, -h * h],
                     [-36, -3 * h, 36, -3 * h], [3 * h, -h * h, -3 * h, 4 * h * h]]) / (30 * h)  # fmt: skip
    carry = np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                      [54, 13 * h, 156, -22 * h],
                      [-13 * h, -3 * h * h, -22 * h, 4 * h * h]]) * h / 420  # fmt: skip
    for e in range(n):
        part = slice(2 * e, 2 * e + 4)
        stiffness[part, part] += found.bending_stiffness[e, 0] * bend + found.tension[e].mean() * pull
        mass[part, part] += (found.mass[e] + found.added_mass[e]) * carry
    free = np.delete(np.arange(2 * n + 2), [0, 2 * n])
    return eigh(stiffness[np.ix_(free, free)], mass[np.ix_(free, free)], eigvals_only=True)


def history(found, duration, step, **method):
    times = np.linspace(0.0, duration, 301)
    return times, dynamics(found, times, step, Stepping(**method), start="straight").displacement


def test_the_lowest_eigenvalue_changes_sign_between_tension_ratios():
    found = squares(0.96)
    np.testing.assert_allclose(frequencies(beam(0.96), 3)[0] ** 2, found[:3], rtol=1e-6)
    assert found[0] > 0.0
    assert squares(0.95)[0] < 0.0 < squares(0.95)[1]
    assert (squares(0.8) < 0.0).sum() > 1
    with pytest.raises(HermiteError, match="not positive"):
        frequencies(beam(0.95), 1)


@pytest.mark.parametrize("ratio", [0.95, 0.9])
def test_a_riser_with_too_little_tension_grows_at_the_rate_of_its_eigenvalue(ratio):
    rate = np.sqrt(-squares(ratio)[0])
    duration = 12.0 / rate
    times, x = history(beam(ratio), duration, 0.01 / rate)
    middle = np.abs(x).max(axis=1)
    late = slice(200, 300)  # e^8 to e^12 of the start: the one mode is left
    grown = np.polyfit(times[late], np.log(middle[late]), 1)[0]
    assert grown == pytest.approx(rate, rel=0.01)


@pytest.mark.parametrize("solver", [None, "hermite"])
def test_the_same_riser_is_called_unstable_before_it_moves(solver):
    still = {f"analysis__{name}": None for name in ("duration", "output", "start")}
    values = {**CALM, **still, "buoyancy__tension_ratio": 0.95, "riser[0].lateral_load": "0 N/m"}
    values["analysis__mesh"] = {"elements": 200}
    if solver:
        values["analysis__solver"] = solver
    with pytest.raises(SimulationError, match="unstable"):
        simulate(from_file("fem_riser/base", **values))


def test_a_step_of_the_boundary_rings_for_ever_and_numerical_damping_ends_it():
    """Average acceleration keeps the ringing of what it cannot resolve; gamma above a half takes it out."""
    found = beam(1.3, drag=True)._replace(top=beam(1.3).top._replace(motion=moved_at_once(10.0)))
    ringing = {
        name: history(found, 60.0, 0.1, drag="newton", beta=beta, gamma=gamma)[1]
        for name, beta, gamma in (("undamped", 0.25, 0.5), ("damped", 0.3025, 0.6))
    }
    rough = {name: np.abs(np.diff(x[-50:], 2, axis=1)).max() for name, x in ringing.items()}
    assert rough["undamped"] > 3.0 * rough["damped"]


def moved_at_once(distance):
    def motion(times):
        return distance + 0.0 * times, 0.0 * times, 0.0 * times

    return motion


@pytest.mark.parametrize("beta, gamma", [(1 / 6, 0.5), (1 / 12, 0.5), (0.25, 0.49)])
def test_an_unstable_newmark_method_blows_up_at_the_rate_of_its_amplification(beta, gamma):
    """The fastest mode grows by the largest eigenvalue of its own step matrix."""
    found, step, steps = beam(1.3), 0.05, 120
    fastest = step**2 * squares(1.3)[-1]
    grown = amplification(fastest, beta, gamma)
    if gamma < 0.5:  # every mode grows, the fastest not the fastest
        grown = max(amplification(step**2 * w, beta, gamma) for w in squares(1.3))
    assert grown > 1.0
    # long enough for the fastest growth to rule
    count = steps if grown > 1.5 else 3000
    times = step * np.arange(count + 1)
    stepping = Stepping(beta, gamma, tolerance=1e300)
    x = dynamics(found, times, step, stepping, start="straight").displacement
    size = np.abs(x).max(axis=1)
    late = slice(count // 2, count)
    assert np.exp(np.polyfit(np.arange(count + 1)[late], np.log(size[late]), 1)[0]) == pytest.approx(
        grown, rel=0.02
    )


def amplification(square, beta, gamma):
    """Spectral radius of Newmark's method for (h w)^2 = square, per step."""
    left = 1.0 + beta * square
    # state (x, h v, h^2 a): predict, solve a' = -square x' with x' = predicted + beta a'
    predict = np.array([[1.0, 1.0, 0.5 - beta], [0.0, 1.0, 1.0 - gamma], [0.0, 0.0, 0.0]])
    accelerate = -square / left * predict[0]
    a = predict + np.outer([beta, gamma, 1.0], accelerate)
    return float(np.abs(np.linalg.eigvals(a)).max())
