"""Halvings of mesh and step: the remaining error of a known order, and what may be chance."""

import numpy as np
import pytest

from riserstudy.simulation.halved import UNKNOWN_FALL, Halved, enter, error_of

NAMES = ("displacement", "moment", "ufj_angle")


def changes(draw, ratio):
    """Changes by two halvings, and the remaining errors, if each halving divides the errors by a ratio."""
    first = {name: float(draw.uniform(0.01, 0.2)) for name in NAMES}
    second, left = ({name: value / ratio**k for name, value in first.items()} for k in (1, 2))
    of = [{n: a[n] - b[n] for n in NAMES} for a, b in ((first, second), (second, left))]
    return *of, left


@pytest.mark.parametrize("seed", range(6))
def test_the_remaining_error_of_a_known_order_is_exact(seed):
    draw = np.random.default_rng(seed)
    ratio = float(draw.uniform(1.6, 3.9))
    first, second, left = changes(draw, ratio)
    seen = {}
    assert enter(seen, "mesh", first).fall == UNKNOWN_FALL
    now = enter(seen, "mesh", second)
    assert now.fall == pytest.approx(ratio)
    assert now.error == pytest.approx(left)
    assert error_of(seen.values(), {}) == pytest.approx(left)
    # errors that grow do not fall
    assert Halved(first, Halved(second, None)).fall == 1.0


@pytest.mark.parametrize("seed", range(6))
def test_errors_of_mesh_and_step_add_up_and_chance_is_added(seed):
    draw = np.random.default_rng(seed)
    seen, left = {}, []
    for way, ratio in (("mesh", 2.5), ("step", 3.5)):
        first, second, remaining = changes(draw, ratio)
        enter(seen, way, first)
        enter(seen, way, second)
        left.append(remaining)
    assert (seen["mesh"].since, seen["step"].since) == (2, 0)
    both = {name: left[0][name] + left[1][name] for name in NAMES}
    assert error_of(seen.values(), {}) == pytest.approx(both)
    chance = {name: float(draw.uniform(0.0, 0.1)) for name in NAMES[:2]}
    with_it = {name: both[name] + chance.get(name, 0.0) for name in NAMES}
    assert error_of(seen.values(), chance) == pytest.approx(with_it)
    double, moment = seen["mesh"].scaled({"moment": 2.0}), seen["mesh"].change["moment"]
    assert double.error == double.above == pytest.approx(left[0] | {"moment": 2.0 * left[0]["moment"]})
    assert double.change == pytest.approx(seen["mesh"].change | {"moment": 2.0 * moment})
    assert seen["mesh"].error == pytest.approx(left[0])  # unchanged


@pytest.mark.parametrize("seed", range(6))
def test_a_change_within_chance_counts_as_it_is_and_not_by_what_may_remain(seed):
    draw = np.random.default_rng(seed)
    change = {name: float(draw.uniform(0.01, 0.2)) for name in NAMES}
    floor = {"moment": 1.5 * change["moment"], "ufj_angle": 0.5 * change["ufj_angle"]}
    plain, now = Halved(change, None), Halved(change, None, floor)
    assert now.above == {name: plain.error[name] for name in ("displacement", "ufj_angle")}
    assert now.within == {"moment": change["moment"]}
    expected = plain.error | {"moment": change["moment"]}
    assert error_of([now], {}) == pytest.approx(expected)
    assert error_of([now], {"moment": 3.0 * change["moment"]})["moment"] == 3.0 * change["moment"]
