"""Shares of variance by other ways: the F statistic of groups, and pairs of cells with one other input."""

from itertools import combinations

import numpy as np
import pytest
import xarray as xr
from scipy.stats import f_oneway

from riserstudy.grading.sensitivity import _groups, correlation_ratio, total_effects


@pytest.mark.parametrize("seed", range(20))
def test_the_correlation_ratio_follows_from_the_f_statistic(seed):
    """Epsilon squared: (F - 1) a / (F a + b), with a and b degrees of freedom between and within groups."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(2, 6))
    group = np.r_[np.arange(count), draw.integers(0, count, int(draw.integers(count + 2, 60)))]
    values = (draw.random((3, len(group))) < draw.uniform(0.2, 0.8, count)[group]).astype(float)
    values[0] += 0.01 * draw.normal(size=len(group))
    values[:, :2] = [0.0, 1.0]
    for own, found in zip(values, correlation_ratio(values, group), strict=True):
        f = float(f_oneway(*(own[group == k] for k in range(count))).statistic)
        a, b = count - 1, len(group) - count
        expected = 1.0 if np.isinf(f) else (f - 1.0) * a / (f * a + b)
        assert found == pytest.approx(max(expected, 0.0))


@pytest.mark.parametrize("seed", range(20))
def test_total_effects_are_those_of_pairs_of_cells(seed):
    """Half of the mean square of differences of cells that differ in one input alone (Jansen)."""
    draw = np.random.default_rng(seed)
    shape = tuple(int(one) for one in draw.integers(2, 5, 3))
    answers = draw.choice([-1.0, 0.0, 1.0], shape)
    answers.flat[:2] = -1.0, 1.0
    found = total_effects(xr.DataArray(answers, dims=("a", "b", "c")))
    hits = (answers > 0.0).astype(float)
    for axis, name in enumerate("abc"):
        lines = np.moveaxis(hits, axis, 0).reshape(shape[axis], -1)
        squares = [sum((one - other) ** 2 for one, other in combinations(line, 2)) for line in lines.T]
        assert found[name] == pytest.approx(np.mean(squares) / shape[axis] ** 2 / hits.var())


@pytest.mark.parametrize("seed", range(20))
def test_ranges_have_equally_filled_groups_in_their_order_and_options_have_their_own(seed):
    draw = np.random.default_rng(seed)
    values = draw.permutation(draw.uniform(-5.0, 30.0, int(draw.integers(9, 200))))
    written = np.array([f"{value!r} kN/m" for value in values.tolist()]) if seed % 2 else values
    group = _groups(written)
    assert (np.diff(group[values.argsort()]) >= 0).all()
    sizes = np.bincount(group)
    assert len(sizes) == max(2, min(8, len(values) // 4))
    assert sizes.max() - sizes.min() <= 1
    options = draw.choice(["tangent", "secant", "none"], 30)
    of = _groups(options)
    assert all((of[i] == of[j]) == (options[i] == options[j]) for i, j in combinations(range(30), 2))
