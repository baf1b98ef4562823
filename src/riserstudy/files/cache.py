"""The folder of caches, which no other user may write to, and plain data that is kept in it."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from stat import S_IWGRP, S_IWOTH, S_IXGRP, S_IXOTH
from typing import Any

import platformdirs

from riserstudy.errors import InputError
from riserstudy.files.whole import write_whole
from riserstudy.folders import PACKAGE


def cache_folder() -> Path:
    """Return the folder of point store and compiled kernels.

    It is RISERSTUDY_CACHE, or ``.cache`` of the checkout, or for an installed package the user's own cache.
    It is never the current folder, because compiled code in the cache is executed. Raises InputError when
    another user owns the folder or can write to it. A folder that this function makes is private, independent
    of the umask.
    """
    checkout = PACKAGE.parents[1]
    if moved := os.environ.get("RISERSTUDY_CACHE"):
        folder = Path(moved)
    elif (checkout / "pyproject.toml").exists():
        folder = checkout / ".cache"
    else:
        folder = platformdirs.user_cache_path("riserstudy", appauthor=False)
    _make_private(folder.absolute())
    _refuse_foreign(folder.absolute())
    return folder


@cache
def _make_private(folder: Path) -> None:
    with suppress(OSError):  # reported when something is stored there
        if not folder.exists():
            folder.parent.mkdir(parents=True, exist_ok=True)
            folder.mkdir(mode=0o700, exist_ok=True)


def own_part(folder: Path) -> Path:
    """Return a subfolder of the cache whose content is executed; refused if other users can write to it.

    Raises InputError as for ``cache_folder``.
    """
    with suppress(OSError):
        if cache_folder().stat().st_mode & (S_IXGRP | S_IXOTH):
            _refuse_foreign(folder.absolute())
    return folder


@cache
def _refuse_foreign(folder: Path) -> None:
    try:
        stat = folder.stat()
    except OSError:  # it does not exist: this process makes it, or reports why it cannot
        return
    if os.name != "posix":
        return
    allowed = (
        "set the environment variable RISERSTUDY_CACHE to another folder, or remove the write permission of "
        "others (chmod go-w)"
    )
    if stat.st_uid != os.getuid():
        raise InputError(folder, "", "this cache folder belongs to another user", allowed)
    if stat.st_mode & S_IWOTH:
        raise InputError(folder, "", "any user can write to this cache folder", allowed)
    if stat.st_mode & S_IWGRP and not _group_of_one(stat.st_gid):
        raise InputError(folder, "", "a group of users can write to this cache folder", allowed)


def _group_of_one(group: int) -> bool:
    """Return whether a group belongs to the administrator, or contains only this user."""
    import grp
    import pwd

    if group in (0, os.getuid()):
        return True
    try:
        return grp.getgrgid(group).gr_name == pwd.getpwuid(os.getuid()).pw_name
    except KeyError:
        return False


def remembered(name: str, make: Callable[[], Any]) -> Any:
    """Return plain data that takes long to make, from the cache if possible.

    The name must contain everything that the data depend on. The stored data begin with a seal: damaged data
    are made again.
    """
    if (kept := recall(name)) is not None:
        return kept
    made = make()
    keep(name, made)
    return made


def recall(name: str) -> Any:
    """Return plain data from the cache; None if they are missing or damaged."""
    with suppress(OSError, ValueError):
        seal, _, content = (cache_folder() / f"{name}.json").read_bytes().partition(b"\n")
        if seal == _seal(name, content):
            return json.loads(content)
    return None


def keep(name: str, made: Any) -> None:
    """Store plain data in the cache; if that fails, they are made again each time."""
    file = cache_folder() / f"{name}.json"
    with suppress(OSError):
        file.parent.mkdir(parents=True, exist_ok=True)
        content = json.dumps(made).encode()
        write_whole(file, _seal(name, content) + b"\n" + content)


def _seal(name: str, content: bytes) -> bytes:
    return hashlib.sha256(name.encode() + b"\n" + content).hexdigest().encode()
