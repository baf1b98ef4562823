"""Files from which the database is built, with their digests."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from riserstudy.errors import InputError
from riserstudy.files.whole import sha256_of

KINDS = {".nc": "dataset", ".png": "figure", ".pdf": "figure", ".csv": "table"}


@dataclass(frozen=True)
class Sources:
    """Sources of the contents of the database."""

    config: Path  # folder with study files and published values
    papers: list[str]  # papers in their order
    # datasets and figures, each in the folder named like its paper, and the tables over all papers
    files: list[Path]


class File(NamedTuple):
    """A file of the results folder; its path is relative to the folder."""

    path: str
    kind: str
    bytes: int
    sha256: str


def described(file: Path, folder: Path) -> File:
    """Return a file with its digest.

    Raises InputError when the file cannot be read, or is outside the folder.
    """
    try:
        kind = KINDS[file.suffix]
        path = file.resolve().relative_to(folder.resolve()).as_posix()
        if file.exists() and not file.is_file():  # a device or pipe, which may never end
            raise ValueError
        return File(path, kind, file.stat().st_size, sha256_of(file))
    except OSError as error:
        raise InputError(
            file, "", error.strerror or "cannot be read", "repeat the command that writes it"
        ) from None
    except (ValueError, KeyError):
        allowed = f"give a file of the folders {', '.join(KINDS)} in {folder}"
        raise InputError(file, "", "this is not a file of results", allowed) from None
