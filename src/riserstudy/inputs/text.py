"""Read the text of an input file: a regular UTF-8 file of bounded size, else an error with the reason."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

from riserstudy.errors import InputError

READABLE = "give the path of a file that you can read"
#: flags for opening a file; a system may lack some
FLAGS = ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY")


def read_text(path: Path, most: int) -> str:
    """Return the text of a file of at most ``most`` bytes.

    Links are not followed and devices are not opened: a scene from elsewhere must read only the tables that
    came with it, and must never wait. The checks use the opened file itself, not its path. Raises InputError
    when the file is a link, not a regular file, too large, unreadable or not UTF-8.
    """
    try:
        if not hasattr(os, "O_NOFOLLOW") and path.is_symlink():
            raise OSError(errno.ELOOP, "")
        handle = os.open(path, os.O_RDONLY | sum(getattr(os, name, 0) for name in FLAGS))
        with os.fdopen(handle, "rb") as stream:
            if not stat.S_ISREG(os.fstat(handle).st_mode):
                raise InputError(path, "", "this is not a regular file", READABLE)
            content = stream.read(most + 1)
    except OSError as error:
        link = error.errno == errno.ELOOP
        reason = "this is a symbolic link" if link else error.strerror or "cannot be read"
        allowed = "give the path of the file that it points to" if link else READABLE
        raise InputError(path, "", reason, allowed) from None
    except ValueError:
        raise InputError(repr(str(path)), "", "this is not a file name", READABLE) from None
    if len(content) > most:
        raise InputError(path, "", f"the file is larger than {most // 10**6} MB", "give a smaller file")
    try:
        return content.decode("utf-8-sig")  # spreadsheets write a byte order mark first
    except UnicodeDecodeError as error:
        found = f"byte {error.start} is not UTF-8 text"
        raise InputError(path, "", found, "save the file as UTF-8") from None
