"""Write a dataset as netCDF, completely or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from riserstudy.dataset.without import without
from riserstudy.errors import SimulationError

if TYPE_CHECKING:
    import xarray as xr


def write_netcdf(dataset: xr.Dataset, target: Path, encoding: Mapping[str, dict[str, Any]]) -> None:
    """Write a netCDF file completely or not at all.

    Raises SimulationError when it cannot be written, as on a full disk.

    Parameters
    ----------
    encoding : encoding of variables by name, as for xarray.
    """
    with written_whole(target) as partial, without("dask"):  # only dask's arrays need its locks
        dataset.to_netcdf(partial, engine="netcdf4", encoding=encoding)


@contextmanager
def written_whole(target: Path) -> Iterator[Path]:
    """The path of a temporary file, which replaces the netCDF file when it is complete.

    Raises SimulationError when it cannot be written, as on a full disk.
    """
    partial = target.with_name(f".{target.name}.{os.getpid()}")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        yield partial
        partial.replace(target)
    except (OSError, RuntimeError) as error:  # the netCDF library raises RuntimeError
        reason, remedy = _reason(error, partial), "see whether the disk is full"
        if "\\" in str(target.absolute()) and os.name == "posix":
            remedy = "the netCDF library takes no folder with a backslash in its name"
        raise SimulationError(f"{target} cannot be written: {reason}; {remedy}") from None
    finally:
        with suppress(OSError):  # if the folder cannot be written, the first error is reported
            partial.unlink(missing_ok=True)


def _reason(error: Exception, partial: Path) -> str:
    """The reason why a file cannot be written; the library also reports a full disk as missing permission."""
    try:
        partial.write_bytes(bytes(4096))
    except OSError as own:
        return own.strerror or str(own)
    return str(error)
