"""Names of Snakemake's records: the output of a job in base64, in parts where it is long."""

from __future__ import annotations

from base64 import urlsafe_b64decode
from pathlib import Path

LONG = "@"  # prefix of the parts of a name that is too long for a file system


def output_of(record: Path, folder: Path) -> str:
    """Return the path of the output that a record in ``folder`` belongs to.

    Raises ValueError when Snakemake did not give the record its name.
    """
    parts = record.relative_to(folder).parts
    return urlsafe_b64decode("".join(part.removeprefix(LONG) for part in parts)).decode()
