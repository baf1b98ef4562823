"""Packs: many stored points in one file, so that a million points do not require a million files.

A pack is written completely under another name, renamed, and never changed. It has a head, one row per point
sorted by key (key, place, length), and then the points in the form of separate files, with their seals. The
rows have a hash; a pack with damaged rows counts as missing, and so do its points. If two packs contain a
key, the younger pack is used; names begin with the time.
"""

from __future__ import annotations

import hashlib
import struct
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from riserstudy.files.whole import write_whole

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

ENDING = ".pack"
HEAD = struct.Struct("<16sQ32s")  # kind of file, number of points, hash of the rows
KIND = b"riserstudy pack1"
ROW = [("key", "S32"), ("begin", "<u8"), ("length", "<u8")]
# ns: after a change this shortly before the listing, a further change of the folder may not be detected
UNSURE = 10**9


class Pack(NamedTuple):
    """A pack and the positions of its points."""

    path: Path
    rows: NDArray[Any]  # of type ROW, sorted by key

    def place(self, key: str) -> np.void | None:
        """The row of a key."""
        wanted = key.encode()
        at = int(self.rows["key"].searchsorted(wanted))
        return self.rows[at] if at < len(self.rows) and self.rows["key"][at] == wanted else None

    def read(self, row: np.void) -> bytes | None:
        """The stored bytes of a row; None if the pack was removed."""
        try:
            with self.path.open("rb", buffering=0) as file:
                file.seek(int(row["begin"]))
                return file.read(int(row["length"]))
        except OSError:
            return None


def write_pack(folder: Path, points: Mapping[str, bytes], born: str | None = None) -> Path:
    """Write points, in their stored form, to a new pack.

    ``born``: time at the begin of its name, from the pack that it replaces; absent: now. Raises OSError when
    it cannot be written; no file remains then.
    """
    import numpy as np

    keys = sorted(points)
    rows = np.zeros(len(keys), ROW)
    begin = HEAD.size + rows.nbytes
    for row, key in zip(rows, keys, strict=True):
        row["key"], row["begin"], row["length"] = key.encode(), begin, len(points[key])
        begin += len(points[key])
    total = hashlib.sha256(rows.tobytes()).digest()
    head = HEAD.pack(KIND, len(keys), total)
    path = folder / f"{born or f'{time.time_ns():016x}'}-{total.hex()[:12]}{ENDING}"
    folder.mkdir(parents=True, exist_ok=True)
    content = b"".join([head, rows.tobytes(), *(points[key] for key in keys)])
    write_whole(path, content, synced=True)
    return path


def open_pack(path: Path) -> Pack | None:
    """A pack with its rows; None if they are damaged."""
    import numpy as np

    try:
        with path.open("rb") as file:
            kind, count, total = HEAD.unpack(file.read(HEAD.size))
            size = path.stat().st_size
            if kind != KIND or HEAD.size + count * np.dtype(ROW).itemsize > size:
                return None
            content = file.read(count * np.dtype(ROW).itemsize)
    except (OSError, struct.error):
        return None
    whole = hashlib.sha256(content).digest() == total
    return Pack(path, np.frombuffer(content, ROW)) if whole else None


class Packs:
    """The packs of a folder; the folder is listed again when it changes, so new packs are included."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._packs: dict[str, Pack | None] = {}  # by name, oldest first; None: damaged
        self._holder: dict[bytes, str] = {}  # name of the youngest pack with a key
        self._changed, self._listed = 0, 0

    def read(self, key: str) -> bytes | None:
        """The stored bytes of a point; None if no pack contains it."""
        self._list()
        name = self._holder.get(key.encode())
        pack = self._packs[name] if name else None
        row = pack.place(key) if pack else None
        return pack.read(row) if pack and row is not None else None

    def __contains__(self, key: str) -> bool:
        """Whether a pack contains a key."""
        self._list()
        return key.encode() in self._holder

    def keys(self) -> Iterator[str]:
        """All keys, each once, in order."""
        self._list()
        return (key.decode() for key in sorted(self._holder))

    def all(self) -> Iterator[tuple[Path, Pack | None]]:
        """All packs with their files; None: damaged."""
        self._list()
        return ((self.folder / name, pack) for name, pack in self._packs.items())

    def _list(self) -> None:
        try:
            changed = self.folder.stat().st_mtime_ns
        except OSError:
            changed = 0
        if changed == self._changed and changed < self._listed - UNSURE:
            return
        self._changed, self._listed = changed, time.time_ns()
        names = sorted(path.name for path in self.folder.glob(f"*{ENDING}"))
        if not self._packs.keys() <= set(names):  # one was removed
            self._packs, self._holder = {}, {}
        for name in names:
            if name not in self._packs:
                self._add(name)

    def _add(self, name: str) -> None:
        pack = self._packs[name] = open_pack(self.folder / name)
        if pack:
            self._holder.update(dict.fromkeys(pack.rows["key"].tolist(), name))
