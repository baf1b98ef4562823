"""How kernels are compiled, and where the compiled code is kept.

numba's cache compares only the file a function stands in, so an edited callee in another file would
silently run old machine code. The cache folder therefore carries a digest of all kernel sources, and
the versions that shape machine code. Processes may compile into it side by side.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps

import numba
from filelock import FileLock
from numba.core.caching import IndexDataCacheFile

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
        folder.mkdir(parents=True, exist_ok=True)
        with FileLock(folder / "lock"):
            save(self, key, data)

    return locked


IndexDataCacheFile.save = _one_at_a_time(IndexDataCacheFile.save)
seal_files_of(IndexDataCacheFile)

_common = {"cache": True, "nogil": True, "error_model": "numpy", "fastmath": FAST}

#: compiled and callable from Python
kernel = numba.njit(**_common)
#: compiled, called by kernels only (leaving the Python wrapper out saves a quarter of compile time)
inner = numba.njit(**_common, no_cpython_wrapper=True, no_cfunc_wrapper=True)
