"""Points that represent a study: all its marks, in an order that its seed draws; and all others, if asked."""

from types import SimpleNamespace

import numpy as np
import pytest

from riserstudy.study.axes import Numbers, Samples
from riserstudy.study.corners import corners, others

UNITS = ("kN", "MN*m/deg", "1", "kg/m")


def study(axes, samples=None):
    """A study with axes of a kind and a length each, and what its samples assume."""
    kinds = {"numbers": Numbers.model_construct(), "samples": Samples.model_construct()}
    return SimpleNamespace(
        axes={name: range(length) for name, (_, length) in axes.items()},
        model=SimpleNamespace(axes={name: kinds.get(kind, {}) for name, (kind, _) in axes.items()}),
        assumed=lambda _: samples,
    )


@pytest.mark.parametrize("seed", range(10))
def test_all_labels_and_the_middle_come_before_any_repeats(seed):
    """Of an axis with n labels, each n successive points before repetition have all; corners are joint."""
    draw = np.random.default_rng(seed)
    numbers, labels = (int(n) for n in draw.integers(3, 9, 2))
    of = study({"load": ("numbers", numbers), "end": ("labels", labels)})
    assert {point[1] for point in corners(of, labels, seed)} == {*range(labels)}
    every = corners(of, 100, seed)
    assert set(every) == {(k, end) for k in {0, numbers // 2, numbers - 1} for end in range(labels)}
    assert len(every) == len(set(every))
    assert corners(of, 4, seed) == every[:4]


@pytest.mark.parametrize("seed", range(5))
def test_others_are_as_many_different_points_as_there_are(seed):
    draw = np.random.default_rng(seed)
    lengths = [int(n) for n in draw.integers(1, 7, 3)]
    of = study(dict(zip("abc", (("numbers", n) for n in lengths), strict=True)))
    without = corners(of, 2, seed)
    rest = {tuple(map(int, index)) for index in np.ndindex(*lengths)} - set(without)
    assert set(others(of, without, len(rest) + 7, seed)) == rest
    for count in range(len(rest) + 1):
        found = others(of, without, count, seed)
        assert len(found) == len(set(found)) == count
        assert set(found) <= rest


def test_another_seed_draws_another_order_of_the_same_points():
    of = study({"load": ("numbers", 9), "end": ("labels", 5)})
    for points in (lambda seed: corners(of, 100, seed), lambda seed: others(of, [], 45, seed)):
        orders = [points(seed) for seed in range(10)]
        assert len(set(map(tuple, orders))) == 10
        assert len(set(map(frozenset, orders))) == 1
        assert points(3) == orders[3]


@pytest.mark.parametrize("seed", range(20))
def test_samples_are_marked_by_the_ends_of_ranges_and_by_all_options(seed):
    """Numbers of any size, in words with a unit or alone; options, which may begin with a number."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(5, 30))
    size = 10.0 ** draw.uniform(-12.0, 12.0, count)
    assumed = {
        "loads": size.tolist(),
        "words": [f"{value!r} {draw.choice(UNITS)}" for value in draw.permutation(size).tolist()],
        "alone": [f"{value!r}" for value in draw.permutation(size).tolist()],
        "counts": [int(n) for n in draw.permutation(count) * 3],
    }
    options = ["4-pin", "e.2", "free", "1.2.3 of a list"]
    chosen = [options[k] for k in draw.integers(0, 4, count)]
    switch = [bool(one) for one in draw.integers(0, 2, count)]
    samples = [
        {**{name: values[k] for name, values in assumed.items()}, "end": chosen[k], "on": switch[k]}
        for k in range(count)
    ]
    of = study({"sample": ("samples", count)}, samples)
    marked = {index for (index,) in corners(of, 100, seed)}
    ends = set()
    for values in assumed.values():
        plain = [float(str(value).split()[0]) for value in values]
        ends |= {int(np.argmin(plain)), int(np.argmax(plain))}
    ends |= {chosen.index(one) for one in chosen} | {switch.index(one) for one in switch}
    assert marked == ends
