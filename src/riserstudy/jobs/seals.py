"""Seals of results: what each file was when a job had written it.

A seal is the SHA-256 of a file and its path in the folder, as ``sha256sum --check`` reads them, in a file of
the same name below ``results/.seals``: what changed places with its seal is found, too. What has no seal,
or another, does not count as there: Snakemake compares times, and opens no output.
"""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from riserstudy import folders
from riserstudy.folders import write_whole

RESULTS = Path("results")  # in the folder where Snakemake runs
SEALS = RESULTS / folders.SEALS


def seal(*files: Path) -> None:
    """Say of files in the results folder that they are as they should be; others need no seal."""
    for file in [file for file in files if file.is_relative_to(RESULTS)]:
        target = _seal_of(file)
        target.parent.mkdir(parents=True, exist_ok=True)
        write_whole(target, _line(file))


def is_whole(file: Path) -> bool:
    """Whether a file is as the job that made it left it; one that lies elsewhere has no seal to break."""
    if not file.is_relative_to(RESULTS):
        return True
    try:
        return _seal_of(file).read_bytes() == _line(file)
    except OSError:
        return False


def damaged(files: Iterable[str]) -> list[Path]:
    """Those of some files that are there, but not as they were written."""
    there = [path for path in map(Path, files) if path.exists()]
    with ThreadPoolExecutor() as pool:  # hashing lets other threads go on
        return [
            path for path, whole in zip(there, pool.map(is_whole, there), strict=True) if not whole
        ]


def dropped(papers: Collection[str], wanted: Collection[str]) -> Iterator[Path]:
    """Files of some papers that a job made and that nobody asks for any more."""
    for paper in papers:
        for mark in sorted((SEALS / paper).glob("*")):
            file = RESULTS / paper / mark.name
            if file.as_posix() not in wanted:
                yield file


def remove(file: Path) -> None:
    """Take a result away, with its seal."""
    file.unlink(missing_ok=True)
    _seal_of(file).unlink(missing_ok=True)


def _seal_of(file: Path) -> Path:
    return SEALS / file.relative_to(RESULTS)


def _line(file: Path) -> bytes:
    with file.open("rb") as stream:
        digest = hashlib.file_digest(stream, "sha256").hexdigest()
    return f"{digest}  {file.relative_to(RESULTS).as_posix()}\n".encode()
