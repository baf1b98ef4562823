"""Repair what would stop Snakemake itself: records that it cannot read, and files dated in the future."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from riserstudy.crate.record_names import output_of

#: record that Snakemake writes for a job at work; without it a killed job would count as done
AT_WORK = '{"external_jobid": null}'


def unreadable(snakemake: Path) -> list[Path]:
    """Return records that Snakemake cannot read: it skips truncated ones, and stops at others."""
    return [
        path
        for folder in ("metadata", "incomplete")
        for path in sorted((snakemake / folder).rglob("*"))
        if path.is_file() and not _is_readable(path, folder == "metadata")
    ]


def drop(records: Iterable[Path], snakemake: Path) -> list[str]:
    """Remove the given records of finished jobs, and write those of jobs at work again.

    Returns
    -------
    Files that the finished jobs made. No record any longer tells their inputs: a later edit would not be
    noticed.
    """
    outputs = []
    for path in records:
        if path.is_relative_to(snakemake / "incomplete"):
            path.write_text(AT_WORK, "utf-8")
            continue
        path.unlink(missing_ok=True)
        with suppress(ValueError):  # not a name that Snakemake gave
            outputs.append(output_of(path, snakemake / "metadata"))
    return outputs


def _is_readable(path: Path, finished: bool) -> bool:
    """Return whether Snakemake can read from a record what a job was made from."""
    from snakemake.persistence import MetadataRecord

    try:
        record = json.loads(path.read_bytes().decode("utf-8"))
    except (ValueError, RecursionError):
        return False
    if not finished:
        return isinstance(record, dict)
    try:
        return bool(record) and bool(MetadataRecord.model_validate(record))
    except ValueError:
        return False


def date_today(files: Iterable[Path]) -> tuple[list[Path], list[Path]]:
    """Set the time of files that are dated in the future to the present.

    Snakemake removes a result that is older than its input, and every result is older than an input that is
    dated in the future. Digests decide whether results are up to date; they do not depend on times.

    Returns
    -------
    Files whose time was changed, and files whose time could not be changed.
    """
    now = time.time()
    dated, refused = [], []
    for path in files:
        try:
            if path.is_file() and path.stat().st_mtime > now:
                os.utime(path, (now, now))
                dated.append(path)
        except OSError:
            refused.append(path)
    return dated, refused
