"""The largest damage of a conductor is that at the nodes of each run, not at nodes that all runs share."""

import numpy as np
import pytest
import xarray as xr

from chapters.design.derived.wellhead import wellhead_fatigue
from riserstudy.study.common_nodes import common_nodes

DEPTH = 48.0  # m


def runs(draw, count, segments):
    """Damage with a peak near a seabed that differs from run to run, at own nodes and at common nodes."""
    places = [np.sort(np.r_[0.0, draw.uniform(0.0, DEPTH, n - 1), DEPTH]) for n in segments]
    peaks = draw.uniform(38.0, 46.0, count)
    sizes = 10.0 ** draw.uniform(-2.0, 0.0, count)
    own = [
        size * np.exp(-np.abs(at - peak) / draw.uniform(0.5, 3.0))
        for at, peak, size in zip(places, peaks, sizes, strict=True)
    ]
    shared = common_nodes(places)
    stored = [np.interp(shared, at, rate) for at, rate in zip(places, own, strict=True)]
    return shared, np.array(stored), np.array([rate.max() for rate in own])


def dataset(over, shape, stored, shared, largest):
    """Runs as a study stores them."""
    names = ("detail", "wall_angle", "s_node")
    return xr.Dataset(
        {
            "damage_rate": ((*over, *names), stored.reshape(*shape, 1, 1, -1)),
            "value_of_statistic": ((*over, "statistic"), largest.reshape(*shape, 1)),
        },
        {"s_node": shared, "statistic": ["damage_rate max"]}
        | {name: np.arange(size) for name, size in zip(over, shape, strict=True)},
    )


@pytest.mark.parametrize("seed", range(25))
def test_damage_and_error_of_the_mesh_are_those_of_the_runs_themselves(seed):
    draw = np.random.default_rng(seed)
    count, few = 24, 5
    shared, stored, largest = runs(draw, count, draw.integers(15, 60, count))
    samples = dataset(("sample",), (count,), stored, shared, largest)
    samples["assumed_a"] = ("sample", draw.permutation(count).astype(float), {"long_name": "a"})
    shared, stored, of_meshes = runs(draw, 2 * few, np.tile([20, 40], few))
    meshes = dataset(("sample", "mesh"), (few, 2), stored, shared, of_meshes)
    found = wellhead_fatigue(samples, meshes)
    np.testing.assert_array_equal(found["damage_largest"], largest)
    coarse, fine = of_meshes.reshape(few, 2).T
    changes = [abs(c - f) / f for c, f in zip(coarse, fine, strict=True)]
    assert float(found["damage_error"]) == pytest.approx(max(changes), rel=1e-12)
