"""Time series of other programs, read by QATS: SIMO, RIFLEX and SIMA, Matlab, TDMS, OpenFAST, Bladed.

QATS is optional: ``pip install "riserstudy[formats]"`` adds it with its dependencies.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from riserstudy.errors import InputError, printable
from riserstudy.records.arrays import FloatArray

#: endings of files that QATS reads; its pickles are not allowed, because opening a pickle executes its
#: content
ENDINGS = (".ts", ".tda", ".asc", ".bin", ".dat", ".h5", ".mat", ".tdms", ".outb", ".out")
NEEDS = 'install it with pip install "riserstudy[formats]"'
MOST_BYTES = 2_000_000_000
MOST_NAMES = 12


class Series(NamedTuple):
    """A time series: name in the file, unit or "", times (s) and values (n,)."""

    title: str
    unit: str
    time: FloatArray
    values: FloatArray


def read_series(path: Path, titles: list[str]) -> list[Series]:
    """Series of a file, selected by their names in it.

    ``titles``: names of the series. Groups of a series precede its name, separated by a slash. Raises
    InputError when QATS is not installed, the file cannot be read, or it has no such series.
    """
    try:
        from qats.io.registry import find_reader
    except ImportError:
        found = f"reading {path.suffix} files requires the library qats, which is not installed"
        raise InputError(path, "", found, NEEDS) from None
    if not path.is_file():
        raise InputError(path, "", "No such file or directory", "give the path of an existing file")
    if path.stat().st_size > MOST_BYTES:
        found = f"the file is larger than {MOST_BYTES // 10**9} GB"
        raise InputError(path, "", found, "give a smaller file")
    try:
        source = find_reader(str(path)).open(str(path))
        known = {"/".join((*one.group, one.name)): one for one in source.series()}
        missing = [title for title in titles if title not in known]
        if not missing:
            read = source.read([known[title] for title in titles])
    except Exception as error:  # any error of a reader about the content of the file
        found = f"the library qats cannot read this file: {type(error).__name__}: {error}"
        allowed = "check that the file has the format of its ending, and that its file of names is next to it"
        raise InputError(path, "", found, allowed) from None
    if missing:
        names = ", ".join([*known][:MOST_NAMES])
        more = f" and {len(known) - MOST_NAMES} more" if len(known) > MOST_NAMES else ""
        allowed = f"use one of {printable(names)}{more}"
        raise InputError(path, missing[0], "the file has no series of this name", allowed)
    return [
        Series(title, one.unit or "", np.asarray(one.t, float), np.asarray(one.x, float))
        for title, one in zip(titles, read, strict=True)
    ]
