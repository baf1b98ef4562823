"""Load netCDF files, and write them completely or not at all, with a digest by which damage is found.

The digest is a line after the end of the netCDF content, which libraries do not read. netCDF has no digest of
its own for small arrays, so a wrong bit would be a wrong number. A file that another program changed has lost
its last line, and counts as that program's file.
"""

from __future__ import annotations

import hashlib
import math
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from riserstudy.dataset.other_files import refuse_other_files
from riserstudy.dataset.without import without
from riserstudy.errors import InputError, SimulationError
from riserstudy.files.letters import fault_of_letters
from riserstudy.files.whole import partial_of
from riserstudy.records.numerals import plain

if TYPE_CHECKING:
    import xarray as xr

#: the last line of a dataset, before its SHA-256
MARK = b"\nriserstudy: sha256 of all bytes before this line: "
LINE = len(MARK) + 2 * hashlib.sha256().digest_size + 1
BLOCK = 1 << 20  # bytes


def write_netcdf(dataset: xr.Dataset, target: Path, encoding: Mapping[str, dict[str, Any]]) -> None:
    """Write a netCDF file completely or not at all.

    ``encoding``: encoding of variables by name, as for xarray. Raises SimulationError when it cannot be
    written, as on a full disk.
    """
    with written_whole(target) as partial, without("dask"):  # only dask's arrays need its locks
        dataset.to_netcdf(partial, engine="netcdf4", encoding=encoding)


@contextmanager
def written_whole(target: Path) -> Iterator[Path]:
    """The path of a temporary file, which replaces the netCDF file when it is complete.

    Raises SimulationError when it cannot be written, as on a full disk.
    """
    partial = partial_of(target, str(os.getpid()))
    if fault := fault_of_letters(partial):
        raise SimulationError(f"{target} cannot be written: {'; '.join(fault)}")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        yield partial
        _append_digest(partial)
        partial.replace(target)
    except (OSError, RuntimeError) as error:  # the netCDF library raises RuntimeError
        reason, remedy = _reason(error, partial), "see whether the disk is full"
        if "\\" in str(target.absolute()) and os.name == "posix":
            remedy = "use a folder without a backslash in its name, which the netCDF library refuses"
        raise SimulationError(f"{target} cannot be written: {reason}; {remedy}") from None
    finally:
        with suppress(OSError):  # if the folder cannot be written, the first error is reported
            partial.unlink(missing_ok=True)


def refuse_damaged(path: Path) -> None:
    """Check a dataset against the digest at its end, if it has one.

    Raises InputError when it is damaged, or a pipe, for which the library would wait, or when the library
    cannot open a file by this path.
    """
    if fault := fault_of_letters(path):
        raise InputError(path, "", *fault)
    if not path.is_file():
        if path.exists() and not path.is_dir():  # the library refuses a folder itself
            raise InputError(path, "", "this is not a regular file", "give the path of a dataset")
        return
    with path.open("rb") as stream:
        size = stream.seek(0, os.SEEK_END) - LINE
        stream.seek(max(size, 0))
        line = stream.read()
        if line.startswith(MARK) and line[len(MARK) :].strip() != _digest(stream, size):
            raise InputError(path, "", "the file is damaged", "repeat the command that writes it")


def load(path: Path, **options: Any) -> xr.Dataset:
    """All values of a netCDF file, whoever wrote it; options as for `xarray.open_dataset`.

    Raises InputError when the file is damaged, refers to other files, or has more values than memory holds.
    The library raises OSError, ValueError or RuntimeError when it cannot read the file.
    """
    import xarray as xr

    refuse_damaged(path)
    refuse_other_files(path)
    refuse_too_large(path)
    return xr.load_dataset(path, engine="netcdf4", **options)


def refuse_too_large(path: Path) -> None:
    """Check that the values of a netCDF file fit into memory. Raises InputError if they do not.

    A short file can contain many values: chunks without values take no space.
    """
    import netCDF4
    import psutil

    with netCDF4.Dataset(path) as file:
        size = sum(_sizes(file))
    if size > (most := psutil.virtual_memory().total):
        found = f"the values require {plain(size / 1e9)} GB of memory, and this computer has "
        raise InputError(path, "", f"{found}{plain(most / 1e9)} GB", "give a file with fewer values")


def _sizes(group: Any) -> Iterator[int]:
    """Sizes of the variables of a netCDF file or group, as far as they are known (bytes)."""
    for variable in group.variables.values():
        yield math.prod(variable.shape) * getattr(variable.dtype, "itemsize", 1)
    for part in group.groups.values():
        yield from _sizes(part)


def _append_digest(path: Path) -> None:
    with path.open("r+b") as stream:
        digest = _digest(stream, stream.seek(0, os.SEEK_END))
        stream.seek(0, os.SEEK_END)
        stream.write(MARK + digest + b"\n")


def _digest(stream: BinaryIO, size: int) -> bytes:
    """Digest of the first bytes of a file."""
    total = hashlib.sha256()
    stream.seek(0)
    while size and (block := stream.read(min(size, BLOCK))):
        total.update(block)
        size -= len(block)
    return total.hexdigest().encode()


def _reason(error: Exception, partial: Path) -> str:
    """The reason why a file cannot be written; the library also reports a full disk as missing permission."""
    try:
        partial.write_bytes(bytes(4096))
    except OSError as own:
        return own.strerror or str(own)
    return str(error)
