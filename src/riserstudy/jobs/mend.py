"""What would stop Snakemake itself: records that it cannot read, and files that are dated in the future."""

from __future__ import annotations

import json
import os
import time
from base64 import urlsafe_b64decode
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

#: what Snakemake writes of a job at work; without it, a job that was killed counts as done
AT_WORK = '{"external_jobid": null}'
LONG = "@"  # before parts of a record's name that is too long for a file system


def unreadable(snakemake: Path) -> list[Path]:
    """Records that Snakemake cannot read: it leaves out those that were cut short, and stops at others."""
    return [
        path
        for folder in ("metadata", "incomplete")
        for path in sorted((snakemake / folder).rglob("*"))
        if path.is_file() and not _is_readable(path, folder == "metadata")
    ]


def drop(records: Iterable[Path], snakemake: Path) -> list[str]:
    """Remove records of finished jobs, and write those of jobs at work anew.

    Returns
    -------
    Files that the finished jobs made. Nothing tells any more what they were made from: an edit since then
    would go unseen.
    """
    outputs = []
    for path in records:
        if path.is_relative_to(snakemake / "incomplete"):
            path.write_text(AT_WORK, "utf-8")
            continue
        path.unlink(missing_ok=True)
        parts = path.relative_to(snakemake / "metadata").parts
        with suppress(ValueError):  # no name that Snakemake gave
            outputs.append(urlsafe_b64decode("".join(p.removeprefix(LONG) for p in parts)).decode())
    return outputs


def _is_readable(path: Path, finished: bool) -> bool:
    """Whether Snakemake learns from a record what a job was made from."""
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
    """Give files that are dated in the future the present time.

    Snakemake removes a result that is older than its input, as each is until that day has come. Whether
    results are up to date is told by digests, which no time changes.

    Returns
    -------
    Files that were dated anew, and those that could not be.
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
