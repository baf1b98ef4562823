"""Open datasets: one file, or all files of a results folder as one tree."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from riserstudy.dataset.netcdf import load, refuse_damaged
from riserstudy.dataset.other_files import refuse_other_files
from riserstudy.errors import InputError

if TYPE_CHECKING:
    import xarray as xr


def open_results(folder: str | Path = "results") -> xr.DataTree:
    """Open all datasets of a results folder as a tree, for example ``tree["chang2020/asymmetry"]``.

    Parameters
    ----------
    folder : str or Path
        The results folder.

    Returns
    -------
    xarray.DataTree
        One node for each dataset ``<paper>/<name>.nc``. Arrays are read from the file on first use.

    Raises
    ------
    InputError
        When the folder contains no dataset, or a dataset is damaged or refers to other files.
    """
    import xarray as xr

    files = sorted(Path(folder).glob("*/*.nc"))
    if not files:
        raise InputError(folder, "", "the folder contains no datasets", "run `make study` first")
    for file in files:
        refuse_damaged(file)
        refuse_other_files(file)
    nodes = {f"/{file.parent.name}/{file.stem}": xr.open_dataset(file, engine="netcdf4") for file in files}
    return xr.DataTree.from_dict(nodes)


def open_dataset(path: Path) -> xr.Dataset:
    """A dataset, with times as plain numbers (s). Raises InputError when it cannot be read, or is damaged."""
    if not Path(path).exists():
        raise InputError(path, "", "there is no such file", "give the path of a dataset")
    try:
        return load(path, decode_times=False)
    except (OSError, ValueError, RuntimeError):
        scene = path.suffix in (".yaml", ".yml")
        how = (
            f"simulate this scene first: riserstudy run {path} -o OUT.nc"
            if scene
            else "repeat the command that writes it"
        )
        raise InputError(path, "", "this is not a dataset of riserstudy", how) from None
