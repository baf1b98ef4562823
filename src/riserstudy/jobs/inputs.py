"""Files that jobs read."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from riserstudy.errors import InputError

if TYPE_CHECKING:
    import xarray as xr


def datasets_of(sources: list[Path]) -> dict[str, xr.Dataset]:
    """Return the datasets of files by their names."""
    import xarray as xr

    return {source.stem: xr.load_dataset(source, engine="netcdf4") for source in sources}


def text_of(source: Path) -> str:
    """Return the text of a table. Raises InputError when the file cannot be read."""
    try:
        return source.read_text("utf-8")
    except OSError as error:
        raise InputError(source, "", str(error.strerror), "run its job again") from None
