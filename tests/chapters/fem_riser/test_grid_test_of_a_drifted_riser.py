"""The error of elements and time steps does not depend on the drift of the riser's top."""

import numpy as np
import pytest
import xarray as xr

from chapters.fem_riser.claims import difference, grid_suffices
from chapters.fem_riser.derived import BEAM, sample_error
from riserstudy.grading.grade import answers
from tests.chapters.fem_riser.test_measures_of_a_riser import bent


def samples(seed, drift, sign=1.0):
    """Coarse and fine runs of a few samples that bow to either side, with a drift (m) of their tops."""
    draw = np.random.default_rng(seed)
    levels, moments = draw.uniform(2.0, 80.0, 6), draw.uniform(1e4, 5e5, 6)
    sides, wrong = draw.choice([-1.0, 1.0], 6), draw.uniform(-0.1, 0.1, (2, 6))
    parts = {}
    for name, share in (("coarse", wrong), ("fine", 0.0 * wrong)):
        made = [
            bent(
                sign * drift,
                sign * sides[k] * levels[k] * (1.0 + share[0, k]),
                0.0,
                0.0,
                (0.0, sign * moments[k] * (1.0 + share[1, k])),
            )[0]
            for k in range(6)
        ]
        numbers = xr.DataArray(np.arange(6), dims="sample", name="sample")
        parts[name] = xr.concat(made, numbers, combine_attrs="override")
    return parts["coarse"], parts["fine"], abs(wrong)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("drift", [3.0, -40.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_error_is_the_larger_of_bow_and_moment_whatever_the_drift(seed, drift, sign):
    coarse, fine, wrong = samples(seed, drift, sign)
    np.testing.assert_allclose(difference(coarse, fine), wrong.max(axis=0), rtol=1e-6)


def test_a_missing_deflection_is_not_judged_by_the_moment_alone():
    coarse, fine, _ = samples(0, 0.0)
    fine = fine.assign(x_max=fine["x_max"].where(fine["sample"] != 2))
    found = answers(grid_suffices(coarse, fine, "5 m", 0.2, 0.2))
    assert found.isnull().values.tolist() == [False, False, True, False, False, False]


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("drift", [200.0, -200.0])
def test_the_error_of_a_sample_is_that_of_its_bow(seed, drift):
    coarse, fine, wrong = samples(seed, drift)
    found = sample_error(fine, coarse.expand_dims(solver=[BEAM]))
    np.testing.assert_allclose(found["deflection"], wrong[0], rtol=1e-6)
