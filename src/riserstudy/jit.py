"""How kernels are compiled, and where the compiled code is kept.

numba's cache compares only the file a function stands in, so an edited callee in another file would
silently run old machine code. The cache folder therefore carries a digest of all kernel sources, and
the versions that shape machine code.
"""

from __future__ import annotations

import numba

from riserstudy.folders import kernel_cache

# NaN and infinity stay visible ("nnan" and "ninf" are left out): the solvers test for them.
FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}

numba.config.CACHE_DIR = str(kernel_cache())

_common = {"cache": True, "nogil": True, "error_model": "numpy", "fastmath": FAST}

#: compiled and callable from Python
kernel = numba.njit(**_common)
#: compiled, called by kernels only (leaving the Python wrapper out saves a quarter of compile time)
inner = numba.njit(**_common, no_cpython_wrapper=True, no_cfunc_wrapper=True)
