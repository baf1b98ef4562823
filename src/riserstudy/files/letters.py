"""Letters in the path of a dataset that the netCDF library cannot open."""

from __future__ import annotations

import sys
from pathlib import Path


def fault_of_letters(path: Path, encoding: str | None = None) -> tuple[str, str] | None:
    """Why the netCDF library cannot open a file by its path, and the remedy; None if it can.

    The library receives the path in the encoding of the file system, in which every letter must exist.
    ``encoding``: this encoding; None: that of the present process.
    """
    encoding = encoding or sys.getfilesystemencoding()
    try:
        str(path.absolute()).encode(encoding)
    except UnicodeEncodeError:
        if encoding.lower() in ("utf-8", "utf8"):
            return "the name of the file or of a folder is not UTF-8 text", "rename it"
        found = f"names of files are read as {encoding}, which lacks a letter of this path"
        return found, "set the environment variable PYTHONUTF8=1"
    return None
