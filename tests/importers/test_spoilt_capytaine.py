"""Datasets of Capytaine whose operators are not those of a platform at rest, or are not understood."""

import numpy as np
import pytest
import xarray as xr
from test_rao_files import capytaine

from riserstudy.errors import InputError
from riserstudy.importers.capytaine import from_capytaine


def refused(tmp_path, dataset):
    dataset.to_netcdf(tmp_path / "spoilt.nc")
    with pytest.raises(InputError) as error:
        from_capytaine(tmp_path / "spoilt.nc")
    assert error.value.where.endswith("spoilt.nc")
    return error.value.field


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("by", ["omega", "period"])
def test_a_condition_or_unit_that_would_be_ignored_is_refused(tmp_path, seed, by):
    draw = np.random.default_rng(seed)
    good = xr.load_dataset(capytaine(tmp_path / "good.nc", by, "semi__" if seed % 2 else ""))
    names = good["radiating_dof"].values.astype(object)
    one, other = draw.choice(6, 2, replace=False)
    names[one] = str(names[other]).swapcase() if seed % 2 else names[other]
    names = names.astype(str)
    degrees = np.sort(draw.uniform(7.0, 360.0, good.sizes["wave_direction"]))
    unit = str(draw.choice(["deg/m", "mm/m", "ft/ft"]))
    united = good.copy()
    united["RAO"].attrs["units"] = unit
    spoilt = {
        "forward_speed": good.assign_coords(forward_speed=float(draw.uniform(-5.0, 5.0))),
        "radiating_dof": good.assign_coords(radiating_dof=names),
        "wave_direction": good.assign_coords(wave_direction=degrees),
        by: good.drop_vars(by),
        "RAO": united,
    }
    assert {name: refused(tmp_path, dataset) for name, dataset in spoilt.items()} == {
        name: name for name in spoilt
    }
    still = good.assign_coords(forward_speed=0.0)
    still["RAO"].attrs["units"] = "m/m"
    still.to_netcdf(tmp_path / "still.nc")
    assert from_capytaine(tmp_path / "still.nc") == from_capytaine(tmp_path / "good.nc")


@pytest.mark.parametrize("part", [0, 1])
def test_operators_without_phases_are_refused(tmp_path, part):
    """Either part alone would be a motion with a phase of zero."""
    good = xr.load_dataset(capytaine(tmp_path / "good.nc"))
    assert refused(tmp_path, good.isel(complex=part, drop=True)) == "RAO"


def test_directions_that_are_missing_or_no_numbers_are_refused(tmp_path):
    good = xr.load_dataset(capytaine(tmp_path / "good.nc"))
    spoilt = [
        good.drop_vars("wave_direction"),
        good.isel(wave_direction=0, drop=True),
        good.assign_coords(wave_direction=[0.0, np.nan, 1.0]),
        good.assign_coords(wave_direction=["a", "b", "c"]),
    ]
    for dataset in spoilt:
        assert refused(tmp_path, dataset) == "wave_direction"
    assert refused(tmp_path, good.assign(RAO=good["RAO"].astype(str))) == "RAO"
