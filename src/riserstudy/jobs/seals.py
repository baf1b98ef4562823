"""Seals of results: the digest of each file when a job had written it.

A seal contains the SHA-256 of a file and its path in the folder, in the format of ``sha256sum --check``. It
is a file of the same name below ``results/.seals``. Because of the path, a file that was moved together with
its seal is found, too. A file without its seal counts as missing. Seals are needed because Snakemake compares
times and never opens an output.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from riserstudy.files import seals
from riserstudy.files.seals import fits_seal, seal_line
from riserstudy.files.whole import write_whole

RESULTS = Path("results")  # in the folder where Snakemake runs
SEALS = RESULTS / seals.SEALS


def seal(*files: Path) -> None:
    """Write the seals of files in the results folder; files elsewhere need no seal."""
    for file in [file for file in files if file.is_relative_to(RESULTS)]:
        target = _seal_of(file)
        target.parent.mkdir(parents=True, exist_ok=True)
        write_whole(target, seal_line(file, file.relative_to(RESULTS)))


def is_intact(file: Path) -> bool:
    """Return whether a file is as its job wrote it; True for a file outside the results folder."""
    return not file.is_relative_to(RESULTS) or fits_seal(file, RESULTS)


def damaged(files: Iterable[str]) -> list[Path]:
    """Return the files that exist, but are not as they were written."""
    there = [path for path in map(Path, files) if path.exists()]
    with ThreadPoolExecutor() as pool:  # hashing does not block other threads
        return [path for path, whole in zip(there, pool.map(is_intact, there), strict=True) if not whole]


def dropped(papers: Collection[str], wanted: Collection[str]) -> Iterator[Path]:
    """Yield files of the given papers that a job made and that are no longer wanted."""
    for paper in papers:
        for mark in sorted((SEALS / paper).glob("*")):
            file = RESULTS / paper / mark.name
            if file.as_posix() not in wanted:
                yield file


def remove(file: Path) -> None:
    """Remove a result together with its seal."""
    file.unlink(missing_ok=True)
    _seal_of(file).unlink(missing_ok=True)


def _seal_of(file: Path) -> Path:
    return SEALS / file.relative_to(RESULTS)
