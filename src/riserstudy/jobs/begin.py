"""What comes before a run: nothing of a former one is in the way, and nothing that is damaged counts.

A lock that the system frees when its holder ends, however it ends, tells a Snakemake at work from one that
was killed: the second leaves a lock of Snakemake's own, and half-written files.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from filelock import FileLock, Timeout

from riserstudy.errors import InputError
from riserstudy.jobs import mend, seals
from riserstudy.simulation.compile import marker

SNAKEMAKE = Path(".snakemake")
#: folders of what jobs read and write
DATED = (Path("config"), Path("chapters"), seals.RESULTS)
FEW = 5  # files that are named

_held = FileLock(SNAKEMAKE / "riserstudy.lock")


def begin(
    papers: list[str], outputs: Iterable[str], at_work: bool, tier: str
) -> tuple[list[str], list[str]]:
    """Make ready for a run in the current folder, unless one is at work.

    Parameters
    ----------
    papers, outputs : what there is to be, as paths below ``results``.
    tier : of this run.
    at_work : whether jobs will be done: otherwise nothing is touched.

    Returns
    -------
    Outputs that are damaged, to be made anew; and what to tell, a line each.

    Raises
    ------
    InputError
        When what is in the way cannot be removed.
    """
    if at_work and not _is_alone():
        return [], []
    wanted = frozenset(outputs)
    damaged = seals.damaged(sorted(wanted))
    lines = _listed(damaged, "not as written; it is made again when needed")
    anew = [file.as_posix() for file in damaged]
    records = mend.unreadable(SNAKEMAKE)
    if not at_work:
        return anew, lines + _listed(
            records, "damaged, and Snakemake may stop at it; a run mends it"
        )
    lines += _listed(records, "damaged; the files of its job are made again when needed")
    lines += _dated()
    lines += _other_tier(tier)
    dropped = list(seals.dropped(papers, wanted))
    lines += _listed(dropped, "no longer needed, and removed")
    try:
        anew += mend.drop(records, SNAKEMAKE)
        _remove(dropped)
    except OSError as error:
        allowed = "allowed is a folder that can be written"
        raise InputError(error.filename, "", os.strerror(error.errno or 0), allowed) from None
    return anew, lines


def _is_alone() -> bool:
    """Take the lock, for as long as this process lives."""
    try:
        SNAKEMAKE.mkdir(exist_ok=True)
        _held.acquire(timeout=0)
    except (Timeout, OSError):  # of a folder that cannot be written Snakemake tells
        return False
    return True


def _dated() -> list[str]:
    """Date today what is from the future, and say what."""
    files = [path for folder in DATED for path in sorted(folder.rglob("*"))]
    dated, refused = mend.date_today([*files, *marker().parent.glob(f"{marker().name}*")])
    lines = _listed(dated, "dated in the future; its date is set to today")
    return lines + _listed(
        refused, "dated in the future, and its date cannot be changed: jobs that read it fail"
    )


def _other_tier(tier: str) -> list[str]:
    """Say that results of another tier will be replaced, and note this one."""
    note = seals.SEALS / "tier"
    former = note.read_text("utf-8", "replace") if note.exists() else tier
    try:
        note.parent.mkdir(parents=True, exist_ok=True)
        note.write_text(tier, "utf-8")
    except OSError:  # of a folder that cannot be written the jobs tell
        return []
    return [f"results of tier {former} are replaced by those of {tier}"] if former != tier else []


def _listed(files: list[Path], why: str) -> list[str]:
    """A line for each of a few files, and one for all others."""
    lines = [f"{file} is {why}" for file in files[:FEW]]
    return [*lines, *([f"{more} more files are {why}"] if (more := len(files) - FEW) > 0 else [])]


def _remove(results: Iterable[Path]) -> None:
    """Remove results, and what a killed run left: locks, and what jobs were writing, hidden until whole."""
    partial = [path for path in seals.RESULTS.rglob(".*") if path.is_file()]
    locks = (SNAKEMAKE / "locks").glob("*")
    for file in (*locks, *partial):
        file.unlink(missing_ok=True)
    for file in results:
        seals.remove(file)
