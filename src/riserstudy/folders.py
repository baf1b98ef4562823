"""Where caches live, and digests of sources."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable
from pathlib import Path

PACKAGE = Path(__file__).parent


def cache_folder() -> Path:
    """Folder of point store and compiled kernels: RISERSTUDY_CACHE, or ``.cache`` of the checkout."""
    if moved := os.environ.get("RISERSTUDY_CACHE"):
        return Path(moved)
    checkout = PACKAGE.parents[1]
    return (checkout if (checkout / "pyproject.toml").exists() else Path.cwd()) / ".cache"


def digest(files: Iterable[Path]) -> str:
    """Hash of the names and contents of source files, 16 hexadecimal digits."""
    total = hashlib.sha256()
    for file in sorted(files):
        total.update(file.name.encode() + b"\0" + file.read_bytes() + b"\0")
    return total.hexdigest()[:16]
