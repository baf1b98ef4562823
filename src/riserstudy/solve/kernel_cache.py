"""Where compiled kernels are kept; those that cannot be read are removed, and what needed them is done again.

numba writes its cache files whole, but a full disk or a lost machine can leave them short, and a short
file fails at every later run. Everything that runs kernels goes through this decorator: it lets an
error pass unless it comes from reading the cache. Then it first removes the files that miss the end
mark of what numba writes (one function is compiled anew, not all), and if that does not help, all.
"""

from __future__ import annotations

import os
import platform
import traceback
from collections.abc import Callable
from functools import wraps
from importlib.metadata import version
from pathlib import Path
from typing import ParamSpec, TypeVar

from riserstudy.digests import kernel_digest
from riserstudy.folders import cache_folder

P = ParamSpec("P")
T = TypeVar("T")

READER = os.path.join("numba", "core", "caching.py")  # noqa: PTH118  the end of a name in a traceback
END = b"."  # how a pickle ends


def kernel_cache() -> Path:
    """Folder of the kernels compiled from the present sources by the present versions."""
    versions = f"py{platform.python_version()}-numba{version('numba')}"
    return cache_folder() / "numba" / f"{kernel_digest()}-{versions}"


def mends_kernel_cache(function: Callable[P, T]) -> Callable[P, T]:
    """Make a function mend the cache of compiled kernels where it cannot be read."""

    @wraps(function)
    def mending(*arguments: P.args, **options: P.kwargs) -> T:
        for mend in (_remove_short, _remove_all):
            try:
                return function(*arguments, **options)
            except Exception as error:
                if not _unreadable(error):
                    raise
            mend(kernel_cache())
        return function(*arguments, **options)

    return mending


def _unreadable(error: BaseException | None) -> bool:
    """Whether an error, or one behind it, arose while numba read its cache."""
    while error is not None and not isinstance(error, OSError):
        frames = traceback.extract_tb(error.__traceback__)
        if any(frame.filename.endswith(READER) for frame in frames):
            return True
        error = error.__cause__ or error.__context__
    return False


def _remove_short(folder: Path) -> None:
    for file in folder.rglob("*.nb[ci]"):
        if not file.read_bytes().endswith(END):
            file.unlink(missing_ok=True)


def _remove_all(folder: Path) -> None:
    for file in folder.rglob("*.nb[ci]"):
        file.unlink(missing_ok=True)
