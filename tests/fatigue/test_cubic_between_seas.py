"""Damage between simulated sea states, by monotone cubic functions of its fourth root."""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from riserstudy.fatigue.response import Response


def drawn(draw, axes):
    """A response over some axes, (axes..., 3 places), with sea states on and between its values."""
    counts = draw.integers(1, 6, axes)
    grid = {f"axis{k}": np.sort(draw.uniform(0.0, 10.0, count)) for k, count in enumerate(counts)}
    rates = draw.uniform(0.0, 2.0, (*counts, 3)) ** 4 * (draw.random((*counts, 3)) < 0.8)
    return Response(grid, rates)


@pytest.mark.parametrize("axes", [1, 2, 3])
@pytest.mark.parametrize("seed", range(8))
def test_simulated_sea_states_have_their_own_damage(seed, axes):
    draw = np.random.default_rng((seed, axes))
    of = drawn(draw, axes)
    index = tuple(draw.integers(0, n, 20) for n in of.rates.shape[:-1])
    values = {axis: places[k] for (axis, places), k in zip(of.grid.items(), index, strict=True)}
    shares = draw.uniform(0.0, 1.0, 20)
    np.testing.assert_allclose(of.sums(values, shares), shares[:, None] * of.rates[index], atol=1e-12)


@pytest.mark.parametrize("axes", [1, 2, 3])
@pytest.mark.parametrize("seed", range(8))
def test_along_one_axis_the_fourth_root_is_the_cubic_function_of_scipy(seed, axes):
    """Whatever the other axes, if the sea states have simulated values of these."""
    draw = np.random.default_rng((seed, axes, 1))
    of = drawn(draw, axes)
    free = int(draw.integers(axes))
    there = [int(draw.integers(n)) for n in of.rates.shape[:-1]]
    names, places = list(of.grid), list(of.grid.values())
    values = {name: np.full(30, p[k]) for name, p, k in zip(names, places, there, strict=True)}
    values[names[free]] = draw.uniform(places[free][0], places[free][-1], 30)
    there[free] = slice(None)
    line = of.rates[tuple(there)] ** 0.25
    expected = np.tile(line, (30, 1))
    if len(line) > 1:
        expected = PchipInterpolator(places[free], line)(values[names[free]])
    found = of.sums(values, np.ones(30)) ** 0.25
    np.testing.assert_allclose(found, expected, atol=1e-6)


@pytest.mark.parametrize("seed", range(8))
def test_a_fourth_root_that_is_linear_in_all_axes_is_exact(seed):
    """As the damage of a slope of four is, of a stress in proportion to the height."""
    draw = np.random.default_rng((seed, 2))
    heights, periods = (np.sort(draw.uniform(1.0, 10.0, n)) for n in (4, 5))
    factors = draw.uniform(0.1, 1.0, 3)

    def root(height, period):
        return factors[0] + factors[1] * height + factors[2] * period

    of = Response({"h": heights, "t": periods}, root(heights[:, None], periods) ** 4)
    values = {"h": draw.uniform(heights[0], heights[-1], 40), "t": draw.uniform(periods[0], periods[-1], 40)}
    np.testing.assert_allclose(of.sums(values, np.ones(40)), root(values["h"], values["t"]) ** 4, rtol=1e-9)
