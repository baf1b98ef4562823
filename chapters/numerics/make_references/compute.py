"""Compute the reference solutions that the studies of the engine compare with: `make references`."""

from __future__ import annotations

import time as clock
from functools import partial
from pathlib import Path

from chapters.numerics.make_references.wanted import PAPER, all_wanted
from chapters.numerics.reference.folder import path_of, references
from chapters.numerics.reference.kept import Kept
from chapters.numerics.reference.store import NotUsed, Wanted, read, write
from riserstudy.errors import InputError
from riserstudy.study.processes import each
from riserstudy.study.read import read_studies


def compute(config: Path, only: list[str], again: bool, processes: int) -> None:
    """Compute references that are missing, damaged or of another scene; remove those that no case needs.

    Parameters
    ----------
    only : studies, and cases as study/case; empty: all.
    again : recompute references that could be used, too.

    Raises
    ------
    InputError
        When ``only`` names a study or case that needs no reference.
    """
    by_study = all_wanted(read_studies(config, PAPER).measured, config)
    known = {f"{study}/{one.case}" for study, every in by_study.items() for one in every}
    if unknown := sorted(set(only) - known - set(by_study)):
        allowed = f"allowed are {', '.join(by_study)}, and their cases as study/case"
        raise InputError("command line", "", f"no reference {unknown[0]!r}", allowed)
    for study, every in by_study.items():
        remove_others(config, study, every)
        chosen = [one for one in every if not only or {study, f"{study}/{one.case}"} & set(only)]
        todo = [one for one in chosen if again or not usable(config, study, one)]
        for line in each(partial(keep, config, study), todo, processes):
            print(f"{study}/{line}", flush=True)


def keep(config: Path, study: str, one: Wanted) -> str:
    """Compute and store one reference; return a line with its outcome."""
    started = clock.perf_counter()
    kept = one.compute()
    write(config, study, kept)
    return f"{one.case}: {in_words(kept)} ({clock.perf_counter() - started:.1f} s)"


def in_words(kept: Kept) -> str:
    """Describe how a reference was computed, and its change by the last refinement."""
    if kept.result is None:
        return f"none: {kept.missing}"
    error = ", ".join(f"{name} {100 * value:.2g} %" for name, value in kept.error.items())
    return f"{kept.how}; last refinement: {error or 'none'}"


def usable(config: Path, study: str, one: Wanted) -> bool:
    """Return whether a case has a reference that can be used."""
    try:
        read(config, study, one.case, one.file.resolved())
    except NotUsed:
        return False
    return True


def remove_others(config: Path, study: str, every: list[Wanted]) -> None:
    """Remove references of cases that no longer exist."""
    needed = {path_of(config, study, one.case) for one in every}
    for path in references(config, study):
        if path not in needed:
            path.unlink()
            print(f"{path}: removed, no case needs it")
