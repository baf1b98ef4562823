"""Find results that a full disk or a lost machine left short, and leftovers of killed jobs.

Snakemake compares times and never opens an output that looks up to date; so a run starts by opening
them. A dataset is sound when the netCDF library opens it, which compares the length the file states
with the one it has; other files when they end as their format ends.
"""

from collections.abc import Iterator
from pathlib import Path

ENDS = {".png": b"IEND\xaeB`\x82", ".pdf": b"%%EOF", ".html": b"</html>", ".csv": b"\n"}


def remove_damaged(results: Path) -> list[Path]:
    """Remove what is damaged or half-written, and name the damaged files."""
    for partial in [path for path in results.rglob(".*") if path.is_file()]:
        partial.unlink()
    damaged = list(damaged_files(results))
    for path in damaged:
        path.unlink()
    return damaged


def damaged_files(results: Path) -> Iterator[Path]:
    """Find files that are not whole."""
    for path in sorted(results.rglob("*")):
        mark = ENDS.get(path.suffix)
        if (path.suffix == ".nc" and not opens(path)) or (mark and not ends(path, mark)):
            yield path


def opens(path: Path) -> bool:
    """Whether a dataset can be opened."""
    import netCDF4

    try:
        netCDF4.Dataset(path).close()
    except OSError:
        return False
    return True


def ends(path: Path, mark: bytes) -> bool:
    """Whether a file ends with a mark, line ends apart."""
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - len(mark) - 2))
        return mark in file.read()
