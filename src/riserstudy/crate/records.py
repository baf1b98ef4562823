"""Snakemake's records of the jobs that made results: rule, start, end, and files that they read."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import NamedTuple

from riserstudy.crate.record_names import output_of


class Made(NamedTuple):
    """The job that made a file: its rule, start and end, the files that it read, and its parameters.

    ``checksums`` are those of the files read, without large ones, as ``sha256:...``.
    """

    rule: str
    began: datetime
    ended: datetime
    inputs: tuple[str, ...]
    checksums: Mapping[str, str]
    params: tuple[str, ...]


def recorded(study: Path) -> dict[str, Made]:
    """Return jobs by the file that they made, as a path in the study's folder; skip unreadable records."""
    return dict(_records(study / ".snakemake/metadata"))


def _records(folder: Path) -> Iterator[tuple[str, Made]]:
    for path in folder.rglob("*"):
        if not path.is_file():
            continue
        try:
            name = output_of(path, folder)
            record = json.loads(path.read_bytes())
            began, ended = (datetime.fromtimestamp(record[key], UTC) for key in ("starttime", "endtime"))
            inputs, params = ((*map(str, record[key]),) for key in ("input", "params"))
            checksums = dict(record.get("input_checksums") or {})
            yield name, Made(str(record["rule"]), began, ended, inputs, checksums, params)
        except (ValueError, KeyError, TypeError):  # truncated, or of another version
            continue
