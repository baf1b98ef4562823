"""Refuse HDF5 files that refer to other files: whoever wrote them would choose which files are read.

The library reads such files without a word. HDF5 has three kinds of reference: data in external files,
virtual datasets, and links to objects of other files. Each has a known pattern of bytes, which HDF5 never
compresses, except for links in a heap with filters. Such heaps are refused, too.

References
----------
The HDF Group, HDF5 File Format Specification Version 3.0: III.D and III.E, heaps; IV.A.2, messages.
"""

from __future__ import annotations

import mmap
import re
from collections.abc import Iterator
from pathlib import Path

from riserstudy.errors import InputError

SUPERBLOCK = b"\x89HDF\r\n\x1a\n"
#: version and flags of a link, with the type of a link to another file
LINK = re.compile(rb"\x01[\x08-\x1f]\x40", re.DOTALL)
#: kinds of heaps, with messages that give their addresses, as a fixed beginning and what may follow: names of
#: external files, with numbers of slots above zero; sources of a virtual dataset
MESSAGES = {
    b"HEAP\x00": (rb"\x01\x00\x00\x00", rb"(?!\x00\x00)..(?!\x00\x00).."),
    b"GCOL\x01": (rb"\x04\x03", rb""),
}
ORDERED, CODED = 0x04, 0x10  # flags of a link: it has an order of creation; it has a character set
FILTERED_HEAP = re.compile(rb"FRHP\x00..(?!\x00\x00)", re.DOTALL)


def refuse_other_files(path: Path) -> None:
    """Check that a file does not refer to other files. Raises InputError if it does."""
    if not path.is_file() or not path.stat().st_size:
        return
    with path.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as data:
        base = data.find(SUPERBLOCK)
        if base >= 0 and (_has_external_data(data, base) or _has_links(data)):
            found = "contains references to other files, which are not read"
            raise InputError(path, "", found, "write all values into this file")


def _has_external_data(data: mmap.mmap, base: int) -> bool:
    """Whether data are in external files, or in virtual datasets: messages with the address of a heap."""
    size = data[base + (13 if data[base + 8] < 2 else 9)]  # of an address, by version
    for heap, (begins, follows) in MESSAGES.items():
        heaps = {(at - base).to_bytes(size, "little") for at in _places(data, heap)}
        # Only the rest is looked ahead at: a search for fixed bytes is sixteen times as fast as one without.
        found = re.compile(b"%s(?=%s(.{%d}))" % (begins, follows, size), re.DOTALL)
        if heaps and any(match[1] in heaps for match in found.finditer(data)):
            return True
    return False


def _has_links(data: mmap.mmap) -> bool:
    """Whether links lead to other files, or cannot be seen."""
    links = (_is_link(data, match.start()) for match in LINK.finditer(data))
    return FILTERED_HEAP.search(data) is not None or any(links)


def _is_link(data: mmap.mmap, at: int) -> bool:
    """Whether a link to another file begins at a place: its name, then names of a file and an object."""
    flags = data[at + 1]
    at += 3 + 8 * bool(flags & ORDERED) + bool(flags & CODED)
    width = 1 << (flags & 3)
    name = at + width + int.from_bytes(data[at : at + width], "little")
    length = int.from_bytes(data[name : name + 2], "little")
    target = data[name + 2 : name + 2 + length]
    return len(target) == length > 3 and target[0] == 0 and target[1:].count(0) == 2 and not target[-1]


def _places(data: mmap.mmap, text: bytes) -> Iterator[int]:
    """All places of a text."""
    at = data.find(text)
    while at >= 0:
        yield at
        at = data.find(text, at + 1)
