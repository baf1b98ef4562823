"""Preparation of a run: removes what an earlier run left behind, and finds results that are damaged.

A killed Snakemake leaves its own lock and half-written files. It is distinguished from a Snakemake at work by
a lock that the system releases when the process that holds it ends, however it ends.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from pathlib import Path

from filelock import FileLock, Timeout

from riserstudy.crate.former import of_former_results
from riserstudy.crate.metadata import write_crate
from riserstudy.errors import InputError
from riserstudy.files.whole import is_partial
from riserstudy.jobs import mend, seals
from riserstudy.simulation.compile import marker

SNAKEMAKE = Path(".snakemake")
#: folders with the files that jobs read and write
DATED = (Path("config"), Path("chapters"), seals.RESULTS)
FEW = 5  # files that are listed by name

_held = FileLock(SNAKEMAKE / "riserstudy.lock")


def begin(papers: list[str], outputs: Iterable[str], at_work: bool, tier: str) -> tuple[list[str], list[str]]:
    """Prepare a run in the current folder, unless another run is at work there.

    Raises InputError when a leftover file cannot be removed.

    Parameters
    ----------
    papers : configured papers.
    outputs : files that the workflow makes, as paths below ``results``.
    tier : tier of this run.
    at_work : whether jobs will be run; otherwise no file is changed.

    Returns
    -------
    Outputs that must be made again, since they are damaged or were made from results that another job has
    replaced since, and messages of one line each.
    """
    if at_work and not _is_alone():
        return [], []
    wanted = frozenset(outputs)
    damaged = seals.damaged(sorted(wanted))
    lines = _listed(damaged, "not as its job wrote it; it is made again when needed")
    former = [Path(file) for file in of_former_results(Path()) if file in wanted]
    lines += _listed(former, "made from former results; it is made again when needed")
    remade = [file.as_posix() for file in (*damaged, *former)]
    records = mend.unreadable(SNAKEMAKE)
    if not at_work:
        return remade, lines + _listed(records, "damaged, and Snakemake may stop at it; a run repairs it")
    lines += _listed(records, "damaged; the files of its job are made again when needed")
    lines += _dated()
    lines += _other_tier(tier)
    dropped = list(seals.dropped(papers, wanted))
    lines += _listed(dropped, "no longer needed, and removed")
    try:
        remade += mend.drop(records, SNAKEMAKE)
        _remove(dropped)
    except OSError as error:
        allowed = "allow writing to this folder"
        raise InputError(error.filename, "", os.strerror(error.errno or 0), allowed) from None
    # An earlier run may have been killed after its last job. Without jobs to do, Snakemake calls no hook.
    if not remade and all(Path(file).exists() for file in wanted):
        describe_results()
    return remade, lines


def describe_results() -> None:
    """Write the run crate of the current folder, unless it is up to date; warn where that is not possible."""
    try:
        write_crate(Path())
    except OSError as error:
        print(f"riserstudy: warning: no run crate: {error}", file=sys.stderr)


def _is_alone() -> bool:
    """Acquire the lock for the lifetime of this process; return False where another process holds it."""
    try:
        SNAKEMAKE.mkdir(exist_ok=True)
        _held.acquire(timeout=0)
    except (Timeout, OSError):  # Snakemake reports a folder that is read-only
        return False
    return True


def _dated() -> list[str]:
    """Set the date of files that are dated in the future to today; return messages about them."""
    files = [path for folder in DATED for path in sorted(folder.rglob("*"))]
    dated, refused = mend.date_today([*files, *marker().parent.glob(f"{marker().name}*")])
    lines = _listed(dated, "dated in the future; its date is set to today")
    return lines + _listed(
        refused, "dated in the future, and its date cannot be changed: jobs that read it fail"
    )


def _other_tier(tier: str) -> list[str]:
    """Return a message where results of another tier will be replaced, and store the present tier."""
    note = seals.SEALS / "tier"
    former = note.read_text("utf-8", "replace") if note.exists() else tier
    try:
        note.parent.mkdir(parents=True, exist_ok=True)
        note.write_text(tier, "utf-8")
    except OSError:  # the jobs report a folder that is read-only
        return []
    return [f"results of tier {former} are replaced by those of {tier}"] if former != tier else []


def _listed(files: list[Path], why: str) -> list[str]:
    """Return one line for each of the first few files, and one line for all others."""
    lines = [f"{file} is {why}" for file in files[:FEW]]
    return [*lines, *([f"{more} more files are {why}"] if (more := len(files) - FEW) > 0 else [])]


def _remove(results: Iterable[Path]) -> None:
    """Remove results and leftovers of a killed run: locks, and files that were not yet complete."""
    partial = [path for path in seals.RESULTS.rglob(".*") if is_partial(path)]
    locks = (SNAKEMAKE / "locks").glob("*")
    for file in (*locks, *partial):
        file.unlink(missing_ok=True)
    for file in results:
        seals.remove(file)
