"""The addition of a sea, against seas that are drawn from a known distribution."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from riserstudy.design import sea_allowances
from riserstudy.design.sea_allowances import allowance


@pytest.mark.parametrize("seed", range(8))
def test_nine_seas_in_ten_do_not_exceed_the_addition(seed):
    """The distribution of extremes is a Gumbel distribution, of which many seeds are known."""
    draw = np.random.default_rng(seed)
    mode, scale = draw.uniform(0.1, 5.0), draw.uniform(0.05, 1.0)
    found = allowance(draw.gumbel(mode, scale, 20000))
    others = draw.gumbel(mode, scale, 40000)
    assert (others <= found).mean() == pytest.approx(0.9, abs=0.01)
    assert found == pytest.approx(mode - scale * math.log(-math.log(0.9)), rel=0.01)


@pytest.mark.parametrize("seeds", [5, 6, 10, 25, 130])
def test_nine_in_ten_further_seas_do_not_exceed_the_addition_of_few_seeds(seeds):
    """On average over sets of seeds; the fractile of a distribution fitted to few seeds is too low."""
    draw = np.random.default_rng(seeds)
    mode, scale = draw.uniform(2.0, 5.0), draw.uniform(0.05, 0.5)
    found = np.array([allowance(draw.gumbel(mode, scale, seeds)) for _ in range(800)])
    shares = np.exp(-np.exp(-(found - mode) / scale))
    # three standard errors of the mean of 800 sets; without allowance for few seeds, 0.826 of five
    assert shares.mean() == pytest.approx(0.9, abs=3.0 * shares.std() / math.sqrt(len(shares)))


@pytest.mark.parametrize("longer", [0.5, 4.0, 30.0])
@pytest.mark.parametrize("seeds", [5, 20])
def test_nine_in_ten_longer_seas_do_not_exceed_their_addition(seeds, longer):
    """Against the largest of so many drawn seas; half a sea has the root of their distribution."""
    draw = np.random.default_rng((seeds, int(longer)))
    mode, scale = draw.uniform(2.0, 5.0), draw.uniform(0.05, 0.3)
    found = np.array([allowance(draw.gumbel(mode, scale, seeds), longer) for _ in range(800)])
    if longer > 1.0:
        others = draw.gumbel(mode, scale, (4000, int(longer))).max(axis=1)
        shares = (others[:, None] <= found).mean(axis=0)
    else:
        shares = np.exp(-longer * np.exp(-(found - mode) / scale))
    assert shares.mean() == pytest.approx(0.9, abs=3.0 * shares.std() / math.sqrt(len(shares)) + 0.005)


@pytest.mark.parametrize("value", [-2.0, 0.0, 3.0])
def test_a_sea_that_only_relieves_adds_nothing(value):
    assert allowance(np.full(5, value)) == max(value, 0.0)
    assert allowance(np.array([value])) == max(value, 0.0)


@pytest.mark.parametrize("side", ["largest", "mean"])
@pytest.mark.parametrize("lacking", [True, False])
@pytest.mark.parametrize("seed", range(6))
def test_an_allowance_is_unknown_where_it_is_unknown_at_any_place_in_any_seed(
    seed, lacking, side, monkeypatch
):
    """Whichever place and seed it is, and whether the place is absent or not a number."""
    draw = np.random.default_rng(seed)
    each = [{name: float(draw.uniform(0.1, 1.0)) for name in "abc"} for _ in range(4)]
    of = {"_shifted" if side == "mean" else "_added": lambda scene, limit, one: one}
    for name, function in of.items():
        monkeypatch.setattr(sea_allowances, name, function)
    limit = SimpleNamespace(side=side, output="von_mises_stress")
    scene = SimpleNamespace(analysis=SimpleNamespace(mesh=None))
    known = sea_allowances._of_limit(scene, limit, each, 1.0)
    assert not known.missing
    assert known.value == max(known.by_place.values())
    one, name = each[draw.integers(4)], str(draw.choice(list("abc")))
    one.pop(name) if lacking else one.update({name: math.nan})
    found = sea_allowances._of_limit(scene, limit, each, 1.0)
    assert found.missing
    assert math.isnan(found.value)
