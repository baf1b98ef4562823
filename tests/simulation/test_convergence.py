"""The choice of mesh or step to halve, on errors that are known: sums of powers of both, without any run."""

import numpy as np
import pytest

from riserstudy.simulation.convergence import RUNS, Convergence

TOLERANCE = {"displacement": 0.002, "moment": 0.01, "tension": 0.01}


class Law:
    """Relative errors by number of halvings: each quantity has a part of the mesh and a part of the step."""

    def __init__(self, seed):
        random = np.random.default_rng(seed)
        self.order = {"mesh": random.choice([2.0, 4.0]), "step": random.choice([1.0, 2.0, 3.0])}
        self.size = {
            way: {name: 10.0 ** random.uniform(-3.5, -0.5) for name in TOLERANCE} for way in self.order
        }

    def value(self, name, halvings):
        """What a run gives for a quantity whose exact value is 1."""
        return 1.0 + sum(
            self.size[way][name] * 2.0 ** (-self.order[way] * halvings[way]) for way in self.order
        )

    def change(self, coarse, fine):
        return {name: abs(self.value(name, coarse) - self.value(name, fine)) for name in TOLERANCE}


def refined(law):
    """Halve as `Convergence` chooses; errors, halvings by way, and whether the tolerance was reached."""
    errors, halvings = Convergence(TOLERANCE, ["mesh", "step"]), {"mesh": 0, "step": 0}
    errors.note_run({})
    for _ in range(RUNS):
        if stale := errors.stale:
            runs = [halvings | {stale: halvings[stale] - k} for k in range(3) if halvings[stale] >= k]
            changes = [law.change(*pair) for pair in zip(runs[1:], runs, strict=False)]
            errors.enter_again(stale, changes)
        way = errors.next_way()
        if way is None:
            return errors, halvings, True
        before, errors.way = dict(halvings), way
        halvings[way] += 1
        errors.enter(law.change(before, halvings), {})
        errors.note_run({})
    return errors, halvings, False


@pytest.mark.parametrize("seed", range(200))
def test_true_errors_are_within_tolerance_and_estimates(seed):
    law = Law(seed)
    errors, halvings, reached = refined(law)
    assert reached
    for name, limit in TOLERANCE.items():
        true = law.value(name, halvings) - 1.0
        assert true <= limit
        assert true <= 1.001 * errors.estimated[name]


class MixedLaw(Law):
    """Each part is of second order, and behind a larger one of third or fourth order on coarse meshes."""

    def __init__(self, seed):
        super().__init__(seed)
        random = np.random.default_rng((seed, 1))
        self.order = dict.fromkeys(self.order, 2.0)
        self.steep = {way: random.choice([3.0, 4.0]) for way in self.order}
        self.more = {way: 10.0 ** random.uniform(0.0, 2.0) for way in self.order}

    def value(self, name, halvings):
        return super().value(name, halvings) + sum(
            self.more[way] * self.size[way][name] * 2.0 ** (-self.steep[way] * halvings[way])
            for way in self.order
        )


@pytest.mark.parametrize("seed", range(200))
def test_an_error_of_second_order_is_not_hidden_by_one_that_decreases_faster(seed):
    law = MixedLaw(seed)
    errors, halvings, reached = refined(law)
    assert reached
    for name in TOLERANCE:
        assert law.value(name, halvings) - 1.0 <= 1.001 * errors.estimated[name]


@pytest.mark.parametrize("seed", range(200))
def test_no_way_is_halved_that_was_exact_enough(seed):
    """Of mesh and step, one is never halved more often than it alone needs, but for two more halvings."""
    law = Law(seed)
    _, halvings, _ = refined(law)
    for way, order in law.order.items():
        needed = max(
            np.log2(2.0 * law.size[way][name] / TOLERANCE[name]) / order for name in TOLERANCE
        )  # half of the tolerance for each
        assert halvings[way] <= max(np.ceil(needed), 0.0) + 2.0


def test_the_other_is_halved_when_halving_one_does_not_help():
    errors = Convergence({"moment": 0.01}, ["mesh", "step"])
    assert errors.unknown == ["mesh", "step"]
    for way, change in (("mesh", 0.5), ("step", 0.1), ("mesh", 0.49)):
        assert errors.next_way() == way
        errors.way = way
        errors.enter({"moment": change}, {})
    assert errors.next_way() == "step"


def test_time_left_is_the_sum_of_runs_that_take_twice_as_long_each():
    errors = Convergence({"moment": 0.01}, ["mesh"])
    errors.enter({"moment": 0.5}, {})
    four_runs = errors.excess(errors.error) / 4.0**3
    assert 1.0 < four_runs <= 4.0  # errors fall to a quarter each: four more runs
    assert errors.time_left(3.0) == pytest.approx(3.0 * (2.0 + 4.0 + 8.0 + 16.0))


@pytest.mark.parametrize("seed", range(30))
def test_time_left_is_that_of_the_fewest_halvings_of_both(seed):
    """Against all ways to divide halvings between mesh and step; each quarters the error of one."""
    draw = np.random.default_rng(seed)
    errors = Convergence({"moment": 0.01}, ["mesh", "step"])
    for errors.way in ("mesh", "step"):
        errors.enter({"moment": 0.01 * 10.0 ** draw.uniform(-1.0, 3.0)}, {})
    mesh, step = (errors.excess(errors.halved[way].error) for way in ("mesh", "step"))
    enough = [
        count
        for count in range(1, RUNS)
        if any(mesh / 4.0**k + step / 4.0 ** (count - k) <= 1.0 for k in range(count + 1))
    ]
    seconds = draw.uniform(0.1, 9.0)
    assert errors.time_left(seconds) == pytest.approx(sum(seconds * 2.0**k for k in range(1, enough[0] + 1)))


@pytest.mark.parametrize("first, other", [("mesh", "step"), ("step", "mesh")])
def test_each_of_both_gives_way_to_the_other(first, other):
    errors = Convergence({"moment": 0.01}, ["mesh", "step"])
    for errors.way, change in (("mesh", 0.2), ("step", 0.2), (first, 0.19)):
        errors.enter({"moment": change}, {})
    assert errors.next_way() == other
