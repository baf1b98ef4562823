"""Files that are written whole or not at all, and the checksum of a file."""

from __future__ import annotations

import hashlib
import os
import re
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from riserstudy.errors import SimulationError

LONGEST = 255  # bytes of a file name
#: name of a file that is not yet complete: a dot, its later name, and a random number or that of a process
_PARTIAL = re.compile(r"\..+\.([0-9a-f]{8}|\d+)", re.DOTALL)


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
