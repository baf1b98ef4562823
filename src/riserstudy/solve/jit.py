"""How kernels are compiled, and where the compiled code is stored.

numba's cache compares only the file that contains a function. After an edit of a called function in another
file, it would silently run old machine code. The name of the cache folder therefore contains a digest of all
kernel sources, and the versions that affect machine code. Several processes may compile into it in parallel.

You need not read this file to understand the physics: ``@kernel`` and ``@inner`` mark compiled functions. It
is for developers who change the compiling or its cache.
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

# NaN and infinity remain valid ("nnan" and "ninf" are omitted), because the solvers test for them.
FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}

numba.config.CACHE_DIR = str(kernel_cache())


def _one_at_a_time(save: Callable[..., None]) -> Callable[..., None]:
    """Let one process at a time store compiled code in the cache.

    A function's index is read, extended and written back. If two processes did this at the same time, one
    would lose its entry, or both would use the same file name.
    """

    @wraps(save)
    def locked(self: IndexDataCacheFile, key: object, data: object) -> None:
        folder = kernel_cache()
        with suppress(OSError):  # without a writable cache, functions are compiled each time
            folder.mkdir(parents=True, exist_ok=True)
            with FileLock(folder / "lock"):
                save(self, key, data)

    return locked


class KernelLocator(UserProvidedCacheLocator):
    """The place where numba stores a compiled function, and the stamp by which it recognises the function.

    The name of the cache folder already identifies the sources of kernels. A kernel is therefore not
    recompiled if only a comment, its line in the file or the folder of the package has changed.
    """

    def __init__(self, py_func: FunctionType, py_file: str):
        super().__init__(py_func, py_file)
        self._code = py_func.__code__

    def ensure_cache_path(self) -> None:
        """Allow numba to read a cache that it cannot write to."""
        with suppress(OSError):
            super().ensure_cache_path()

    def get_source_stamp(self) -> object:
        """The stamp of the file; a constant for kernels, see above."""
        return "" if _is_ours(self._py_file) else super().get_source_stamp()

    def get_disambiguator(self) -> str:
        """A text that distinguishes functions of the same name in a file."""
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
    """Hash of a function's code, without its position and its docstring.

    A docstring is a constant that shifts the indices of others, so constants are hashed by value in order of
    use.
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
    """The cache key, which distinguishes signatures of a function, and functions with different closures."""
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
#: compiled, called by kernels only (without the Python wrapper, compiling takes a quarter less time)
inner = numba.njit(**_common, no_cpython_wrapper=True, no_cfunc_wrapper=True)
