"""Write a dataset of a run, of a study or derived from studies, with all labels, to a netCDF file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from riserstudy.dataset.complete import complete
from riserstudy.dataset.netcdf import write_netcdf

if TYPE_CHECKING:
    import xarray as xr

PACKED = {"zlib": True, "complevel": 3}  # compression of large arrays
ROUNDED = {"significant_digits": 10, "quantize_mode": "GranularBitRound"}


def write_dataset(dataset: xr.Dataset, target: Path) -> None:
    """Write a netCDF file completely or not at all.

    Raises SimulationError when it cannot be written, as on a full disk.
    """
    dataset = complete(dataset)
    write_netcdf(dataset, target, _compressed(dataset))


def _compressed(dataset: xr.Dataset) -> dict[str, dict[str, Any]]:
    """Encoding that keeps ten digits of large arrays over time; other digits are noise, two fifths of a file.

    Extremes are not rounded, so a point has the same extremes in every study, large or small. The library can
    round finite numbers of ordinary size, and writes the number of digits to the variable's attributes.
    Arrays with other values are not rounded.
    """
    return {
        str(name): PACKED | (ROUNDED if _rounded(values) else {})
        for name, values in dataset.data_vars.items()
        if values.dtype.kind == "f" and values.size > 1000
    }


def _rounded(values: xr.DataArray) -> bool:
    """Whether values vary over time, have more digits, and are zero or of a size that can be rounded."""
    if "time" not in values.dims or values.dtype.itemsize < np.dtype(float).itemsize:
        return False
    size = np.abs(values.values)
    return bool(((size == 0.0) | ((size > 1e-100) & (size < 1e100))).all())
