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


def read_text(path: Path, most: int, *, named_in_scene: bool = False) -> str:
    """Return the text of a file of at most ``most`` bytes.

    Symbolic links are followed, as in datasets: who names a file to a command may read it. A file that a
    scene names (``named_in_scene``) may not be a link, because others may have written the scene, and the
    text of the file goes into results, which are shared: a link with the name of a table could reveal any
    file of this machine. Devices are not opened, since reading must never wait. The checks use the opened
    file itself, not its path. Raises InputError when the file is not a regular file, too large, unreadable or
    not UTF-8, or a link that may not be followed.
    """
    flags = FLAGS if named_in_scene else FLAGS[1:]
    try:
        if named_in_scene and not hasattr(os, "O_NOFOLLOW") and path.is_symlink():
            raise OSError(errno.ELOOP, "")
        handle = os.open(path, os.O_RDONLY | sum(getattr(os, name, 0) for name in flags))
        with os.fdopen(handle, "rb") as stream:
            if not stat.S_ISREG(os.fstat(handle).st_mode):
                raise InputError(path, "", "this is not a regular file", READABLE)
            content = stream.read(most + 1)
    except OSError as error:
        link = named_in_scene and error.errno == errno.ELOOP
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
