"""Every Runge-Kutta tableau is what it is said to be: a wrong digit in any of its weights is found."""

from math import prod
from typing import get_args

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from riserstudy.scene.analysis import Analysis
from riserstudy.solve.runge_kutta import TABLEAUS

every = pytest.mark.parametrize("method", TABLEAUS)
ROUNDING = 1e-13


def trees(order):
    """Rooted trees with so many nodes, each the tuple of its branches."""
    if order == 1:
        return [()]
    found = set()
    for parts in partitions(order - 1):
        choices = [trees(part) for part in parts]
        for branches in product_of(choices):
            found.add(tuple(sorted(branches)))
    return sorted(found)


def partitions(total, most=None):
    """Ways to write a number as a sum of others, the largest first."""
    if total == 0:
        yield ()
    for first in range(min(total, most or total), 0, -1):
        for rest in partitions(total - first, first):
            yield (first, *rest)


def product_of(choices):
    """One of each."""
    if not choices:
        yield ()
        return
    for first in choices[0]:
        for rest in product_of(choices[1:]):
            yield (first, *rest)


def nodes(tree):
    return 1 + sum(map(nodes, tree))


def density(tree):
    """The product over all nodes of the number of nodes that stand on each."""
    return nodes(tree) * prod(map(density, tree))


def stage_values(weights, tree):
    """Elementary weights of the stages."""
    return prod((weights @ stage_values(weights, branch) for branch in tree), start=np.ones(len(weights)))


def order_of(weights, most=6):
    """The order up to which all of Butcher's conditions hold, the last stage being the step."""
    for order in range(1, most + 1):
        for tree in trees(order):
            if abs(weights[-1] @ stage_values(weights, tree) - 1.0 / density(tree)) > ROUNDING:
                return order - 1
    return most


def stage_order_of(weights, most=4):
    """The order of each stage by itself."""
    c = weights.sum(axis=1)
    for order in range(1, most + 1):
        if abs(weights @ c ** (order - 1) - c**order / order).max() > ROUNDING:
            return order - 1
    return most


def growth(weights, z):
    """What the step makes of exp(z): its stability function."""
    n = len(weights)
    return np.linalg.solve(np.eye(n) - z * weights, np.ones(n))[-1]


def faults(weights, order):
    """What of a diagonally implicit, stiffly accurate tableau of an order is not so."""
    if order_of(weights) != order:
        yield "order"
    if stage_order_of(weights) != 2:
        yield "stage order"
    if abs(np.triu(weights, 1)).max() > 0.0 or abs(weights[0]).max() > 0.0:
        yield "first stage explicit, others diagonally implicit"
    if np.ptp(np.diag(weights)[1:]) > 0.0:
        yield "one diagonal element"
    if abs(weights[-1].sum() - 1.0) > ROUNDING:
        yield "the last stage is the step"
    if abs(growth(weights, -1e9)) > 1e-6:
        yield "damps what is not resolved"
    if max(abs(growth(weights, 1j * y)) for y in np.logspace(-3, 4, 400)) > 1.0 + 1e-12:
        yield "stable for any step"


def test_trees_are_as_many_as_there_are():
    assert [len(trees(order)) for order in range(1, 7)] == [1, 1, 2, 4, 9, 20]


@every
def test_a_tableau_is_what_it_is_said_to_be(method):
    assert list(faults(*TABLEAUS[method])) == []


@every
def test_a_wrong_digit_in_any_weight_is_found(method):
    weights, order = TABLEAUS[method]
    for place in np.argwhere(weights != 0.0):
        wrong = weights.copy()
        wrong[tuple(place)] *= 1.0 + 1e-9
        assert list(faults(wrong, order)), place


def test_scenes_name_these_methods_and_no_others():
    named = {
        name
        for part in get_args(Analysis.model_fields["method"].annotation)
        for name in get_args(part)
        if isinstance(name, str)
    }
    assert named - {"explicit"} == set(TABLEAUS)


def pendulum(y):
    """A pendulum in water: angle and its rate."""
    return np.array([y[1], -np.sin(y[0]) - 0.3 * y[1] * abs(y[1])])


@every
def test_the_order_is_seen_on_a_pendulum_in_water(method):
    weights, order = TABLEAUS[method]
    begin, end = np.array([1.2, 0.8]), 0.6  # before it turns, where drag has a kink

    def run(steps):
        y, h = begin, end / steps
        for _ in range(steps):
            slopes = [pendulum(y)]
            for i in range(1, len(weights)):
                known = y + h * sum(w * k for w, k in zip(weights[i], slopes, strict=False))
                at = known
                for _ in range(40):  # a contraction at these steps
                    at = known + h * weights[i, i] * pendulum(at)
                slopes.append(pendulum(at))
            y = at
        return y

    exact = solve_ivp(lambda t, y: pendulum(y), (0.0, end), begin, method="DOP853", rtol=1e-13, atol=1e-14).y[
        :, -1
    ]
    errors = [abs(run(steps) - exact).max() for steps in (4, 8, 16)]
    seen = np.diff(-np.log2(errors))
    assert seen == pytest.approx(order, abs=0.25)
