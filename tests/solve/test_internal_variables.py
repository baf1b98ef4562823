"""Internal variables of effects: a spring behind a dashpot, whose motion is known, by every method.

A mass on a spring K, and beside it on a spring k in series with a dashpot of time T: the dashpot's place q is
an internal variable, q' = (x - q) / T. The three equations are linear: their exponential is the measure.
"""

from typing import NamedTuple

import numpy as np
import pytest
from scipy.linalg import expm

from riserstudy.effects.end_mass import EndMass
from riserstudy.effects.guide import Guide
from riserstudy.effects.registry import NAMES, ROLES
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.solve.implicit import Method, generalised_alpha, march
from riserstudy.solve.jit import inner
from riserstudy.solve.newton import Tolerance
from riserstudy.solve.record import new_record
from riserstudy.solve.runge_kutta import TABLEAUS, Stages, march_in_stages
from riserstudy.solve.sums import DONE, HALVED, ITERATIONS, new_sums

M, K, SOFT, TIME = 3.0, 70.0, 200.0, 0.4
START = np.array([0.3, -1.0, 0.1])  # x, v, q
END = 1.0


class Maxwell(NamedTuple):
    """A spring in series with a dashpot, on a node, in the first direction; and a bound on the speed."""

    node: int
    stiffness: float
    time: float
    bound: np.ndarray  # (1,) steps longer than this (s) have no solution: the force is no number


@inner
def internal(of, s):
    share = s.internal_share[0]
    q = (s.internal_known[0, of.node] + share / of.time * s.r[0, of.node]) / (1.0 + share / of.time)
    s.internal[0, of.node] = q
    s.internal_rate[0, of.node] = (s.r[0, of.node] - q) / of.time
    return 0.0


@inner
def force(of, s):
    pull = of.stiffness * (s.r[0, of.node] - s.internal[0, of.node])
    if s.internal_share[0] > of.bound[0]:
        pull = np.nan
    s.force[0, of.node] -= pull
    return 0.0


@inner
def tangent(of, s):
    share = s.internal_share[0] / of.time
    s.k_node[of.node, 0] += of.stiffness / (1.0 + share)
    return 0.0


@pytest.fixture
def maxwell(monkeypatch):
    """The effect, on the list for one test."""
    functions = {"internal": internal, "device": force, "tangent": tangent}
    monkeypatch.setitem(ROLES, Maxwell, functions)
    monkeypatch.setitem(NAMES, Maxwell, ("spring behind a dashpot",))


def model(bound=np.inf):
    """Two nodes a metre apart; the upper one moves sideways alone."""
    effects = [
        EndMass(1, 0.0, np.full(2, M), np.zeros(2), np.zeros(2)),
        Guide(1, K),
        Maxwell(1, SOFT, TIME, np.array([bound])),
    ]
    held = [(0, 0), (0, 1), (1, 1)]
    made = Model(
        Unknowns(np.ones(1), 2, 0, internal=1), [Effect(type(e).__name__, e, "") for e in effects], held
    )  # fmt: skip
    made.s.r[1] = 0.0, 1.0
    made.s.r[0, 1], made.s.v[0, 1], made.s.internal[0, 1] = START
    return made


def methods():
    yield "generalised-alpha", 2
    for name, tableau in TABLEAUS.items():
        yield name, tableau.order


def run(name, steps, bound=np.inf, times=(END,)):
    """Where it is at the end, outputs of the place, and sums."""
    made = model(bound)
    record, sums = new_record(np.array(times), [1], made.s), new_sums()
    if name in TABLEAUS:
        method, stepped = (
            Stages(TABLEAUS[name].weights, END / steps, steps, Tolerance(1e-13, 1e-4), 20, 6, 0),
            march_in_stages,
        )
    else:
        method, stepped = (
            Method(*generalised_alpha(0.8), END / steps, steps, Tolerance(1e-13, 1e-4), 20, 6, 0),
            march,
        )
    outcome = stepped(made.programs, made.state, made.spare, method, made.fixed, record, sums)
    assert outcome == DONE
    s = made.s
    return np.array([s.r[0, 1], s.v[0, 1], s.internal[0, 1]]), record.value.history[:, 0, 0], sums


def exact(time):
    rates = np.array([[0.0, 1.0, 0.0], [-(K + SOFT) / M, 0.0, SOFT / M], [1 / TIME, 0.0, -1 / TIME]])
    return expm(rates * time) @ START


@pytest.mark.long
@pytest.mark.parametrize("name, order", [*methods()])
def test_methods_keep_their_order(maxwell, name, order):
    errors = [abs(run(name, steps)[0] - exact(END)).max() for steps in (40, 80, 160)]
    seen = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all(abs(seen - order) < 0.25), errors


@pytest.mark.parametrize("name, order", [*methods()])
def test_outputs_between_steps_are_as_exact_as_steps(maxwell, name, order):
    """The cubic of an internal variable is of fourth order."""
    times = np.linspace(0.03, END, 30)
    errors = [
        abs(run(name, steps, times=times)[1] - [exact(t)[0] for t in times]).max() for steps in (80, 160)
    ]  # fmt: skip
    assert np.log2(errors[0] / errors[1]) > order - 0.4


@pytest.mark.parametrize("name, order", [*methods()])
def test_a_step_that_fails_is_halved_from_where_it_began(maxwell, name, order):
    """A step whose first try fails ends where steps of half its length end."""
    share = 0.5 if name not in TABLEAUS else TABLEAUS[name].weights[-1, -1]
    halved, _, sums = run(name, 40, bound=0.75 * share * END / 40)
    assert sums.count[HALVED] > 0
    np.testing.assert_allclose(halved, run(name, 80)[0], rtol=1e-10)


def test_a_model_with_other_effects_goes_on_from_the_same_variables(maxwell):
    first = model()
    other = first.changed(first.effects, first.pairs)
    np.testing.assert_array_equal(other.s.internal, first.s.internal)


def test_two_corrections_solve_a_linear_step(maxwell):
    """The first, and one that confirms it: the tangent has the internal variable in it."""
    stages = len(TABLEAUS["TR-BDF2"].weights) - 1
    _, _, sums = run("TR-BDF2", 40)
    assert sums.count[ITERATIONS] <= 2 * stages * 40
