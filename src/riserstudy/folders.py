"""Folders of caches and chapters, and files that are written whole or not at all."""

from __future__ import annotations

import hashlib
import json
import os
import re
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

#: subfolder of a results folder in which jobs store the digest of each file
SEALS = ".seals"
LONGEST = 255  # bytes of a file name
#: name of a file that is not yet complete: a dot, its later name, and a random number or that of a process
_PARTIAL = re.compile(r"\..+\.([0-9a-f]{8}|\d+)", re.DOTALL)


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


def workflow_folder() -> Path:
    """Folder of Snakefile and rules: in an installed package, else in the checkout."""
    shipped = PACKAGE / "shipped"
    return shipped if shipped.exists() else PACKAGE.parents[1]


def chapter_modules(paper: str, part: str) -> list[str]:
    """Return the modules of one part of a paper's chapter: ``figures``, ``derived``, ``claims`` and so on.

    A part is a file of that name or a folder of files, in ``chapters`` of the current folder.
    """
    place = Path("chapters") / paper / part
    if place.with_suffix(".py").exists():
        return [f"chapters.{paper}.{part}"]
    names = sorted(path.stem for path in place.glob("*.py") if path.stem != "__init__")
    return [f"chapters.{paper}.{part}.{name}" for name in names]


def variables_of_chapter(paper: str) -> Path:
    """File of the names, units and labels that a chapter of the folder where one works defines."""
    return Path("chapters") / paper / "variables.yaml"


def own_chapters() -> list[str]:
    """Return the papers that have a chapter in the current folder."""
    return sorted(path.name for path in Path("chapters").glob("*") if path.is_dir())


def import_of_chapter(module: str) -> ModuleType:
    """Import a module of a chapter from the current folder, even if it is not in Python's path."""
    here = str(Path.cwd())
    if not {here, ""} & {*sys.path}:
        sys.path.append(here)
    return import_module(module)


def chapter_files(paper: str, files: Iterable[Path]) -> list[str]:
    """Return the source files that belong to a paper's chapter, as paths relative to the current folder."""
    here = Path.cwd()
    chapter = here / "chapters" / paper
    return sorted(str(file.relative_to(here)) for file in files if file.is_relative_to(chapter))


def partial_of(target: Path, ending: str) -> Path:
    """Return the temporary name of a file: a dot, its later name as far as it fits, and an ending."""
    fits = LONGEST - len(ending) - 2
    kept = target.name.encode("utf-8", "surrogateescape")[:fits].decode("utf-8", "ignore")
    return target.with_name(f".{kept}.{ending}")


def write_whole(target: Path, content: bytes, synced: bool = False) -> None:
    """Write a file under a temporary name in the same folder, then rename it; it gets usual permissions.

    ``synced``: whether the content must be on the disk before the file is renamed.
    """
    name = partial_of(target, secrets.token_hex(4))
    handle = os.open(name, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)  # minus the umask
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
    """Yield the path of a file to write; it replaces the target when it is complete.

    ``*errors``: errors of the writing library which mean that the file is not complete. Raises
    SimulationError when it cannot be written, for example on a full disk, or a source file cannot be read.
    """
    partial = partial_of(target, str(os.getpid()))
    unwritten: tuple[type[Exception], ...] = (OSError, *errors)
    try:
        yield partial
        partial.replace(target)
    except unwritten as error:
        reason = getattr(error, "strerror", None) or "not written to its end"
        other = getattr(error, "filename", None)  # a source file
        if other and Path(os.fsdecode(other)) not in (target, partial):
            raise SimulationError(f"{target} is not written, because of {other}: {reason}") from None
        remedy = "see whether the disk is full"
        raise SimulationError(f"{target} cannot be written: {reason}; {remedy}") from None
    finally:
        with suppress(OSError):  # the error of a read-only folder is reported with its reason
            partial.unlink(missing_ok=True)


def is_partial(path: Path) -> bool:
    """Return whether a file has a temporary name of this package, which a killed run left behind."""
    return bool(_PARTIAL.fullmatch(path.name)) and path.is_file()


def sha256_of(file: Path) -> str:
    """Return the SHA-256 of the content of a file."""
    with file.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def seal_line(file: Path, name: Path) -> bytes:
    """The seal of a file, which has a name in its results folder, as ``sha256sum --check`` reads it."""
    return f"{sha256_of(file)}  {name.as_posix()}\n".encode()


def fits_seal(file: Path, results: Path) -> bool:
    """Whether a file of a results folder is as the job that made it left it."""
    name = file.relative_to(results)
    try:
        return (results / SEALS / name).read_bytes() == seal_line(file, name)
    except OSError:
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
