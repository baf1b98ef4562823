"""Tables of damage over years: life, errors and shares, also without damage or with several seeds."""

import json

import numpy as np
import pytest
from test_years import study, summed, table

from riserstudy.fatigue import tables
from riserstudy.fatigue.years import gamma_of


def drawn(seed, tmp_path):
    """A scatter table of drawn sea states."""
    draw = np.random.default_rng(seed)
    heights, periods = draw.uniform(1.0, 9.0, 6).tolist(), draw.uniform(5.0, 17.0, 6).tolist()
    rows = [f"{h!r},{p!r},{draw.uniform(1.0, 16.0)!r}" for h, p in zip(heights, periods, strict=True)]
    return table(tmp_path, "\n".join(["hs (m),tp (s),share (%)", *rows]) + "\n")


def columns(of):
    """Cells of a table by the names of its columns."""
    return {name: [row[k] for row in of.rows] for k, name in enumerate(of.columns)}


@pytest.mark.parametrize("seed", range(5))
def test_a_life_is_the_inverse_of_the_factored_damage(seed, tmp_path):
    found = summed(study(seeds=(1, 2)), drawn(seed, tmp_path))
    of = columns(tables.of_details(found))
    for k, worst in enumerate(found.worst):
        assert of["factored damage"][k] == pytest.approx(of["damage"][k] * of["safety factor"][k])
        assert of["life"][k] * of["factored damage"][k] == pytest.approx(1.0)
        assert of["error between seas"][k] == pytest.approx(100.0 * worst.error_between)
        # one seed has 1.1 times the damage of the other: the mean is 1.05, its standard error 0.05
        assert of["chance of seeds"][k] == pytest.approx(100.0 * 0.05 / 1.05)
    along = columns(tables.along(found))
    for worst in found.worst:
        plain = [cell for cell in along[f"damage of {worst.detail}"] if cell is not None]
        assert max(plain) == pytest.approx(worst.rate)
    seas = columns(tables.by_sea(found))
    assert sum(seas["time"]) == pytest.approx(100.0 * sum(sea.share for sea in found.seas))
    assert seas["together"] == pytest.approx(np.cumsum(seas["share"]))


@pytest.mark.parametrize("seed", range(3))
def test_without_damage_there_is_no_life_and_no_share(seed, tmp_path):
    found = summed(study(by=lambda height, period, power: 0.0 * height), drawn(seed, tmp_path))
    of = columns(tables.of_details(found))
    assert of["life"] == [None, None]
    assert of["chance of seeds"] == [None, None]  # one seed
    assert of["error between seas"] == [0.0, 0.0]
    assert found.by_vibration == 0.0
    assert set(columns(tables.by_sea(found))["share"]) == {0.0}


@pytest.mark.parametrize("seed", range(5))
def test_of_several_seeds_the_largest_error_of_runs_counts(seed, tmp_path):
    """In one sea state, one of three seeds has a larger error: this sea has it, and no other sea."""
    draw, of = np.random.default_rng(seed), study(seeds=(1, 2, 3))
    errors, size = of["error_damage"].values, float(draw.uniform(0.03, 0.5))
    h, p = draw.integers(errors.shape[0]), draw.integers(errors.shape[1])
    errors[h, p, draw.integers(3)] = size
    there = (float(of["significant_height"][h]), float(of["peak_period"][p]))
    path = table(tmp_path, f"hs (m),tp (s),share (%)\n{there[0]},{there[1]},40\n3.2,8.5,30\n7.1,12.1,20\n")
    found = {sea.values: sea.error for sea in summed(of, path).seas}
    assert found.pop(there) == size
    assert set(found.values()) <= {0.02}


@pytest.mark.parametrize("seed", range(4))
def test_a_platform_may_have_the_sea_of_its_own(seed):
    """Waves that move the platform, and not the riser, have their peak enhancement, too."""
    of, gamma = study(), round(float(np.random.default_rng(seed).uniform(1.0, 6.0)), 2)
    tree = json.loads(of.attrs["scene"])
    wave = tree.pop("wave") | {"peak_enhancement": gamma}
    del wave["above_mean_level"]  # of waves that move the riser
    operators = [{"period": f"{t} s", "surge": "0.5 m/m", "surge_phase": "0 deg"} for t in (5, 20)]
    tree["platform"] = {"response": {"wave": wave, "phases": "lag", "operators": operators}}
    for axis in ("significant_height", "peak_period", "seed"):
        of[axis].attrs["sets"] = of[axis].attrs["sets"].replace("wave.", "platform.response.wave.")
    of.attrs["scene"] = json.dumps(tree)
    assert gamma_of(of) == gamma
