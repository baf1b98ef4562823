"""The cache of compiled kernels, and the check that its files are undamaged.

You need not read this file to understand the physics. It is for developers who change the cache.
"""

from __future__ import annotations

import hashlib
import io
import pickle
import platform
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from importlib.metadata import version
from pathlib import Path
from typing import IO, Any

from riserstudy.files.cache import cache_folder, own_part
from riserstudy.files.digests import kernel_digest

SEAL = hashlib.sha256().digest_size  # bytes


def kernel_cache() -> Path:
    """Folder of the kernels compiled from the present sources by the present versions."""
    versions = f"py{platform.python_version()}-numba{version('numba')}"
    folder = cache_folder() / "numba" / f"{kernel_digest()}-{versions}"
    own_part(folder.parent)
    return own_part(folder)


def seal_files_of(cache: Any) -> None:
    """Make a class of numba's cache files append a seal to each file, and refuse files without a valid seal.

    A damaged file is treated as missing: its kernel is recompiled and written again.
    """
    cache._open_for_write = _sealing(cache._open_for_write)
    cache._load_index = _load_index
    cache._load_data = lambda self, name: pickle.loads(_unsealed(self._data_path(name)))


def _sealing(
    opened: Callable[[Any, str], AbstractContextManager[IO[bytes]]],
) -> Callable[[Any, str], AbstractContextManager[IO[bytes]]]:
    @contextmanager
    def writing(self: Any, path: str) -> Iterator[IO[bytes]]:
        content = io.BytesIO()
        yield content
        with opened(self, path) as file:
            file.write(content.getvalue() + _seal(path, content.getvalue()))

    return writing


def _seal(path: str, content: bytes) -> bytes:
    return hashlib.sha256(Path(path).name.encode() + b"\n" + content).digest()


def _unsealed(path: str) -> bytes:
    """Content of a file without its seal; OSError, which numba treats as no file, if the file is damaged."""
    whole = Path(path).read_bytes()
    content, seal = whole[:-SEAL], whole[-SEAL:]
    if seal != _seal(path, content):
        raise OSError(f"{path} is not as it was written")
    return content


def _load_index(self: Any) -> dict[Any, str]:
    """File names of a function's signatures; empty if the index is old, damaged or missing."""
    try:
        content = io.BytesIO(_unsealed(self._index_path))
    except OSError:
        return {}
    if pickle.load(content) != self._version:
        return {}
    stamp, overloads = pickle.load(content)
    return dict(overloads) if stamp == self._source_stamp else {}
