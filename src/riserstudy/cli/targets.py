"""Files that commands write: allowed places, and files that are never replaced."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

import typer

from riserstudy.errors import InputError
from riserstudy.files.letters import fault_of_letters

#: endings of each kind of file that commands write
ENDINGS = {
    "dataset": (".nc",),
    "table": (".csv",),
    "figure": (".png", ".pdf", ".svg"),
    "scene": (".yaml", ".yml"),
    "deck": (".yml",),
    "workbook": (".xlsx",),
    "table of operators": (".csv",),
}
#: kinds of files that people edit: an existing file is replaced only on request
EDITED = ("scene", "deck", "table of operators")
#: first bytes of files, by ending
BEGINNINGS = {
    ".nc": (b"\x89HDF\r\n\x1a\n", b"CDF"),
    ".png": (b"\x89PNG\r\n\x1a\n",),
    ".pdf": (b"%PDF-",),
    ".svg": (b"<?xml", b"<svg"),
    ".xlsx": (b"PK\x03\x04",),
}
LOOKED_AT = 1000  # number of bytes of a file that are read to determine its kind
OR_FORCE = "name another file, or add --force to replace the existing file"

ForceOption = Annotated[
    bool, typer.Option("--force", help="overwrite existing files, even a file that the command has read")
]


class Writes:
    """Marks an argument or option as a file, or a folder, that a command writes.

    Parameters
    ----------
    *kinds : kinds of files, as in ``ENDINGS``; none for a folder.
    """

    def __init__(self, *kinds: str):
        self.kinds = kinds


def check_output(
    output: Path, kinds: Iterable[str], reads: Iterable[Path], force: bool, option: str = "--output"
) -> None:
    """Refuse an output that cannot be written, or would replace another file, before any computation.

    Raises InputError when another file must be named.

    Parameters
    ----------
    kinds : kinds of files that the command writes, as in ``ENDINGS``.
    reads : files that the command reads.
    force : replace an input, or a file of another kind. Links, folders and devices are never replaced.
    option : option that names the output.
    """
    kinds, reads = list(kinds), list(reads)
    for path, name in ((output, option), *((path, "") for path in reads)):
        check_name(path, name)
    try:
        _check_ending(output, kinds, option)
        _check_place(output, option)
        if "dataset" in kinds and output.suffix == ".nc":
            _check_backslash(output, option)
        if output.exists() and not force:
            _check_replaced(output, kinds, reads, option)
    except (OSError, ValueError) as error:  # a name that is too long or empty, or a loop of links
        reason = getattr(error, "strerror", None) or "this is not a file name"
        raise InputError(option, str(output), reason, "name another file") from None


def check_name(path: Path, option: str = "") -> None:
    """Refuse a file name that is no text: datasets and figures contain names, and could not be written.

    Raises InputError when the name is not in UTF-8, or the netCDF library cannot open a dataset by its whole
    path. ``option``: option that gives the name, if any.
    """
    where, field = (option, str(path)) if option else (str(path), "")
    if path.suffix == ".nc" and (fault := fault_of_letters(path)):
        raise InputError(where, field, *fault)
    try:
        str(path).encode()
    except UnicodeEncodeError:
        raise InputError(where, field, "the name of the file is not UTF-8 text", "rename the file") from None


def _check_ending(output: Path, kinds: list[str], option: str) -> None:
    endings = [ending for kind in kinds for ending in ENDINGS[kind]]
    if output.suffix in endings:
        return
    allowed = f"write a name that ends in {' or '.join(endings)}"
    if output.suffix in (".xlsx", ".xls") and ".csv" in endings:
        allowed += ", which spreadsheets open; `riserstudy table` writes workbooks"
    wrong = f"the ending {output.suffix!r} is wrong" if output.suffix else "the ending is missing"
    found = f"{wrong}, since this command writes a {' or '.join(kinds)}"
    raise InputError(option, str(output), found, allowed)


def _check_place(output: Path, option: str) -> None:
    """Check that the output is a file, existing or not, in a folder that can be written."""
    folder = output.resolve().parent
    taken = output.is_symlink() or (output.exists() and not output.is_file())
    if taken or not folder.is_dir() or not os.access(folder, os.W_OK):
        allowed = "name a file in an existing folder that you can write to"
        raise InputError(option, str(output), "this file cannot be written", allowed)


def _check_backslash(output: Path, option: str) -> None:
    """Refuse a dataset in a path with a backslash, which the netCDF library takes for a separator."""
    if os.name == "posix" and "\\" in str(output.resolve()):
        found = "the path contains a backslash, which the netCDF library refuses"
        raise InputError(option, str(output), found, "name another file or folder")


def _check_replaced(output: Path, kinds: list[str], reads: Iterable[Path], option: str) -> None:
    """Check that an existing file may be replaced: an older output of the same kind."""
    if any(_same(output, path) for path in reads):
        raise InputError(option, str(output), "the file is an input of this command", OR_FORCE)
    if not output.stat().st_size:
        return
    if set(kinds) & set(EDITED):
        raise InputError(option, str(output), "the file already exists", OR_FORCE)
    if not _is_of_its_kind(output):
        found = f"the file exists and is not a {' or '.join(kinds)} of this command"
        raise InputError(option, str(output), found, OR_FORCE)


def _same(output: Path, path: Path) -> bool:
    """Whether two names refer to the same file, such as hard links."""
    try:
        return output.samefile(path)
    except (OSError, ValueError):  # a missing input cannot be lost
        return False


def _is_of_its_kind(path: Path) -> bool:
    """Whether the content of a file fits its ending; a table for scenes is no table of results."""
    with path.open("rb") as file:
        content = file.read(LOOKED_AT)
    if beginnings := BEGINNINGS.get(path.suffix):
        return content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(beginnings)
    if path.suffix == ".csv":
        from riserstudy.scene.tables import is_table

        return b"\0" not in content and not is_table(path)
    return True
