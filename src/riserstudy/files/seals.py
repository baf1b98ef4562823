"""The seal of a file of a results folder: its checksum and name, as the job that made it left it."""

from __future__ import annotations

from pathlib import Path

from riserstudy.files.whole import sha256_of

#: subfolder of a results folder in which jobs store the digest of each file
SEALS = ".seals"


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


def sealed(results: Path) -> list[Path]:
    """Files of a results folder that jobs made."""
    seals = results / SEALS
    return [results / seal.relative_to(seals) for seal in seals.rglob("*") if seal.is_file()]
