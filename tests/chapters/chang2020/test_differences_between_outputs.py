"""Differences and smallest pulls of Chang et al. 2020 whose peaks lie between the outputs."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.chang2020 import claims
from riserstudy.grading.words_of_size_file import read_words

WORD = read_words(Path(__file__).parents[3] / "config").word
ENDS = (60.0, 41.3)  # s, of the records of two samples


def free(draw, size):
    """A free oscillation at 2.63 s on a slow heave, as a function of time."""
    late, slow = draw.uniform(0.0, 6.0), draw.uniform(10.0, 25.0)
    return lambda t: size * np.cos(2.0 * np.pi * t / 2.63 - late) + np.sin(2.0 * np.pi * t / slow)


def recorded(curves, rest):
    """Heave of two samples at 3 and 10 m, and the pull of two cylinders, which follows the heave."""
    time = np.arange(0.0, ENDS[0], 0.25)
    z = np.stack(
        [[np.where(time <= end, of(time), np.nan)] * 2 for of, end in zip(curves, ENDS, strict=True)]
    )
    dims = ("sample", "heave_amplitude", "time")
    return xr.Dataset(
        {
            "z": ((*dims, "s"), (2394.0 + z)[..., None]),
            "z_static": ((*dims[:2], "s_node"), np.full((2, 2, 1), 2394.0 + rest)),
            "tensioner_force": ((*dims, "cylinder"), np.stack([5e6 + 1e5 * z, 5e6 + 2e5 * z], axis=-1)),
        },
        {"heave_amplitude": [3.0, 10.0], "time": time},
    )


@pytest.mark.parametrize("seed", range(6))
def test_the_largest_difference_is_that_of_the_motions_not_of_their_outputs(seed):
    draw = np.random.default_rng(seed)
    one, other = ([free(draw, size) for size in draw.uniform(0.5, 2.0, 2)] for _ in range(2))
    gas, linear = recorded(one, 1.0), recorded(other, 1.3)
    found = claims.agree(gas, linear, 3.0, WORD("agree extremely well")).value
    more = claims.keeps_more_pull(gas, linear, [3.0], WORD("larger")).value.isel(heave_amplitude=0)
    for k, end in enumerate(ENDS):
        last = gas["time"].values[gas["time"].values <= end][-1]
        t = np.linspace(0.0, last, 200001)
        mine, theirs = one[k](t), other[k](t)
        apart = min(abs(theirs - mine).max(), abs(theirs - mine - 0.3).max()) / np.ptp(mine)
        # a spline of fifth degree through ten outputs in a period
        assert float(found[k]) == pytest.approx(apart, rel=1e-3)
        assert float(more[k]) == pytest.approx(0.3 * (mine.min() - theirs.min()), abs=3e-4)
