"""How kernels are compiled, and where the compiled code is kept.

numba's cache compares only the file a function stands in, so an edited callee in another file would
silently run old machine code. The cache folder therefore carries a digest of all kernel sources, and
the versions that shape machine code. Processes may compile into it side by side.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import wraps
from pathlib import Path

import numba
from filelock import FileLock
from numba.core.caching import IndexDataCacheFile, UserProvidedCacheLocator

from riserstudy.folders import PACKAGE
from riserstudy.solve.kernel_cache import kernel_cache, seal_files_of

# NaN and infinity stay visible ("nnan" and "ninf" are left out): the solvers test for them.
FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}

numba.config.CACHE_DIR = str(kernel_cache())


def _one_at_a_time(save: Callable[..., None]) -> Callable[..., None]:
    """Let one process at a time enter compiled code into the cache.

    A function's index is read, added to and written back: of two processes that do so at once one would
    lose its entry, or give its file the other's name.
    """

    @wraps(save)
    def locked(self: IndexDataCacheFile, key: object, data: object) -> None:
        folder = kernel_cache()
        with suppress(OSError):  # where nothing can be kept, it is compiled each time
            folder.mkdir(parents=True, exist_ok=True)
            with FileLock(folder / "lock"):
                save(self, key, data)

    return locked


def _writable_or_not(ensure: Callable[[object], None]) -> Callable[[object], None]:
    """Let numba read a cache that it cannot write to."""

    @wraps(ensure)
    def ensured(self: object) -> None:
        with suppress(OSError):
            ensure(self)

    return ensured


def _wherever_it_lies(subpath: Callable[[str], str]) -> Callable[[str], str]:
    """Let a folder of the package have the same name wherever the package lies.

    The cache folder tells the sources; named by their path, kernels would be lost to a checkout that was
    moved and to other environments of the same user.
    """

    @wraps(subpath)
    def named(py_file: str) -> str:
        folder = Path(py_file).absolute().parent
        if folder.is_relative_to(PACKAGE.absolute()):
            return "-".join(folder.relative_to(PACKAGE.absolute()).parts)
        return subpath(py_file)

    return named


UserProvidedCacheLocator.ensure_cache_path = _writable_or_not(
    UserProvidedCacheLocator.ensure_cache_path
)
UserProvidedCacheLocator.get_suitable_cache_subpath = staticmethod(
    _wherever_it_lies(UserProvidedCacheLocator.get_suitable_cache_subpath)
)
IndexDataCacheFile.save = _one_at_a_time(IndexDataCacheFile.save)
seal_files_of(IndexDataCacheFile)

_common = {"cache": True, "nogil": True, "error_model": "numpy", "fastmath": FAST}

#: compiled and callable from Python
kernel = numba.njit(**_common)
#: compiled, called by kernels only (leaving the Python wrapper out saves a quarter of compile time)
inner = numba.njit(**_common, no_cpython_wrapper=True, no_cfunc_wrapper=True)
