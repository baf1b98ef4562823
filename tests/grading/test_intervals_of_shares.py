"""The interval of a share of samples, against the closed form of Wilson."""

import math

import numpy as np
import pytest
import xarray as xr

from riserstudy.grading.confidence import MANY, share_with_interval
from riserstudy.grading.found import FALSE, NO_DIFFERENCE, TRUE

NORMAL = 1.959964  # of 95 % to both sides


@pytest.mark.parametrize("seed", range(30))
def test_all_cells_of_a_sample_are_one_draw(seed):
    """Cells of one sample are not independent, so that they do not narrow the interval."""
    draw = np.random.default_rng(seed)
    samples, cells = int(draw.integers(MANY - 10, 300)), int(draw.integers(1, 4))
    answers = np.array([TRUE, FALSE, NO_DIFFERENCE, math.nan])
    found = answers[draw.choice(4, (samples, cells), p=draw.dirichlet([4.0, 2.0, 1.0, 1.0]))]
    found[draw.random(samples) < 0.1] = math.nan
    array = xr.DataArray(found, dims=("sample", "reading"))
    if seed % 2:
        array = array.transpose("reading", "sample")
    share = share_with_interval(array)
    known = [row for row in found.tolist() if any(cell == cell for cell in row)]
    flat = [cell for row in known for cell in row if cell == cell]
    assert (share.met, share.samples, share.draws) == (flat.count(TRUE), len(flat), len(known))
    assert share.same == flat.count(NO_DIFFERENCE)
    n = len(known)
    if n < MANY:
        assert (share.low, share.high) == (None, None)
        return
    p, z = round(flat.count(TRUE) * n / len(flat)) / n, NORMAL
    middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    wide = z / (1 + z**2 / n) * math.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
    assert (share.low, share.high) == pytest.approx((middle - wide, middle + wide), abs=1e-6)


@pytest.mark.parametrize("seed", range(5))
def test_a_grid_without_samples_has_no_draws(seed):
    found = np.random.default_rng(seed).choice([TRUE, FALSE, math.nan], (20, 20))
    share = share_with_interval(xr.DataArray(found, dims=("a", "b")))
    assert (share.met, share.draws, share.low) == ((found == TRUE).sum(), None, None)
