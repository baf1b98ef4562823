"""Where caches live, and files that are whole or not there."""

from __future__ import annotations

import hashlib
import json
import os
import secrets
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from importlib import import_module
from pathlib import Path
from stat import S_IWGRP, S_IWOTH, S_IXGRP, S_IXOTH
from types import ModuleType
from typing import Any

import platformdirs

from riserstudy.errors import InputError, SimulationError

PACKAGE = Path(__file__).parent

#: of a results folder, where jobs say what each file was when it was written
SEALS = ".seals"


def cache_folder() -> Path:
    """Folder of point store and compiled kernels.

    RISERSTUDY_CACHE, or ``.cache`` of the checkout, or the user's own cache for an installed package: never
    the folder where one happens to work, since what is compiled there is executed.

    Raises
    ------
    InputError
        When somebody else owns the folder, or can write to it. Made here it is this user's alone,
        whatever the umask.
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
    with suppress(OSError):  # told when something is to be kept there
        if not folder.exists():
            folder.parent.mkdir(parents=True, exist_ok=True)
            folder.mkdir(mode=0o700, exist_ok=True)


def own_part(folder: Path) -> Path:
    """A folder within the cache whose content is executed: refused as the cache is, if others get that far.

    Raises
    ------
    InputError
        As ``cache_folder``.
    """
    with suppress(OSError):
        if cache_folder().stat().st_mode & (S_IXGRP | S_IXOTH):
            _refuse_foreign(folder.absolute())
    return folder


@cache
def _refuse_foreign(folder: Path) -> None:
    try:
        stat = folder.stat()
    except OSError:  # not there: made by us, or told when it cannot be
        return
    if os.name != "posix":
        return
    allowed = "name another folder by RISERSTUDY_CACHE, or remove the write permission of others (chmod go-w)"
    if stat.st_uid != os.getuid():
        raise InputError(folder, "", "the cache belongs to another user", allowed)
    if stat.st_mode & S_IWOTH:
        raise InputError(folder, "", "anyone can write to the cache", allowed)
    if stat.st_mode & S_IWGRP and not _group_of_one(stat.st_gid):
        raise InputError(folder, "", "all of a group can write to the cache", allowed)


def _group_of_one(group: int) -> bool:
    """Whether a group is the administrator's, or the one that systems make for this user alone."""
    import grp
    import pwd

    if group in (0, os.getuid()):
        return True
    try:
        return grp.getgrgid(group).gr_name == pwd.getpwuid(os.getuid()).pw_name
    except KeyError:
        return False


def workflow_folder() -> Path:
    """Folder of Snakefile and rules: within the package that a wheel installs, else the checkout."""
    shipped = PACKAGE / "shipped"
    return shipped if shipped.exists() else PACKAGE.parents[1]


def chapter_modules(paper: str, part: str) -> list[str]:
    """Modules of one part of a paper's chapter: ``figures``, ``derived``, ``claims`` and so on.

    A part is a file of that name or a folder of files, in the folder ``chapters`` where one works.
    """
    place = Path("chapters") / paper / part
    if place.with_suffix(".py").exists():
        return [f"chapters.{paper}.{part}"]
    names = sorted(path.stem for path in place.glob("*.py") if path.stem != "__init__")
    return [f"chapters.{paper}.{part}.{name}" for name in names]


def own_chapters() -> list[str]:
    """Papers with a chapter in the folder where one works."""
    return sorted(path.name for path in Path("chapters").glob("*") if path.is_dir())


def import_of_chapter(module: str) -> ModuleType:
    """A module of a chapter, imported; one of the folder where one works whatever Python was started with."""
    here = str(Path.cwd())
    if not {here, ""} & {*sys.path}:
        sys.path.append(here)
    return import_module(module)


def chapter_files(paper: str, files: Iterable[Path]) -> list[str]:
    """Those of some source files that are of a paper's chapter, as paths from where one works."""
    here = Path.cwd()
    chapter = here / "chapters" / paper
    return sorted(str(file.relative_to(here)) for file in files if file.is_relative_to(chapter))


def write_whole(target: Path, content: bytes, synced: bool = False) -> None:
    """Write a file under another name in the same folder, then rename it; readable as other files are.

    Parameters
    ----------
    synced : whether it lies on the disk before it has its name.
    """
    name = target.with_name(f".{target.name}.{secrets.token_hex(4)}")
    handle = os.open(name, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)  # less the umask
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
            if synced:
                stream.flush()
                os.fsync(stream.fileno())
        name.replace(target)
    except BaseException:
        with suppress(OSError):
            name.unlink(missing_ok=True)
        raise


@contextmanager
def whole_file(target: Path, *errors: type[Exception]) -> Iterator[Path]:
    """The path of a file to write, which takes the target's place when it is whole.

    Parameters
    ----------
    *errors : of the library that writes, which mean that a file is not whole.

    Raises
    ------
    SimulationError
        When it cannot be written, as on a full disk, or a file that it is made from cannot be read.
    """
    partial = target.with_name(f".{target.name}.{os.getpid()}")
    unwritten: tuple[type[Exception], ...] = (OSError, *errors)
    try:
        yield partial
        partial.replace(target)
    except unwritten as error:
        reason = getattr(error, "strerror", None) or "not written to its end"
        other = getattr(error, "filename", None)  # which was to be read for it
        if other and Path(os.fsdecode(other)) not in (target, partial):
            raise SimulationError(
                f"{target} is not written, because of {other}: {reason}"
            ) from None
        remedy = "see whether the disk is full"
        raise SimulationError(f"{target} cannot be written: {reason}; {remedy}") from None
    finally:
        with suppress(OSError):  # of a folder that cannot be written it is told why
            partial.unlink(missing_ok=True)


def remembered(name: str, make: Callable[[], Any]) -> Any:
    """Plain data that takes long to make, kept in the cache; the name says all that it depends on.

    A seal stands before it: what is not as it was written is made anew.
    """
    if (kept := recall(name)) is not None:
        return kept
    made = make()
    keep(name, made)
    return made


def recall(name: str) -> Any:
    """Plain data as it was kept; None where there is none, or it is damaged."""
    with suppress(OSError, ValueError):
        seal, _, content = (cache_folder() / f"{name}.json").read_bytes().partition(b"\n")
        if seal == _seal(name, content):
            return json.loads(content)
    return None


def keep(name: str, made: Any) -> None:
    """Keep plain data in the cache; where nothing can be kept, it is made each time."""
    file = cache_folder() / f"{name}.json"
    with suppress(OSError):
        file.parent.mkdir(parents=True, exist_ok=True)
        content = json.dumps(made).encode()
        write_whole(file, _seal(name, content) + b"\n" + content)


def _seal(name: str, content: bytes) -> bytes:
    return hashlib.sha256(name.encode() + b"\n" + content).hexdigest().encode()
