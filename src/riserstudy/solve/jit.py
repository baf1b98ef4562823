"""How kernels are compiled, and where the compiled code is kept.

numba's cache compares only the file a function stands in, so an edited callee in another file would
silently run old machine code. The cache folder therefore carries a digest of all kernel sources, and
the versions that shape machine code. Processes may compile into it side by side.

You need not read this file to read the physics: ``@kernel`` and ``@inner`` mark what is compiled. It is for
those who change what is compiled, or where it is kept.
"""

from __future__ import annotations

import dis
import hashlib
from collections.abc import Callable
from contextlib import suppress
from functools import wraps
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import numba
from filelock import FileLock
from numba.core.caching import Cache, CacheImpl, IndexDataCacheFile, UserProvidedCacheLocator
from numba.core.serialize import dumps

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


class KernelLocator(UserProvidedCacheLocator):
    """Where numba keeps a compiled function, and by what it tells whether that is still the same.

    The cache folder tells the sources of kernels apart. So a kernel need not be compiled again because its
    file is another (a comment), it stands elsewhere in it, or the package lies elsewhere.
    """

    def __init__(self, py_func: FunctionType, py_file: str):
        super().__init__(py_func, py_file)
        self._code = py_func.__code__

    def ensure_cache_path(self) -> None:
        """Let numba read a cache that it cannot write to."""
        with suppress(OSError):
            super().ensure_cache_path()

    def get_source_stamp(self) -> object:
        """What the file is; of no kernel, see above."""
        return "" if _is_ours(self._py_file) else super().get_source_stamp()

    def get_disambiguator(self) -> str:
        """What tells functions of one name in a file apart."""
        return _code_hash(self._code) if _is_ours(self._py_file) else super().get_disambiguator()

    @classmethod
    def get_suitable_cache_subpath(cls, py_file: str) -> str:
        """A name for the folder of a file."""
        if _is_ours(py_file):
            folder = Path(py_file).absolute().parent
            return "-".join(folder.relative_to(PACKAGE.absolute()).parts)
        return str(super().get_suitable_cache_subpath(py_file))


_OF_CONSTANTS, _EXTENDED, _NOTHING = frozenset(dis.hasconst), dis.EXTENDED_ARG, dis.opmap["NOP"]


def _is_ours(py_file: str) -> bool:
    return Path(py_file).absolute().is_relative_to(PACKAGE.absolute())


def _code_hash(code: CodeType) -> str:
    """Hash of what a function does, not of where it stands nor of its docstring.

    A docstring is a constant and moves others about, so constants count by value, in the order of use.
    """
    operations, arguments = code.co_code[::2], bytearray(code.co_code[1::2])
    constants = []
    for place, operation in enumerate(operations):
        if operation in _OF_CONSTANTS:
            number = arguments[place]
            if place and operations[place - 1] == _EXTENDED:
                number += 256 * arguments[place - 1]
                arguments[place - 1] = 0
            value = code.co_consts[number]
            constants.append(_code_hash(value) if isinstance(value, CodeType) else repr(value))
            arguments[place] = 0
    names = (code.co_name, code.co_names, code.co_varnames, code.co_freevars)
    pairs = zip(operations, arguments, strict=True)
    does = bytes(byte for pair in pairs if pair[0] != _NOTHING for byte in pair)
    about = repr((does, constants, names))
    return hashlib.sha256(about.encode()).hexdigest()[:12]


def _key(self: Cache, signature: object, codegen: Any) -> tuple[object, ...]:
    """What tells the signatures of a function apart, and functions that differ by what they enclose."""
    cells = tuple(cell.cell_contents for cell in self._py_func.__closure__ or ())
    enclosed = hashlib.sha256(dumps(cells)).hexdigest() if cells else ""
    return signature, codegen.magic_tuple(), enclosed


Cache._index_key = _key
CacheImpl._locator_classes = [KernelLocator]
IndexDataCacheFile.save = _one_at_a_time(IndexDataCacheFile.save)
seal_files_of(IndexDataCacheFile)

_common = {"cache": True, "nogil": True, "error_model": "numpy", "fastmath": FAST}

#: compiled and callable from Python
kernel = numba.njit(**_common)
#: compiled, called by kernels only (leaving the Python wrapper out saves a quarter of compile time)
inner = numba.njit(**_common, no_cpython_wrapper=True, no_cfunc_wrapper=True)
