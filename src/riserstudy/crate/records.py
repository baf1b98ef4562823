"""What Snakemake recorded of the jobs that made results: rule, and times of beginning and end."""

from __future__ import annotations

import json
from base64 import urlsafe_b64decode
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import NamedTuple

LONG = "@"  # before parts of a record's name that is too long for a file system


class Made(NamedTuple):
    """The job that made a file: its rule, and when it began and ended."""

    rule: str
    began: datetime
    ended: datetime


def recorded(study: Path) -> dict[str, Made]:
    """Jobs by the file that they made, as a path from the folder of the study; without unreadable ones."""
    return dict(_records(study / ".snakemake/metadata"))


def _records(folder: Path) -> Iterator[tuple[str, Made]]:
    for path in folder.rglob("*"):
        if not path.is_file():
            continue
        parts = path.relative_to(folder).parts
        try:
            name = urlsafe_b64decode("".join(p.removeprefix(LONG) for p in parts)).decode()
            record = json.loads(path.read_bytes())
            times = [datetime.fromtimestamp(record[key], UTC) for key in ("starttime", "endtime")]
            yield name, Made(str(record["rule"]), *times)
        except (ValueError, KeyError, TypeError):  # cut short, or of another version
            continue
