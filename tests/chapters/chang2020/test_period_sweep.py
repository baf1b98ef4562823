"""The title of the sweep over periods says no more than its runs."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.chapters.draw import draw

PERIODS = [2.0, 2.6, 5.2, 5.3, 10.0]


def swept(*indices):
    """A steady state at each period, with the asymmetry index that is given for the last three."""
    down = np.array([1.0, 30.0, 1.0, 1.0, 1.0])
    up = down * [1.0, 1.0, *indices]
    dims = ("tensioner_model", "heave_amplitude", "heave_period", "s_node")
    shape = (2, 2, len(PERIODS), 1)

    def of(values):
        return dims, np.broadcast_to(np.reshape(values, (1, 1, -1, 1)), shape).copy()

    coords = {"tensioner_model": ["gas law", "linear"], "heave_amplitude": [0.02, 0.1]}
    return xr.Dataset(
        {"z_max": of(up), "z_min": of(-down), "z_static": of(0.0 * up)}, coords | {"heave_period": PERIODS}
    )


@pytest.mark.parametrize(
    "indices, title",
    [
        ((0.9, 1.1, 1.01), "Asymmetry reverses at about twice the resonance period"),
        ((1.1, 1.2, 0.95), "Asymmetry reverses near 10 s"),
        ((1.02, 1.1, 1.01), "Asymmetry is largest near 5.3 s"),
        ((1.1, 1.05, 1.01), "Asymmetry is largest at about twice the resonance period"),
    ],
)
def test_asymmetry_reverses_only_where_the_index_is_on_both_sides_of_one(indices, title):
    figure = draw("chang2020", "period_sweep", {"period_sweep": swept(*indices)}, {})
    assert figure.get_suptitle() == title
