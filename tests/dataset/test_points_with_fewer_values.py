"""A point of a study has no values along a dimension of runs that only other points have."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.extremes import OF_A_RUN
from riserstudy.dataset.place import complete, own_values


@pytest.mark.parametrize("dim", OF_A_RUN)
@pytest.mark.parametrize("seed", range(4))
def test_a_point_has_its_own_values_alone(dim, seed):
    """Such as the angles of a wall, of which a point may have every second one."""
    draw = np.random.default_rng(seed)
    sizes = {one: int(draw.integers(4, 7)) for one in OF_A_RUN}
    own = np.sort(draw.choice(sizes[dim], int(draw.integers(1, 4)), replace=False))
    values = xr.DataArray(draw.normal(size=(2, *sizes.values())), dims=("point", *sizes))
    few = values.isel(point=0).where(xr.DataArray(np.isin(np.arange(sizes[dim]), own), dims=dim))
    whole = xr.concat([few, values.isel(point=1)], "point")
    coords = {one: np.arange(float(size)) for one, size in sizes.items()}
    study = xr.Dataset({"found": whole, "step": ("point", [0.1, 0.1])}, coords)
    study["point_key"] = ("point", ["a", "b"])
    for select in (own_values, complete):
        alone, other = (select(study.isel(point=k)) for k in (0, 1))
        assert alone[dim].values.tolist() == own.tolist()
        assert not alone["found"].isnull().any()
        assert dict(other["found"].sizes) == sizes
